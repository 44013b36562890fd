// calcmysky doctor: can this machine do the work, how fast, and if not, what is missing.

#include <cmath>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>
#include <Imath/ImathConfig.h>
#include <nlohmann/json.hpp>
#include <OpenEXR/OpenEXRConfig.h>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/terminal.hpp"
#include "devices.hpp"
#include "gl/buffer.hpp"
#include "gl/context.hpp"
#include "gl/program.hpp"
#include "help.hpp"
#include "options.hpp"
#include "subcommand.hpp"
#include "values.hpp"

namespace sky::cli {

namespace {

/// Transmittance of optical depths 0..10: what the solver does most, `exp` and floats in a storage buffer.
constexpr std::string_view selfTestShader = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Result { float transmittance[]; };
uniform int count;
void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i < count)
        transmittance[i] = exp(-10.0 * float(i) / float(count));
}
)";

struct SelfTest {
    double worstError = 0;                ///< largest relative difference from the CPU
    double seconds = 0;                   ///< compilation, dispatch and read-back
    static constexpr double bound = 1e-5; ///< far above the rounding of float32 (6e-8), far below a broken driver
    bool passed() const { return worstError < bound; }
};

SelfTest runSelfTest(const gl::Api& api)
{
    constexpr int count = 1 << 16;
    const base::Stopwatch watch;
    const gl::ProgramBuilder builder(api, [](std::string_view) { return selfTestShader; });
    gl::Program program = builder.compute("self-test", "self-test.comp");
    const gl::Buffer buffer(api, "self-test", std::vector<float>(count, -1.f));
    buffer.bindStorage(0);
    program.set("count", count);
    {
        const gl::Bound pass{program};
        program.dispatchOver(count);
    }
    gl::memoryBarrier(api);
    const std::vector<float> values = buffer.download();
    gl::checkErrors(api, "self-test");
    SelfTest result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double expected = std::exp(-10. * static_cast<double>(i) / count);
        const double error = std::abs(static_cast<double>(values[i]) / expected - 1);
        result.worstError = std::isfinite(error) ? std::max(result.worstError, error) : HUGE_VAL;
    }
    result.seconds = watch.seconds();
    return result;
}

void printProgram()
{
    std::cout << versionText() << ", built "
#ifdef NDEBUG
              << "optimised"
#else
              << "for debugging (slow)"
#endif
#ifdef __VERSION__
              << ", compiler " << __VERSION__
#endif
              << "\nLibraries: OpenEXR " OPENEXR_VERSION_STRING ", Imath " IMATH_VERSION_STRING ", CLI11 " CLI11_VERSION ", nlohmann/json "
              << NLOHMANN_JSON_VERSION_MAJOR << "." << NLOHMANN_JSON_VERSION_MINOR << "." << NLOHMANN_JSON_VERSION_PATCH << "\n\n";
}

void printLimits(const gl::Api& api)
{
    const gl::Limits& limits = api.limits();
    std::cout << "    textures up to " << limits.textureSize << " x " << limits.textureSize << ", 3D up to " << limits.texture3dSize
              << "; storage buffers up to " << formatSize(static_cast<std::size_t>(limits.storageBlockSize)) << "\n    work groups of "
              << limits.workGroupInvocations << " invocations with " << formatSize(static_cast<std::size_t>(limits.sharedMemory))
              << " shared, " << limits.workGroupCount[0] << " groups along an axis\n";
}

/// Tries one backend and prints what came of it. Nothing where it can't be used, else whether it is a CPU.
std::optional<bool> examine(const std::string& name, gl::HeadlessOptions options)
{
    std::cout << name << ": " << std::flush;
    try {
        const gl::HeadlessContext context(options);
        const gl::Api& api = context.api();
        std::cout << api.renderer() << ", OpenGL " << api.versionText() << "\n";
        printLimits(api);
        const SelfTest test = runSelfTest(api);
        std::cout << "    self-test " << (test.passed() ? "passed" : "FAILED") << " in " << formatDuration(test.seconds)
                  << ": largest relative difference from the CPU " << test.worstError << "\n";
        if (!test.passed())
            return {};
        return api.isSoftware();
    } catch (const Error& error) {
        std::cout << "cannot be used\n    " << error.what() << "\n";
        return {};
    }
}

class Doctor : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        return app.add_subcommand("doctor", "Say what this machine offers, test it, and name what is missing");
    }

    int run(const Request& request) override
    {
        printProgram();
        std::cout << "Devices:\n";
        printDevices(request.gl, std::cout);
        std::cout << "\n";

        using enum gl::HeadlessBackend;
        std::optional<bool> software;
        for (const auto& [backend, name] : {std::pair{egl, "EGL"}, std::pair{osmesa, "OSMesa"}}) {
            if (request.gl.backend != automatic && request.gl.backend != backend)
                continue;
            gl::HeadlessOptions options = request.gl;
            options.backend = backend;
            const std::optional<bool> found = examine(name, options);
            if (!software)
                software = found; // the first that works is the one that a run takes
        }
        std::cout << "\n" << verdict(software) << std::endl;
        return software ? 0 : 1;
    }

private:
    static std::string verdict(std::optional<bool> software)
    {
        const bool colour = wantsColour(Stream::Output);
        const auto loud = [&](const std::string& text) { return colour ? "\033[1;33m" + text + "\033[0m" : text; };
        if (!software)
            return loud("NOT READY: no OpenGL 4.3.") +
                   " On Debian and Ubuntu install libegl1, libgl1-mesa-dri and libosmesa6 (apt-get install ...),\n"
                   "or the driver of your graphics card. In a container, pass the device through (/dev/dri) or use the "
                   "software\n"
                   "driver of libgl1-mesa-dri.";
        if (*software)
            return loud("READY, BUT IN SOFTWARE: the CPU does the work of a graphics card.") +
                   " Results are the same, only slower.\nWith a graphics card in the machine: install its driver, and "
                   "look for it in "
                   "--list-devices.";
        return "READY.";
    }
};

} // namespace

std::unique_ptr<Subcommand> makeDoctor() { return std::make_unique<Doctor>(); }

} // namespace sky::cli
