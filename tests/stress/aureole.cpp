// The Sun behind a thin cloud of drops, whose diffraction peak is far narrower than the harmonics reach.
#include "../gl/context_for_tests.hpp"
#include "../solver/hard_air.hpp"
#include "montecarlo/reference.hpp"

using namespace sky;

TEST_CASE("the aureole of the Sun behind a cloud of optical depth 2, low and high, against the reference", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    physics::Medium medium = test::cloud(2);
    for (std::size_t k = 0; k < medium.scatteringAngles.size(); ++k) {
        const double angle = medium.scatteringAngles[k];
        medium.species[1].phaseFunction[k] = 0.5 * test::henyeyGreenstein(0.85, angle) + 0.5 * test::henyeyGreenstein(0.99, angle);
    }
    const physics::MomentSettings settings{12, 24, 14, 4, 3, 6, 16, 48, 8, true};
    const test::World world(medium, settings, 1);
    const auto field =
        solver::iterate(context->api(), world.scene(), world.grid, world.settings, {4, true, 3e-3}, false, [](double) {}).total;
    const physics::Aureole aureole(medium, world.optics);
    const physics::SkyEvaluator sky(medium, world.profile, world.optics, world.sun, &aureole),
        scatteredOnce(medium, world.profile, world.optics, world.sun);
    physics::RayTracer tracer(world.profile, world.optics);
    const montecarlo::Reference reference(medium);
    constexpr double degree = 3.14159265358979323846 / 180;
    for (const double sunZenithAngle : {30., 75.})
        for (const double aside : {0.6, 2., 5.}) {
            const double view = sunZenithAngle - aside;
            const auto truth = reference.radiance({0, sunZenithAngle * degree, view * degree, 0, 0}, {.relativeError = 0.015, .seed = 3});
            const auto seen = [&](const physics::SkyEvaluator& by) {
                double radiance = 0;
                by.radiance(tracer, &field, 0, std::cos(view * degree), std::cos(sunZenithAngle * degree), std::cos(aside * degree), {},
                            &radiance);
                return radiance / (truth.single + truth.multiple);
            };
            INFO("Sun " << sunZenithAngle << ", " << aside << " degrees beside it");
            CHECK(seen(sky) == Approx(1).margin(0.12));
            if (aside < 1) // what single scattering by the peak alone would be
                CHECK(seen(scatteredOnce) > 1.7);
        }
}
