#include "gl/headless_backends.hpp"

#if SKY_GL_HEADLESS

#include "base/error.hpp"

// Mesa's off-screen software renderer, for machines without EGL. The few declarations needed of its C interface are here,
// so that its header is not needed to build.
namespace sky::gl {

namespace {

using OsmesaContext = void*;

constexpr int osmesaFormat = 0x22, osmesaRgba = GL_RGBA, osmesaProfile = 0x33, osmesaCoreProfile = 0x34, osmesaMajorVersion = 0x36,
              osmesaMinorVersion = 0x37;

class OsmesaImplementation final : public HeadlessImplementation
{
public:
    explicit OsmesaImplementation(const HeadlessOptions& options)
        : library_(options.osmesaLibrary), createContext_(library_.need<decltype(createContext_)>("OSMesaCreateContextAttribs")),
          destroyContext_(library_.need<decltype(destroyContext_)>("OSMesaDestroyContext")),
          makeCurrent_(library_.need<decltype(makeCurrent_)>("OSMesaMakeCurrent")),
          currentContext_(library_.need<decltype(currentContext_)>("OSMesaGetCurrentContext")),
          procAddress_(library_.need<decltype(procAddress_)>("OSMesaGetProcAddress"))
    {
        if (options.version.es)
            throw GlError("OSMesa has no OpenGL ES");
        const int attributes[] = {osmesaFormat,
                                  osmesaRgba,
                                  osmesaProfile,
                                  osmesaCoreProfile,
                                  osmesaMajorVersion,
                                  options.version.major,
                                  osmesaMinorVersion,
                                  options.version.minor,
                                  0};
        context_ = createContext_(attributes, nullptr);
        if (!context_)
            throw GlError("this OSMesa can't make a core context of that version");
    }

    ~OsmesaImplementation() override
    {
        if (currentContext_() == context_)
            makeCurrent_(nullptr, nullptr, 0, 0, 0);
        destroyContext_(context_);
    }
    OsmesaImplementation(const OsmesaImplementation&) = delete;
    OsmesaImplementation& operator=(const OsmesaImplementation&) = delete;

    void makeCurrent() override
    {
        if (!makeCurrent_(context_, pixel_, GL_UNSIGNED_BYTE, 1, 1))
            throw GlError("OSMesa can't make its context current.");
    }

    void release() override { makeCurrent_(nullptr, nullptr, 0, 0, 0); }

    void runCurrent(const std::function<void()>& action) override
    {
        if (currentContext_() == context_) {
            action();
            return;
        }
        if (!makeCurrent_(context_, pixel_, GL_UNSIGNED_BYTE, 1, 1))
            return; // current on another thread
        action();
        makeCurrent_(nullptr, nullptr, 0, 0, 0);
    }

    void* functionAddress(const char* name) override { return reinterpret_cast<void*>(procAddress_(name)); }
    std::string description() const override { return "OSMesa"; }

private:
    using Function = void (*)();

    DynamicLibrary library_;
    OsmesaContext (*createContext_)(const int*, OsmesaContext);
    void (*destroyContext_)(OsmesaContext);
    GLboolean (*makeCurrent_)(OsmesaContext, void*, GLenum, GLsizei, GLsizei);
    OsmesaContext (*currentContext_)();
    Function (*procAddress_)(const char*);
    OsmesaContext context_ = nullptr;
    unsigned char pixel_[4]{}; // OSMesa draws into memory of ours; we only use framebuffer objects
};

} // namespace

std::unique_ptr<HeadlessImplementation> openOsmesa(const HeadlessOptions& options)
{
    return std::make_unique<OsmesaImplementation>(options);
}

} // namespace sky::gl

#endif
