// Rounding and discretisation, told apart: bench/precision.cpp measures more of it.
#include "../gl/context_for_tests.hpp"
#include "hard_air.hpp"

using namespace sky;

TEST_CASE("precision: rounding to float32 is far below the error of the grids, from day to late twilight", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    for (const auto& planet :
         {test::HardCase{"giant", test::molecules(1e10, 10e3, 1e3), 2}, test::HardCase{"dwarf", test::molecules(100e3, 60e3, 8e3), 2}}) {
        CAPTURE(planet.name);
        const physics::MomentSettings settings{10, 24, 2, 5, 3, 6, 4, 32, 8, true};
        const test::World world(planet.medium, settings, 1), finer(planet.medium, settings, 1.5);
        const auto twin = world.seen(world.inDouble(planet.events));
        const test::DayAndDusk rounding(world.seen(world.onGpu(context->api(), planet.events)), twin);
        const test::DayAndDusk steps(twin, finer.seen(finer.inDouble(planet.events)));
        CHECK(rounding.day.count > 50);
        // Between one and ten roundings of float32, where a few thousand terms are summed.
        CHECK(rounding.day.rms() < 5e-7);
        CHECK(rounding.dusk.rms() < 1e-6);
        CHECK(rounding.day.largest < 1e-5);
        CHECK(rounding.day.rms() < 1e-3 * steps.day.rms());
    }
}
