#include "gl/headless_backends.hpp"

#if SKY_GL_HEADLESS

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>

#include "base/error.hpp"

namespace sky::gl {

namespace {

bool hasWord(const char* list, std::string_view word)
{
    if (!list)
        return false;
    const std::string spaced = " " + std::string(list) + " ";
    return spaced.find(" " + std::string(word) + " ") != std::string::npos;
}

/// The functions of libEGL, found at run time so that programs start without it.
struct Egl {
    explicit Egl(const std::string& name) : library(name) {}

    DynamicLibrary library;
    PFNEGLGETPROCADDRESSPROC getProcAddress = library.need<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
    PFNEGLQUERYSTRINGPROC queryString = library.need<PFNEGLQUERYSTRINGPROC>("eglQueryString");
    PFNEGLGETERRORPROC getError = library.need<PFNEGLGETERRORPROC>("eglGetError");
    PFNEGLGETDISPLAYPROC getDisplay = library.need<PFNEGLGETDISPLAYPROC>("eglGetDisplay");
    PFNEGLINITIALIZEPROC initialize = library.need<PFNEGLINITIALIZEPROC>("eglInitialize");
    PFNEGLBINDAPIPROC bindApi = library.need<PFNEGLBINDAPIPROC>("eglBindAPI");
    PFNEGLQUERYAPIPROC queryApi = library.need<PFNEGLQUERYAPIPROC>("eglQueryAPI");
    PFNEGLCHOOSECONFIGPROC chooseConfig = library.need<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig");
    PFNEGLCREATECONTEXTPROC createContext = library.need<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
    PFNEGLDESTROYCONTEXTPROC destroyContext = library.need<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext");
    PFNEGLCREATEPBUFFERSURFACEPROC createPbuffer = library.need<PFNEGLCREATEPBUFFERSURFACEPROC>("eglCreatePbufferSurface");
    PFNEGLDESTROYSURFACEPROC destroySurface = library.need<PFNEGLDESTROYSURFACEPROC>("eglDestroySurface");
    PFNEGLMAKECURRENTPROC makeCurrent = library.need<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
    PFNEGLGETCURRENTCONTEXTPROC currentContext = library.need<PFNEGLGETCURRENTCONTEXTPROC>("eglGetCurrentContext");
    PFNEGLGETCURRENTDISPLAYPROC currentDisplay = library.need<PFNEGLGETCURRENTDISPLAYPROC>("eglGetCurrentDisplay");
    PFNEGLGETCURRENTSURFACEPROC currentSurface = library.need<PFNEGLGETCURRENTSURFACEPROC>("eglGetCurrentSurface");

    // Extensions; null where the client library lacks them.
    const char* clientExtensions = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLQUERYDEVICESEXTPROC queryDevices = optional<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = optional<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = optional<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");

    template<class Function>
    Function optional(const char* name) const
    {
        return reinterpret_cast<Function>(getProcAddress(name));
    }

    std::vector<EGLDeviceEXT> devices() const
    {
        const bool known = hasWord(clientExtensions, "EGL_EXT_device_enumeration") || hasWord(clientExtensions, "EGL_EXT_device_base");
        EGLint count = 0;
        if (!known || !queryDevices || !getPlatformDisplay || !queryDevices(0, nullptr, &count) || count <= 0)
            return {};
        std::vector<EGLDeviceEXT> found(static_cast<std::size_t>(count));
        if (!queryDevices(count, found.data(), &count))
            return {};
        found.resize(static_cast<std::size_t>(std::max(count, 0)));
        return found;
    }

    const char* deviceString(EGLDeviceEXT device, EGLint what, const char* extension) const
    {
        if (!queryDeviceString || !hasWord(queryDeviceString(device, EGL_EXTENSIONS), extension))
            return nullptr;
        return queryDeviceString(device, what);
    }

    bool isSoftware(EGLDeviceEXT device) const
    {
        return queryDeviceString && hasWord(queryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    }

    std::string failure(const std::string& function) const
    {
        static constexpr const char* names[] = {
            "EGL_SUCCESS",           "EGL_NOT_INITIALIZED",   "EGL_BAD_ACCESS",          "EGL_BAD_ALLOC",   "EGL_BAD_ATTRIBUTE",
            "EGL_BAD_CONFIG",        "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY", "EGL_BAD_MATCH",
            "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW", "EGL_BAD_PARAMETER",       "EGL_BAD_SURFACE", "EGL_CONTEXT_LOST"};
        const EGLint code = getError();
        const std::size_t index = static_cast<std::size_t>(code - EGL_SUCCESS);
        return function + " fails with " + (index < std::size(names) ? names[index] : std::to_string(code));
    }
};

/// A context on one display. The display is never terminated: EGL shares it with everybody in the process, a host
/// program's own contexts included.
class EglImplementation final : public HeadlessImplementation
{
public:
    EglImplementation(std::shared_ptr<const Egl> egl, EGLDisplay display, std::string description, const HeadlessOptions& options)
        : egl_(std::move(egl)), display_(display), api_(options.version.es ? EGL_OPENGL_ES_API : EGL_OPENGL_API),
          description_(std::move(description))
    {
        if (display_ == EGL_NO_DISPLAY)
            throw GlError(egl_->failure("eglGetPlatformDisplay"));
        EGLint major = 0, minor = 0;
        if (!egl_->initialize(display_, &major, &minor))
            throw GlError(egl_->failure("eglInitialize"));
        const char* extensions = egl_->queryString(display_, EGL_EXTENSIONS);
        if (!egl_->bindApi(api_))
            throw GlError(std::string("this EGL has no ") + (options.version.es ? "OpenGL ES" : "desktop OpenGL"));
        const bool surfaceless = hasWord(extensions, "EGL_KHR_surfaceless_context");
        const EGLConfig config = chooseConfig(options, extensions, surfaceless);
        createContext(config, options, extensions, major > 1 || minor >= 5);
        if (!surfaceless) {
            const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
            surface_ = egl_->createPbuffer(display_, config, size);
            if (surface_ == EGL_NO_SURFACE) {
                const std::string reason = egl_->failure("eglCreatePbufferSurface");
                egl_->destroyContext(display_, context_);
                throw GlError(reason);
            }
        }
    }

    ~EglImplementation() override
    {
        if (egl_->currentContext() == context_)
            release();
        if (surface_ != EGL_NO_SURFACE)
            egl_->destroySurface(display_, surface_);
        egl_->destroyContext(display_, context_);
    }
    EglImplementation(const EglImplementation&) = delete;
    EglImplementation& operator=(const EglImplementation&) = delete;

    void makeCurrent() override
    {
        egl_->bindApi(api_);
        if (!egl_->makeCurrent(display_, surface_, surface_, context_))
            throw GlError("The OpenGL context can't be made current: " + egl_->failure("eglMakeCurrent") + ".");
    }

    void release() override
    {
        egl_->bindApi(api_);
        egl_->makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }

    void runCurrent(const std::function<void()>& action) override
    {
        const EGLContext before = egl_->currentContext();
        if (before == context_) {
            action();
            return;
        }
        const EGLDisplay displayBefore = egl_->currentDisplay();
        const EGLSurface draw = egl_->currentSurface(EGL_DRAW), read = egl_->currentSurface(EGL_READ);
        const EGLenum apiBefore = egl_->queryApi();
        egl_->bindApi(api_);
        if (!egl_->makeCurrent(display_, surface_, surface_, context_)) {
            egl_->bindApi(apiBefore);
            return; // current on another thread: that thread's end will free its objects with the context
        }
        action();
        release();
        egl_->bindApi(apiBefore);
        if (before != EGL_NO_CONTEXT)
            egl_->makeCurrent(displayBefore, draw, read, before);
    }

    void* functionAddress(const char* name) override
    {
        // Before EGL 1.5 eglGetProcAddress may know extensions only.
        if (void* found = reinterpret_cast<void*>(egl_->getProcAddress(name)))
            return found;
        return egl_->library.find(name);
    }

    std::string description() const override { return description_; }

private:
    EGLConfig chooseConfig(const HeadlessOptions& options, const char* extensions, bool surfaceless) const
    {
        if (surfaceless && (hasWord(extensions, "EGL_KHR_no_config_context") || hasWord(extensions, "EGL_MESA_configless_context")))
            return EGLConfig{};
        const EGLint attributes[] = {EGL_SURFACE_TYPE, surfaceless ? EGL_DONT_CARE : EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                     options.version.es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config{};
        EGLint count = 0;
        if (!egl_->chooseConfig(display_, attributes, &config, 1, &count) || count < 1)
            throw GlError("no suitable EGL configuration");
        return config;
    }

    void createContext(EGLConfig config, const HeadlessOptions& options, const char* extensions, bool egl15)
    {
        std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION, options.version.major, EGL_CONTEXT_MINOR_VERSION, options.version.minor};
        if (!options.version.es)
            attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
        if (options.debug != DebugOutput::off) {
            if (egl15)
                attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
            else if (hasWord(extensions, "EGL_KHR_create_context"))
                attributes.insert(attributes.end(), {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
        }
        // Ask to be told when the GPU is reset; drivers that refuse get a second, plain request.
        std::vector<EGLint> withReset = attributes;
        if (hasWord(extensions, "EGL_EXT_create_context_robustness"))
            withReset.insert(withReset.end(), {options.version.es ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT
                                                                  : EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_KHR,
                                               EGL_LOSE_CONTEXT_ON_RESET_EXT});
        withReset.push_back(EGL_NONE);
        attributes.push_back(EGL_NONE);
        context_ = egl_->createContext(display_, config, EGL_NO_CONTEXT, withReset.data());
        if (context_ == EGL_NO_CONTEXT)
            context_ = egl_->createContext(display_, config, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT)
            throw GlError(egl_->failure("eglCreateContext"));
    }

    std::shared_ptr<const Egl> egl_;
    EGLDisplay display_;
    EGLenum api_;
    std::string description_;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

std::unique_ptr<HeadlessImplementation> openDevice(const std::shared_ptr<const Egl>& egl, const std::vector<EGLDeviceEXT>& devices,
                                                   std::size_t index, const HeadlessOptions& options)
{
    const EGLDisplay display = egl->getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[index], nullptr);
    return std::make_unique<EglImplementation>(egl, display, "EGL device " + std::to_string(index), options);
}

/// GL_RENDERER, GL_VENDOR and GL_VERSION of a context, leaving no context of ours current.
DeviceInfo interrogate(HeadlessImplementation& context)
{
    DeviceInfo info;
    context.runCurrent([&] {
        using GetString = const GLubyte*(GLAD_API_PTR*)(GLenum);
        const auto getString = reinterpret_cast<GetString>(context.functionAddress("glGetString"));
        const auto text = [&](GLenum what) {
            const GLubyte* value = getString ? getString(what) : nullptr;
            return value ? std::string(reinterpret_cast<const char*>(value)) : std::string();
        };
        info.renderer = text(GL_RENDERER);
        info.vendor = text(GL_VENDOR);
        info.version = text(GL_VERSION);
    });
    info.software = isSoftwareRenderer(info.renderer);
    return info;
}

} // namespace

std::unique_ptr<HeadlessImplementation> openEgl(const HeadlessOptions& options)
{
    const auto egl = std::make_shared<const Egl>(options.eglLibrary);
    const std::vector<EGLDeviceEXT> devices = egl->devices();
    if (options.device >= 0) {
        const auto index = static_cast<std::size_t>(options.device);
        if (index >= devices.size())
            throw GlError("there is no device " + std::to_string(options.device) + "; EGL lists " + std::to_string(devices.size()) +
                          ", counted from 0");
        return openDevice(egl, devices, index, options);
    }

    std::string reasons;
    std::unique_ptr<HeadlessImplementation> software;
    const auto attempt = [&](const std::string& name, auto open) -> std::unique_ptr<HeadlessImplementation> {
        try {
            auto made = open();
            if (!interrogate(*made).software)
                return made;
            if (!software)
                software = std::move(made);
        } catch (const GlError& error) {
            reasons += (reasons.empty() ? "" : "; ") + name + ": " + error.what();
        }
        return nullptr;
    };

    // Devices that call themselves software come last, so that a GPU is found without starting a software renderer.
    std::vector<std::size_t> order;
    for (const bool wantSoftware : {false, true})
        for (std::size_t i = 0; i < devices.size(); ++i)
            if (egl->isSoftware(devices[i]) == wantSoftware)
                order.push_back(i);
    for (const std::size_t index : order)
        if (auto made = attempt("device " + std::to_string(index), [&] { return openDevice(egl, devices, index, options); }))
            return made;
    if (software)
        return software;

    if (egl->getPlatformDisplay && hasWord(egl->clientExtensions, "EGL_MESA_platform_surfaceless"))
        if (auto made = attempt("surfaceless", [&] {
                const EGLDisplay display = egl->getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
                return std::make_unique<EglImplementation>(egl, display, "EGL surfaceless", options);
            }))
            return made;
    if (software)
        return software;

    if (auto made = attempt("default display", [&] {
            return std::make_unique<EglImplementation>(egl, egl->getDisplay(EGL_DEFAULT_DISPLAY), "EGL default display", options);
        }))
        return made;
    if (software)
        return software;
    throw GlError(reasons);
}

std::vector<DeviceInfo> listEglDevices(const HeadlessOptions& options)
{
    std::shared_ptr<const Egl> egl;
    try {
        egl = std::make_shared<const Egl>(options.eglLibrary);
    } catch (const GlError&) {
        return {};
    }
    const std::vector<EGLDeviceEXT> devices = egl->devices();
    std::vector<DeviceInfo> list;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        DeviceInfo info;
        info.software = egl->isSoftware(devices[i]);
        try {
            info = interrogate(*openDevice(egl, devices, i, options));
        } catch (const GlError& error) {
            info.problem = error.what();
        }
        info.index = static_cast<int>(i);
        if (const char* file = egl->deviceString(devices[i], EGL_DRM_DEVICE_FILE_EXT, "EGL_EXT_device_drm"))
            info.driver = file;
        else if (egl->isSoftware(devices[i]))
            info.driver = "software";
        list.push_back(info);
    }
    return list;
}

} // namespace sky::gl

#endif
