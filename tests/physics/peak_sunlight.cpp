// Sunlight that peaks have thrown aside.
#include "physics/peak_sunlight.hpp"
#include "media.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

TEST_CASE("peaks of sunlight: a narrow Gaussian has the angles of its equal shares, and one that is kept whole none")
{
    const double width = 0.02;
    const auto peaked = [&](double angle) {
        return 0.2 / (4 * pi) + 0.8 * std::exp(-angle * angle / (width * width)) / (pi * width * width);
    };
    const Optics optics = makeOptics(sky::test::layer(1, 1, 0, peaked), 14, true);
    REQUIRE(optics.truncation[0] > 0.7);
    for (int part = 0; part < peakParts; ++part)
        CHECK(optics.peakAngles[part] == Approx(width * std::sqrt(-std::log(1 - (part + 0.5) / peakParts))).epsilon(0.04)); // steps of 2 %
    const Optics gentle = makeOptics(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), 14, true);
    CHECK(gentle.peakAngles == std::vector<double>(peakParts, 0.));
    CHECK_FALSE(PeakSunlight::matters(Profile(sky::test::flatShell()), gentle));
}

TEST_CASE("peaks of sunlight: what they throw nowhere else is what scaled depths let through")
{
    const Medium medium = sky::test::flatShell();
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 14, true);
    REQUIRE(PeakSunlight::matters(profile, optics));
    const SunTable unscaled(profile, PeakSunlight::unscaled(optics), medium.sunAngularRadius, 192, 512);
    RayTracer tracer(profile, optics);
    Optics narrow = optics;
    std::fill(narrow.peakAngles.begin(), narrow.peakAngles.end(), 0.);
    PeakSunlight straight(profile, narrow, unscaled, medium.sunAngularRadius);
    PeakSunlight aside(profile, optics, unscaled, medium.sunAngularRadius);
    for (const double altitude : {0., 3e3, 12e3})
        for (const double elevation : {0.02, 0.05, 0.15, 0.29}) {
            double column, light, thrown;
            tracer.columns(altitude, std::sin(elevation), &column);
            straight.place(altitude, false);
            straight.transmittance(elevation, &light);
            const double scaled = std::exp(-column * optics.extinction[0]);
            INFO("altitude " << altitude << ", elevation " << elevation);
            CHECK(light == Approx(scaled).epsilon(0.12).margin(3e-5));
            if (elevation > 0.2) {
                aside.place(altitude, false);
                aside.transmittance(elevation, &thrown);
                CHECK(thrown == Approx(scaled).epsilon(0.1)); // here they are thrown towards shorter ways as often as towards longer ones
            }
        }
}

TEST_CASE("peaks of sunlight: in air as thick as its planet they are followed to the lowest Sun that shines")
{
    Medium medium = sky::test::layer(1, 1, 0, [](double angle) { return sky::test::henyeyGreenstein(0.99, angle); }, 1e6, 1e6);
    medium.species[0].extinctionCrossSection = {5e-7};
    const Profile profile(medium);
    Optics optics = makeOptics(medium, 14, true);
    std::fill(optics.peakAngles.begin(), optics.peakAngles.end(), 0.);
    const SunTable unscaled(profile, PeakSunlight::unscaled(optics), 0, 192, 512);
    PeakSunlight straight(profile, optics, unscaled, 0);
    RayTracer tracer(profile, optics);
    for (const double elevation : {-0.6, -0.9}) { // the horizon is 60 degrees below the horizontal
        double column, light;
        straight.place(0.99e6, false);
        straight.transmittance(elevation, &light);
        tracer.columns(0.99e6, std::sin(elevation), &column);
        INFO("elevation " << elevation);
        CHECK(light == Approx(std::exp(-column * optics.extinction[0])).epsilon(0.05));
    }
}
