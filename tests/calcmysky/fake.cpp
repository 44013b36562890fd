// calcmysky with a solver that obeys the name of the description: "slow" never ends, "driver" fails like a driver, and
// so on.

#include <chrono>
#include <fstream>
#include <iostream>
#include <thread>

#include "base/error.hpp"
#include "program.hpp"

using namespace sky;

namespace {

[[noreturn]] void failLike(const std::string& name)
{
    if (name == "typo.atmo")
        throw AtmoError({"typo.atmo", 3, 1}, "unknown key `groud albedo`. Did you mean `ground albedo`?", "groud albedo: 0.3");
    if (name == "driver.atmo")
        throw GlError("transmittance: the driver lost its context.");
    if (name == "nan.atmo")
        throw NumericsError("irradiance: texel (3, 5) of `direct` is not a number.");
    if (name == "disk.atmo")
        throw FileError("Cannot write `moments.exr`: no space left on the device.");
    if (name == "memory.atmo")
        throw std::bad_alloc();
    throw std::logic_error("the fake knows no " + name);
}

atmo::Description readDescription(const std::string& path, const atmo::ParseOptions& options)
{
    if (path == "typo.atmo")
        failLike(path);
    atmo::Description description;
    if (path == "-")
        std::getline(std::cin, description.scatterers.emplace_back().name);
    else
        description.scatterers.emplace_back().name = path;
    description.scatteringSize.altitude = 8;
    std::cout << "read point=" << (options.resampling == atmo::Resampling::Point) << " outside=" << static_cast<int>(options.outside)
              << "\n";
    return description;
}

std::vector<solver::PlanItem> plan(const atmo::Description&, const solver::Options& options, const gl::HeadlessOptions&,
                                   solver::Progress& progress)
{
    if (options.qualityByTolerance)
        progress.remark("picked for the tolerance.");
    return {{"moments", options.parts.contains(solver::Part::Moments), "", 300'000'000, 120'000, 0.8},
            {"eclipsed double scattering", false, "--no-eds-tex", 0, 0, 0}};
}

/// Prints each option as the solver receives it.
void echo(const solver::Options& options, const gl::HeadlessOptions& openGl)
{
    std::cout << "parts";
    for (const solver::Part part : options.parts)
        std::cout << " " << nameOf(part);
    std::cout << "\nradiance=" << options.radiance << " bits=" << options.texturePrecisionBits
              << " quality=" << (options.qualityByTolerance ? "picked" : options.quality) << " tolerance=" << options.tolerance.value_or(0)
              << " memory=" << options.maxMemoryBytes;
    if (options.altitudeLayers)
        std::cout << " layers=" << options.altitudeLayers->first << ".." << options.altitudeLayers->second;
    std::cout << "\nsave" << (options.saveIrradianceOrders ? " irradiance" : "") << (options.saveScatteringDensity ? " density" : "")
              << (options.saveScatteringDensity2FromGround ? " density2" : "") << (options.saveDeltaScattering ? " delta" : "")
              << (options.saveAccumulatedScattering ? " accumulated" : "") << (options.saveLightPollution ? " pollution" : "")
              << "\nbackend=" << static_cast<int>(openGl.backend) << " device=" << openGl.device
              << " debug=" << static_cast<int>(openGl.debug) << std::endl;
}

void solve(const atmo::Description& description, const solver::Options& options, const gl::HeadlessOptions& openGl,
           const std::filesystem::path& outDir, solver::Progress& progress)
{
    const std::string& name = description.scatterers.front().name;
    echo(options, openGl);
    progress.stage("medium", 0);
    progress.warning("the phase function was scaled by 1.01.");
    if (openGl.debug != gl::DebugOutput::off)
        openGl.debugSink("buffer 3 will use video memory");
    if (name == "slow.atmo")
        while (!progress.cancelled())
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (progress.cancelled())
        throw Cancelled("cancelled");
    if (name != "good.atmo")
        failLike(name);
    progress.stage("moments", 0.25);
    progress.advance(0.5);
    std::filesystem::create_directories(outDir);
    std::ofstream(outDir / "manifest.json") << "{}";
}

void validate(const atmo::Description& description, const gl::HeadlessOptions&)
{
    if (const std::string& name = description.scatterers.front().name; name != "good.atmo")
        failLike(name);
}

} // namespace

int main(int argc, char** argv) { return cli::runProgram(argc, argv, {readDescription, plan, solve, validate}); }
