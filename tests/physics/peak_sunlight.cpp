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
    Medium medium = sky::test::layer(
        1, 1, 0, [](double angle) { return sky::test::henyeyGreenstein(0.99, angle); }, 1e6, 1e6);
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

TEST_CASE(
    "peaks of sunlight: a skin of air below a sharp edge, among many shells: the table has the light that is followed to each altitude")
{
    // Scene 3 of seed 11 of docs/stress.md at 481 nm: g = 0.99 and isotropic air in two layers of some metres, smoke in the upper one. The table of
    // sunlight has more altitudes than those that are followed; the skin was lit 2.5 times too brightly where they left out the way up to the edge.
    const double top = 17.64, half = 1.7167, middle = 7.4117, step = 1e-4;
    std::vector<double> altitudes{0, 0.2 * top - step, 0.2 * top, 0.3 * top - step, 0.3 * top};
    for (int i = -30; i <= 30; ++i)
        altitudes.push_back(middle + half * i / 30);
    altitudes.insert(altitudes.end(), {0.6 * top - step, 0.6 * top, top});
    std::vector<double> layers, smoke;
    for (const double h : altitudes) {
        layers.push_back(h < 0.2 * top - step / 2 ? 3 : h > 0.3 * top - step / 2 && h < 0.6 * top - step / 2 ? 1 : 0);
        smoke.push_back(std::max(0., 1 - std::pow((h - middle) / half, 2)));
    }
    Medium medium = sky::test::withDensity(sky::test::layer(
                                               1, 1, 0.3, [](double angle) { return sky::test::henyeyGreenstein(0.99, angle); }, 2.7417e7),
                                           altitudes, layers);
    medium.sunAngularRadius = 0.00465;
    medium.species.push_back(sky::test::layer(1, 0.9, 0, sky::test::isotropicPhase).species.front());
    medium.species.push_back(sky::test::layer(1, 0, 0, sky::test::isotropicPhase).species.front());
    medium.species[1].numberDensity = layers;
    medium.species[2].numberDensity = smoke;
    const double extinctions[] = {0.0315, 0.589, 1.31};
    for (int s = 0; s < 3; ++s)
        medium.species[s].extinctionCrossSection = {extinctions[s]};
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 14, true);
    const SunTable sun(profile, optics, medium.sunAngularRadius);
    CHECK(sun.altitudes().size() > 100);
    const SunTable through(profile, PeakSunlight::unscaled(optics), medium.sunAngularRadius);
    PeakSunlight peaks(profile, optics, through, medium.sunAngularRadius);
    for (const double below : {0.01, 0.03, 0.1, 0.3}) {
        const double altitude = 0.6 * top - step - below;
        peaks.place(altitude, false);
        for (const double elevation : {-5e-4, 0., 1e-3, 5e-3}) {
            double followed, told;
            peaks.transmittance(elevation, &followed);
            sun.transmittance(altitude, std::sin(elevation), &told);
            INFO(below << " m below the edge, Sun at " << elevation << " rad");
            CHECK(told == Approx(followed).epsilon(0.15).margin(3e-4));
        }
    }
}

TEST_CASE("peaks of sunlight: what a table takes is known before it is made")
{
    Medium thrown = sky::test::flatShell(), kept = thrown;
    kept.species[0].phaseFunction = sky::test::layer(1, 1, 0, sky::test::isotropicPhase).species[0].phaseFunction;
    for (const Medium& medium : {thrown, kept}) {
        const Profile profile(medium);
        const Optics optics = makeOptics(medium, 14, true);
        const auto cost = SunTable::costOf(profile, optics, medium.sunAngularRadius, 20, 40);
        const SunTable sun(profile, optics, medium.sunAngularRadius, 20, 40);
        CHECK(cost.bytes == double(sun.opticalDepths().size() * sizeof(double)));
        if (PeakSunlight::matters(profile, optics))
            CHECK((cost.peakBytes > 2 * cost.bytes && cost.peakBytes <= 3 * cost.bytes));
        else
            CHECK(cost.peakBytes == cost.bytes);
        CHECK(cost.seconds > 0);
    }
    CHECK(PeakSunlight::matters(Profile(thrown), makeOptics(thrown, 14, true)));
    CHECK_FALSE(PeakSunlight::matters(Profile(kept), makeOptics(kept, 14, true)));
}
