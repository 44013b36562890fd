#include "program.hpp"

#include <algorithm>
#include <iostream>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "devices.hpp"
#include "plan_table.hpp"
#include "progress.hpp"
#include "values.hpp"

namespace sky::cli {

namespace {

constexpr int exitDone = 0, exitFailure = 1, exitInput = 2, exitInterrupted = 130;

std::size_t sizeOfDirectory(const std::filesystem::path& directory)
{
    std::size_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
        if (entry.is_regular_file())
            bytes += static_cast<std::size_t>(entry.file_size());
    return bytes;
}

atmo::Description read(const Request& request, const Services& services)
{
    std::error_code ignored;
    if (request.description != "-" && !std::filesystem::exists(request.description, ignored))
        throw UsageError("There is no file `" + request.description + "`.");
    if (std::filesystem::is_directory(request.description, ignored))
        throw UsageError("`" + request.description + "` is a directory; a .atmo file was expected.");
    atmo::Description description = services.read(request.description, request.parsing);
    const int layers = description.scatteringSize.altitude;
    if (request.solver.altitudeLayers && request.solver.altitudeLayers->second >= layers)
        throw UsageError("--altitudes: the description has " + std::to_string(layers) + " altitude layers, 0.." +
                         std::to_string(layers - 1) + "; there is no layer " + std::to_string(request.solver.altitudeLayers->second) + ".");
    return description;
}

void compute(const Request& request, const Services& services, Reporter& reporter)
{
    if (std::filesystem::exists(request.outDir) && !std::filesystem::is_directory(request.outDir))
        throw UsageError("--out-dir: `" + request.outDir.string() + "` is a file, not a directory.");
    const auto clock = standardError().secondsNow;
    services.solve(read(request, services), request.solver, request.gl, request.outDir, reporter);
    reporter.finished();
    if (!request.quiet)
        std::cout << request.outDir.string() << ": " << formatSize(sizeOfDirectory(request.outDir)) << " in " << formatDuration(clock())
                  << std::endl;
}

int perform(const Request& request, const Services& services, Reporter& reporter)
{
    switch (request.action) {
    case Action::ShowText: std::cout << request.text << std::flush; return exitDone;
    case Action::ListDevices: return printDevices(request.gl, std::cout) ? exitDone : exitFailure;
    case Action::Subcommand: return request.subcommand->run(request);
    case Action::DryRun:
        printPlan(services.plan(read(request, services), request.solver, request.gl, reporter), std::cout);
        return exitDone;
    case Action::Validate:
        services.validate(read(request, services), request.gl);
        if (!request.quiet)
            std::cout << request.description << ": fine" << std::endl;
        return exitDone;
    case Action::Compute: compute(request, services, reporter); return exitDone;
    }
    return exitFailure;
}

/// The message and exit code of the exception in flight.
std::pair<std::string, int> explainException()
{
    try {
        throw;
    } catch (const Cancelled&) {
        return {"Stopped. Nothing was changed.", exitInterrupted};
    } catch (const Error& error) {
        // A read that Ctrl-C broke off looks like a broken file.
        if (interrupted())
            return {"Stopped. Nothing was changed.", exitInterrupted};
        return {error.what(), error.inputMustChange() ? exitInput : exitFailure};
    } catch (const std::bad_alloc&) {
        return {"There is not enough memory. Try --max-memory, or smaller textures in the description.", exitFailure};
    } catch (const std::filesystem::filesystem_error& error) {
        return {"Cannot use `" + error.path1().string() + "`: " + error.code().message() + ".", exitFailure};
    } catch (const std::exception& error) {
        return {std::string("Something failed that should not: ") + error.what(), exitFailure};
    }
}

} // namespace

int runProgram(int argc, const char* const* argv, const Services& services)
{
    const InterruptGuard guard;
    const auto subcommands = makeSubcommands();
    Request request;
    try {
        request = parseCommandLine(argc, argv, subcommands);
    } catch (...) {
        const auto [message, exitCode] = explainException();
        printError(standardError(), message);
        return exitCode;
    }
    const auto reporter = makeReporter(request.progress, request.quiet, standardError());
    request.gl.debugSink = [&reporter](const std::string& text) { reporter->note("OpenGL: " + text); };
    try {
        return perform(request, services, *reporter);
    } catch (...) {
        const auto [message, exitCode] = explainException();
        reporter->failed(message, exitCode);
        return exitCode;
    }
}

} // namespace sky::cli
