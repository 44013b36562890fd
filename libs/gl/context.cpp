#include "gl/context.hpp"

#include "base/error.hpp"
#include "gl/headless_backends.hpp"

namespace sky::gl {

namespace {

const char* severityName(GLenum severity)
{
    switch (severity) {
    case GL_DEBUG_SEVERITY_HIGH: return "high";
    case GL_DEBUG_SEVERITY_MEDIUM: return "medium";
    case GL_DEBUG_SEVERITY_LOW: return "low";
    default: return "note";
    }
}

void GLAD_API_PTR passDebugMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* message, const void* user)
{
    const auto& sink = *static_cast<const std::function<void(const std::string&)>*>(user);
    const std::string text = length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length));
    // The driver's C code is on the stack: an exception must not cross it.
    try {
        sink(std::string("OpenGL ") + (type == GL_DEBUG_TYPE_ERROR ? "error" : severityName(severity)) + ": " + text);
    } catch (...) {
    }
}

#if SKY_GL_HEADLESS

std::string wanted(const HeadlessOptions& options)
{
    return std::string(options.version.es ? "OpenGL ES " : "OpenGL ") + std::to_string(options.version.major) + "." +
           std::to_string(options.version.minor);
}

std::unique_ptr<HeadlessImplementation> openHeadless(const HeadlessOptions& options)
{
    std::string tried;
    const auto attempt = [&](const char* name, auto open) -> std::unique_ptr<HeadlessImplementation> {
        try {
            return open(options);
        } catch (const GlError& error) {
            tried += std::string("\n  ") + name + ": " + error.what();
            return nullptr;
        }
    };
    if (options.backend != HeadlessBackend::osmesa)
        if (auto made = attempt("EGL", openEgl))
            return made;
    // A device number means something to EGL only: falling back would silently use another device.
    if (options.backend != HeadlessBackend::egl && options.device < 0)
        if (auto made = attempt("OSMesa", openOsmesa))
            return made;
    throw GlError("No " + wanted(options) + " context can be made. Tried:" + tried +
                  "\nInstall a graphics driver with EGL, or Mesa's software renderer (Debian: apt-get install libegl1 "
                  "libgl1-mesa-dri, or libosmesa6).");
}

#else

std::unique_ptr<HeadlessImplementation> openHeadless(const HeadlessOptions&)
{
    throw GlError("Contexts without a window are made on Linux and FreeBSD only. On this system, give the library a "
                  "context of your own (BorrowedContext), or run the program on Linux.");
}

#endif

} // namespace

#if SKY_GL_HEADLESS
std::vector<DeviceInfo> listDevices(const HeadlessOptions& options) { return listEglDevices(options); }
#else
std::vector<DeviceInfo> listDevices(const HeadlessOptions&) { return {}; }
#endif

HeadlessContext::HeadlessContext(const HeadlessOptions& options) : implementation_(openHeadless(options))
{
    implementation_->makeCurrent();
    api_ = std::make_unique<Api>(
        Api::load(loader(), [implementation = implementation_.get()](const auto& action) { implementation->runCurrent(action); }));
    if (options.debug != DebugOutput::off && options.debugSink)
        installDebugOutput(options);
}

HeadlessContext::~HeadlessContext()
{
    if (api_)
        api_->forget();
}

HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;

HeadlessContext& HeadlessContext::operator=(HeadlessContext&& other) noexcept
{
    if (this != &other) {
        if (api_)
            api_->forget();
        // The context goes before its sink: a driver may still speak while it closes.
        implementation_ = std::move(other.implementation_);
        debugSink_ = std::move(other.debugSink_);
        api_ = std::move(other.api_);
    }
    return *this;
}

void HeadlessContext::makeCurrent() { implementation_->makeCurrent(); }
void HeadlessContext::release() { implementation_->release(); }

Loader HeadlessContext::loader() const
{
    return [implementation = implementation_.get()](const char* name) { return implementation->functionAddress(name); };
}

void HeadlessContext::installDebugOutput(const HeadlessOptions& options)
{
    const Api& gl = *api_;
    const auto callback = gl.hasUnsuffixed(3, 2) && gl->DebugMessageCallback ? gl->DebugMessageCallback : gl->DebugMessageCallbackKHR;
    const auto control = gl.hasUnsuffixed(3, 2) && gl->DebugMessageControl ? gl->DebugMessageControl : gl->DebugMessageControlKHR;
    if (!callback || !control)
        return;
    debugSink_ = std::make_unique<std::function<void(const std::string&)>>(options.debugSink);
    callback(passDebugMessage, debugSink_.get());
    gl->Enable(GL_DEBUG_OUTPUT);
    gl->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    const bool full = options.debug == DebugOutput::full;
    control(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, full ? GL_TRUE : GL_FALSE);
    control(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_HIGH, 0, nullptr, GL_TRUE);
    control(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_MEDIUM, 0, nullptr, GL_TRUE);
    control(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

BorrowedContext::BorrowedContext(const Loader& loader) : api_(Api::load(loader)) {}

} // namespace sky::gl
