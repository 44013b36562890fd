#include "gl/api.hpp"

#include <atomic>
#include <cctype>

#include "base/error.hpp"

namespace sky::gl {

struct Api::State {
    GladGLContext functions{};
    Version version;
    Limits limits;
    std::string renderer, vendor, versionText;
    RunCurrent runCurrent;
    std::atomic<bool> alive{true};
};

namespace {

GLADapiproc callLoader(void* user, const char* name) { return reinterpret_cast<GLADapiproc>((*static_cast<const Loader*>(user))(name)); }

std::string text(const GladGLContext& gl, GLenum what)
{
    const GLubyte* value = gl.GetString(what);
    return value ? reinterpret_cast<const char*>(value) : "";
}

int integer(const GladGLContext& gl, GLenum what)
{
    GLint value = 0;
    gl.GetIntegerv(what, &value);
    return value;
}

Limits queryLimits(const GladGLContext& gl, bool compute)
{
    Limits limits;
    limits.textureSize = integer(gl, GL_MAX_TEXTURE_SIZE);
    limits.texture3dSize = integer(gl, GL_MAX_3D_TEXTURE_SIZE);
    limits.textureUnits = integer(gl, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    limits.uniformBlockSize = integer(gl, GL_MAX_UNIFORM_BLOCK_SIZE);
    if (!compute)
        return limits;
    for (GLuint axis = 0; axis < 3; ++axis) {
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &limits.workGroupCount[axis]);
        gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_SIZE, axis, &limits.workGroupSize[axis]);
    }
    limits.workGroupInvocations = integer(gl, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
    limits.sharedMemory = integer(gl, GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
    GLint64 block = 0;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    limits.storageBlockSize = block;
    return limits;
}

} // namespace

Api Api::load(const Loader& loader, RunCurrent runCurrent)
{
    using GetString = const GLubyte*(GLAD_API_PTR*)(GLenum);
    const auto getString = reinterpret_cast<GetString>(loader("glGetString"));
    if (!getString)
        throw GlError("The loader knows no glGetString: it is not an OpenGL function loader.");
    const auto* const versionText = reinterpret_cast<const char*>(getString(GL_VERSION));
    if (!versionText)
        throw GlError("No OpenGL context is current on this thread.");

    Api api;
    api.state_ = std::make_shared<State>();
    State& state = *api.state_;
    state.version.es = std::string_view(versionText).starts_with("OpenGL ES");
    void* user = const_cast<Loader*>(&loader);
    const int loaded = state.version.es ? gladLoadGLES2ContextUserPtr(&state.functions, callLoader, user)
                                        : gladLoadGLContextUserPtr(&state.functions, callLoader, user);
    if (loaded == 0)
        throw GlError(std::string("The functions of this OpenGL context can't be loaded (version: ") + versionText + ").");
    for (int i = 0; i < 8 && state.functions.GetError() != GL_NO_ERROR; ++i) {
        // what a host left unread is not ours
    }
    // glad reports what it knows, at most 4.3; the context may be newer.
    state.functions.GetIntegerv(GL_MAJOR_VERSION, &state.version.major);
    state.functions.GetIntegerv(GL_MINOR_VERSION, &state.version.minor);
    if (state.functions.GetError() != GL_NO_ERROR || state.version.major < 3)
        throw GlError(std::string("OpenGL 3.3 or OpenGL ES 3.0 is needed; this context is \"") + versionText + "\".");
    state.renderer = text(state.functions, GL_RENDERER);
    state.vendor = text(state.functions, GL_VENDOR);
    state.versionText = versionText;
    state.limits = queryLimits(state.functions, api.hasCompute());
    state.runCurrent = std::move(runCurrent);
    return api;
}

const GladGLContext* Api::operator->() const { return &state_->functions; }
const Version& Api::version() const { return state_->version; }
const Limits& Api::limits() const { return state_->limits; }
const std::string& Api::renderer() const { return state_->renderer; }
const std::string& Api::vendor() const { return state_->vendor; }
const std::string& Api::versionText() const { return state_->versionText; }
bool Api::isSoftware() const { return isSoftwareRenderer(renderer()); }

bool Api::atLeast(int major, int minor) const
{
    const Version& v = version();
    return v.major > major || (v.major == major && v.minor >= minor);
}

bool Api::alive() const { return state_->alive; }
void Api::forget() const { state_->alive = false; }

void Api::runCurrent(const std::function<void()>& action) const
{
    if (!alive())
        return;
    if (state_->runCurrent)
        state_->runCurrent(action);
    else
        action();
}

void Api::label(GLenum identifier, GLuint name, std::string_view text) const
{
    const GladGLContext& gl = state_->functions;
    const auto function = hasUnsuffixed(3, 2) && gl.ObjectLabel ? gl.ObjectLabel : gl.ObjectLabelKHR;
    if (function && !text.empty())
        function(identifier, name, static_cast<GLsizei>(text.size()), text.data());
}

bool isSoftwareRenderer(std::string_view renderer)
{
    std::string lower(renderer);
    for (char& c : lower)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const std::string_view name :
         {"llvmpipe", "softpipe", "swrast", "software", "swiftshader", "swr ", "lavapipe", "gdi generic", "warp"})
        if (lower.find(name) != std::string::npos)
            return true;
    return false;
}

std::string errorName(GLenum code)
{
    switch (code) {
    case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST: return "GL_CONTEXT_LOST";
    default: return "OpenGL error " + std::to_string(code);
    }
}

void checkErrors(const Api& api, std::string_view stage, std::string_view label)
{
    std::string where(stage);
    if (!label.empty())
        where += " (" + std::string(label) + ")";

    const auto resetStatus = api.hasUnsuffixed(3, 2) && api->GetGraphicsResetStatus ? api->GetGraphicsResetStatus
                             : api->GetGraphicsResetStatusKHR                       ? api->GetGraphicsResetStatusKHR
                             : api->GetGraphicsResetStatusEXT                       ? api->GetGraphicsResetStatusEXT
                                                                                    : api->GetGraphicsResetStatusARB;
    const char* const lost = ": the graphics driver was reset and the OpenGL context is lost; start again, and try another "
                             "device if it happens again.";
    if (resetStatus && resetStatus() != GL_NO_ERROR)
        throw GlError(where + lost);

    std::string names;
    // A lost context may report errors for ever: a handful says enough.
    for (int i = 0; i < 8; ++i) {
        const GLenum code = api->GetError();
        if (code == GL_NO_ERROR)
            break;
        if (code == GL_CONTEXT_LOST)
            throw GlError(where + lost);
        names += (names.empty() ? "" : ", ") + errorName(code);
    }
    if (!names.empty())
        throw GlError(where + ": OpenGL reports " + names + ".");
}

void memoryBarrier(const Api& api)
{
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                       GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

} // namespace sky::gl
