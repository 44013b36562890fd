// Geometry and optical depths of the judge.

#include "montecarlo/profile.hpp"
#include "montecarlo/quadrature.hpp"
#include "sample_air.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace sky;
using namespace sky::montecarlo;

namespace {

double tableAt(const physics::Medium& medium, int wavelength, double altitude)
{
    std::size_t i = 0;
    while (i + 2 < medium.altitudes.size() && medium.altitudes[i + 1] <= altitude)
        ++i;
    const double t = (altitude - medium.altitudes[i]) / (medium.altitudes[i + 1] - medium.altitudes[i]);
    double sum = 0;
    for (const auto& species : medium.species) {
        const double a = species.numberDensity[i], b = species.numberDensity[i + 1];
        const double n = a > 0 && b > 0 ? a * std::pow(b / a, t) : a + t * (b - a);
        sum += n * species.extinctionCrossSection[static_cast<std::size_t>(wavelength)];
    }
    return sum;
}

/// Many short steps straight through the tables.
double bruteDepth(const physics::Medium& medium, int wavelength, double altitude, double mu)
{
    const long double R = static_cast<long double>(medium.planetRadius), r = R + static_cast<long double>(altitude);
    const long double top = R + static_cast<long double>(medium.topOfAtmosphere), b = r * static_cast<long double>(mu);
    const double length = static_cast<double>(std::sqrt(b * b + top * top - r * r) - b);
    const Rule gauss = gaussLegendre(4);
    constexpr int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < 4; ++k) {
            const double s = length * (i + 0.5 + 0.5 * gauss.node[static_cast<std::size_t>(k)]) / steps;
            const long double x = static_cast<long double>(s);
            const double h = static_cast<double>(std::sqrt(r * r + x * x + 2 * b * x) - R);
            sum += 0.5 * gauss.weight[static_cast<std::size_t>(k)] * length / steps * tableAt(medium, wavelength, h);
        }
    return sum;
}

Ray rayAt(const Profile& profile, double altitude, double mu)
{
    return rayFrom(profile.planetRadius(), {altitude, {0, 0, 1}}, {std::sqrt(1 - mu * mu), 0, mu});
}

} // namespace

TEST_CASE("vertical optical depths of the sample atmosphere")
{
    const auto medium = test::sampleEarth(test::Aerosol::Yes);
    const double expected[] = {0.42320 + 0.00533 + 0.00006, 0.17888 + 0.00533 + 0.00732, 0.08811 + 0.00533 + 0.04487,
                               0.04828 + 0.00533 + 0.01562};
    for (int i = 0; i < 4; ++i) {
        const Profile profile(medium, i);
        CHECK(profile.opticalDepthToSpace(rayAt(profile, 0, 1)) == Approx(expected[i]).margin(1.5e-5)); // rounded to 5 digits
        CHECK(profile.shellCount() <= 64);
    }
}

TEST_CASE("optical depth along slanted and grazing rays agrees with many short steps")
{
    const auto medium = test::sampleEarth(test::Aerosol::Yes);
    struct Case {
        double altitude, mu;
    };
    for (const int wavelength : {0, 2}) {
        const Profile profile(medium, wavelength);
        for (const Case c : {Case{0, 1},
                             {0, 0.3},
                             {0, 0},
                             {0, 1e-3},
                             {2000, -0.02},
                             {12e3, 0},
                             {12e3, -0.06},
                             {30e3, -0.09},
                             {30e3, -0.05},
                             {110e3, -0.18},
                             {119.9e3, 0.5}}) {
            INFO("altitude " << c.altitude << " mu " << c.mu << " wavelength " << wavelength);
            // The ozone's wiggles between nodes are smoothed by a few 1e-6 at 579 nm.
            CHECK(profile.opticalDepthToSpace(rayAt(profile, c.altitude, c.mu)) ==
                  Approx(bruteDepth(medium, wavelength, c.altitude, c.mu)).epsilon(5e-6));
        }
    }
}

TEST_CASE("a step of the density is neither smeared nor stepped over")
{
    auto medium = test::flatLayer(0, 1, 0, test::isotropicPhase);
    medium.planetRadius = 6371e3;
    medium.altitudes = {0, 400, 400.001, 420, 420.001, 1000};
    medium.species[0].numberDensity = {0, 0, 1, 1, 0, 0};
    medium.species[0].extinctionCrossSection = {0.1};
    const Profile profile(medium, 0);
    CHECK(profile.opticalDepthToSpace(rayAt(profile, 0, 1)) == Approx(2.0).epsilon(1e-4)); // edges of 1 mm
    CHECK(profile.opticalDepthToSpace(rayAt(profile, 410, 1)) == Approx(1.0).epsilon(1e-4));
    CHECK(profile.opticalDepthToSpace(rayAt(profile, 421, 0.5)) == Approx(0).margin(1e-12));
}

TEST_CASE("a leg's optical depth is the sum over its segments, and distances invert it")
{
    const Profile profile(test::sampleEarth(test::Aerosol::Yes), 2);
    Leg leg;
    for (const double mu : {1.0, 0.0, -0.02, -0.4}) {
        const Ray ray = rayAt(profile, 10e3, mu);
        profile.trace(ray, leg);
        CHECK(leg.hitsGround == (mu < -0.06));
        if (!leg.hitsGround)
            CHECK(leg.opticalDepth == Approx(profile.opticalDepthToSpace(ray)).epsilon(1e-13));
        for (const Segment& segment : leg.segments) {
            const double s = profile.distanceAt(ray, segment, 0.3 * segment.opticalDepth);
            CHECK(profile.partialDepth(ray, segment, s) == Approx(0.3 * segment.opticalDepth).epsilon(1e-8));
        }
    }
}

TEST_CASE("rays at ground level and at the top know their way")
{
    const Profile profile(test::sampleEarth(test::Aerosol::Yes), 0);
    CHECK(!rayAt(profile, 0, 0).hitsGround());
    CHECK(rayAt(profile, 0, -1e-12).hitsGround());
    CHECK(profile.opticalDepthToSpace(rayAt(profile, 120e3, 0)) == Approx(0).margin(1e-15));
    // Altitude recovered to a nanometre from X = h (h + 2R).
    for (const double h : {0.0, 1e-3, 1.0, 1e4, 1.2e5})
        CHECK(altitudeOf(6371e3, radialSquare(6371e3, h)) == Approx(h).margin(1e-9));
}
