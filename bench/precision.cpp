// Rounding against discretisation of the sky that the moments make, in air that is hard for one or the other.
//
//   bench_precision [--case NAME]...
//
// Rounding: the solver on the GPU (float32) against its twin on the CPU (double), which takes the same steps between the same nodes.
// Discretisation: the twin against itself with every grid half as fine again: levels, Suns, directions, azimuths, nodes, and the table
// of sunlight. The harmonics' degree stays: it changes the question, not the answer, where peaks are truncated.

#include "../tests/solver/hard_air.hpp"
#include "base/error.hpp"
#include "gl/context.hpp"
#include "solver/quality.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>

using namespace sky;

namespace {

void print(const std::string& name, const char* light, const test::SkyDifference& rounding, const test::SkyDifference& steps)
{
    if (rounding.count > 0)
        std::printf("%-31s  %-14s  %.1e  %.1e      %.1e  %.1e\n", name.c_str(), light, rounding.rms(), rounding.largest, steps.rms(),
                    steps.largest);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{"Rounding against discretisation, in air that is hard for one or the other."};
    std::vector<std::string> names;
    app.add_option("--case", names, "these alone");
    CLI11_PARSE(app, argc, argv);
    try {
        const gl::HeadlessContext context{gl::HeadlessOptions{}};
        std::printf("                                                 rounding              discretisation\n"
                    "air                              light           rms      largest      rms      largest\n");
        for (const auto& air : test::hardCases()) {
            if (!names.empty() && std::find(names.begin(), names.end(), air.name) == names.end())
                continue;
            physics::MomentSettings normal = solver::qualityFor("normal", air.medium).moments;
            // Shortcuts that the twin does not take.
            normal.stationTolerance = 0;
            normal.lightAzimuths = 0;
            const test::World world(air.medium, normal, 1), finer(air.medium, normal, 1.5);
            const auto twin = world.seen(world.inDouble(air.events));
            const test::DayAndDusk rounding(world.seen(world.onGpu(context.api(), air.events)), twin);
            const test::DayAndDusk steps(twin, finer.seen(finer.inDouble(air.events)));
            print(air.name, "day", rounding.day, steps.day);
            print("", "late twilight", rounding.dusk, steps.dusk);
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "bench_precision: %s\n", error.what());
        return 1;
    }
}
