#pragma once
// OpenGL contexts: made without a window (EGL, OSMesa), or borrowed from a host program.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gl/api.hpp"

namespace sky::gl {

enum class HeadlessBackend { automatic, egl, osmesa };
enum class DebugOutput { off, on, full }; ///< on: errors and warnings; full: everything the driver says

/// How to make a context without a window.
struct HeadlessOptions {
    HeadlessBackend backend = HeadlessBackend::automatic; ///< automatic: EGL, then OSMesa
    int device = -1;                                      ///< index in listDevices(); -1: hardware before software
    Version version{4, 3, false};                         ///< at least this one; {3, 0, true} is OpenGL ES 3.0
    DebugOutput debug = DebugOutput::off;
    std::function<void(const std::string&)> debugSink; ///< takes the driver's messages; without it there are none
    std::string eglLibrary = "libEGL.so.1";
    std::string osmesaLibrary = "libOSMesa.so.8";
};

/// A device on which EGL can make contexts.
struct DeviceInfo {
    int index = 0;
    std::string renderer; ///< the driver's own names; empty where no context of the version can be made
    std::string vendor;
    std::string version;
    std::string driver; ///< device file or driver name, where known
    bool software = false;
    std::string problem; ///< why no context can be made there; empty when all is well
};

/// All devices that EGL knows; OSMesa, having none, adds nothing. Empty where EGL or its device extension is missing.
std::vector<DeviceInfo> listDevices(const HeadlessOptions& options = {});

/// Where a headless context comes from: EGL or OSMesa.
class HeadlessImplementation
{
public:
    virtual ~HeadlessImplementation() = default;
    virtual void makeCurrent() = 0;
    virtual void release() = 0;
    virtual void runCurrent(const std::function<void()>& action) = 0;
    virtual void* functionAddress(const char* name) = 0;
    virtual std::string description() const = 0; ///< "EGL device 0", for instance
};

/// An OpenGL core context without window or display server. Current on the calling thread once constructed.
/// Works with DISPLAY and WAYLAND_DISPLAY unset. Move-only. May be destroyed before or after the objects made in it.
class HeadlessContext
{
public:
    /// throws GlError: a sentence that says what was tried and what to install
    explicit HeadlessContext(const HeadlessOptions& options = {});
    ~HeadlessContext();
    HeadlessContext(HeadlessContext&&) noexcept;
    HeadlessContext& operator=(HeadlessContext&&) noexcept;

    const Api& api() const { return *api_; }
    void makeCurrent();
    /// Makes no context current, so that another thread can take this one.
    void release();
    /// Finds this context's functions, to lend it to a library that borrows contexts. Must not outlive the context.
    Loader loader() const;
    /// What made the context: "EGL device 0" or "OSMesa".
    std::string description() const { return implementation_->description(); }

private:
    void installDebugOutput(const HeadlessOptions& options);

    std::unique_ptr<HeadlessImplementation> implementation_;
    std::unique_ptr<std::function<void(const std::string&)>> debugSink_; // stays in place when the context moves
    std::unique_ptr<Api> api_;
};

/// A host's context, current whenever we are called. Destroying this leaves the context alone; the host keeps it current
/// while our objects die, or calls abandon() first when the context is lost or gone.
class BorrowedContext
{
public:
    /// throws GlError where no context is current or it is older than OpenGL 3.3 / ES 3.0
    explicit BorrowedContext(const Loader& loader);
    explicit BorrowedContext(void* (*loader)(const char*)) : BorrowedContext(Loader(loader)) {}

    const Api& api() const { return api_; }
    /// From now on no object of this context calls OpenGL again.
    void abandon() const { api_.forget(); }

private:
    Api api_;
};

} // namespace sky::gl
