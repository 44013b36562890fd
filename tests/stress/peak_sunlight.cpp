// A low Sun whose light peaks throw out of the shell along which it would have gone on.
#include "../physics/media.hpp"
#include "montecarlo/reference.hpp"
#include "physics/sky.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

TEST_CASE("peaks of sunlight: a Sun at the horizon of a flat shell of g = 0.99 lights what it does by the reference")
{
    const Medium medium = sky::test::flatShell();
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 14, true);
    const SunTable sun(profile, optics, medium.sunAngularRadius);
    const SkyEvaluator sky(medium, profile, optics, sun);
    RayTracer tracer(profile, optics);
    const sky::montecarlo::Reference reference(medium);
    SkyEvaluator::Parts parts;
    parts.multiple = false; // a few per cent of this light, while what a peak has scattered counts as not scattered
    for (const double zenithAngle : {89.97, 90.03, 90.12})
        for (const double view : {22., 57.}) {
            const double degree = pi / 180, scattering = (zenithAngle - view) * degree;
            double light;
            sky.radiance(tracer, nullptr, 20e3, std::cos(view * degree), std::cos(zenithAngle * degree), std::cos(scattering), parts,
                         &light);
            const auto truth = reference.radiance({20e3, zenithAngle * degree, view * degree, 0, 0}, {.relativeError = 0.03, .seed = 5});
            INFO("Sun at " << zenithAngle << ", view " << view << " degrees");
            CHECK(light / (truth.single + truth.multiple) == Approx(1.1).margin(0.25)); // gone straight on: 1.7 to 2.6
        }
}
