#pragma once
// The functions, version and limits of one OpenGL context.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <glad/gl.h>

namespace sky::gl {

/// Version of a context's API.
struct Version {
    int major = 0;
    int minor = 0;
    bool es = false; ///< OpenGL ES instead of desktop OpenGL
};

/// What the context can do; compute figures are zero where there are no compute shaders (GL < 4.3, ES 3.0).
struct Limits {
    int textureSize = 0;      ///< largest side of a 2D texture, texels
    int texture3dSize = 0;    ///< largest side of a 3D texture, texels
    int textureUnits = 0;     ///< of all stages together
    int uniformBlockSize = 0; ///< bytes
    std::array<int, 3> workGroupCount{};
    std::array<int, 3> workGroupSize{};
    int workGroupInvocations = 0;
    int sharedMemory = 0;           ///< bytes per work group
    long long storageBlockSize = 0; ///< bytes of one storage buffer binding
};

/// Finds an OpenGL function by its name; null where there is none.
using Loader = std::function<void*(const char*)>;

/// Functions of one context: `api->DrawArrays(...)`. A cheap handle; copies share one table. Every object made through it
/// keeps a copy, so the table outlives them all.
///
/// Rule of lifetime: objects should die before their context. If they don't, nothing breaks: once the context is gone or
/// given up (`forget`), their destructors leave OpenGL alone, since the driver has freed everything with the context.
class Api
{
public:
    /// Runs a function with the context current on this thread and puts back what was current before.
    using RunCurrent = std::function<void(const std::function<void()>&)>;

    /// Reads the functions of the context that is current now.
    ///   runCurrent  how to make it current again when an object dies; empty: it is current whenever objects die
    ///   throws      GlError where the loader gives nothing usable
    static Api load(const Loader& loader, RunCurrent runCurrent = {});

    const GladGLContext* operator->() const;

    const Version& version() const;
    bool atLeast(int major, int minor) const; ///< within the context's own family, desktop or ES
    bool isEs() const { return version().es; }
    /// True if a function that OpenGL ES has of its own from that version on goes by its plain name. Before, its suffixed name alone is
    /// right: loaders such as ANGLE's give the plain one too, but it only reports an error.
    bool hasUnsuffixed(int esMajor, int esMinor) const { return !isEs() || atLeast(esMajor, esMinor); }
    bool hasCompute() const { return !isEs() && atLeast(4, 3); }
    const Limits& limits() const;
    const std::string& renderer() const;
    const std::string& vendor() const;
    const std::string& versionText() const;
    bool isSoftware() const; ///< drawn by the CPU, as far as the renderer's name tells

    bool alive() const; ///< false after `forget`
    /// The context is gone: objects must not call it any more.
    void forget() const;
    /// Calls `action` with the context current; does nothing when it is gone.
    void runCurrent(const std::function<void()>& action) const;

    /// Names an object in debuggers and driver messages, where the driver supports it. The object must have been bound once.
    void label(GLenum identifier, GLuint name, std::string_view text) const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

/// True where a renderer of this name is known to run on the CPU.
bool isSoftwareRenderer(std::string_view renderer);

/// Throws GlError if OpenGL recorded an error or lost the context since the last check; names stage, label and error.
/// Call it once per stage, in release builds too.
void checkErrors(const Api& api, std::string_view stage, std::string_view label = {});

/// The name of a glGetError code, "GL_INVALID_ENUM" for instance.
std::string errorName(GLenum code);

/// Makes what shaders wrote to storage buffers and images visible to all that reads it next: shaders, textures, read-back.
/// Needs GL 4.3.
void memoryBarrier(const Api& api);

} // namespace sky::gl
