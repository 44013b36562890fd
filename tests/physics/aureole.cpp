#include "physics/aureole.hpp"
#include "media.hpp"
#include "physics/profile.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::layer;
using sky::test::pi;

namespace {

constexpr double width = 0.02, share = 0.6;

/// On the plane that the sphere is near a peak.
double gaussian(double angle, double variance) { return std::exp(-angle * angle / (2 * variance)) / (2 * pi * variance); }

/// A peak of this share in light scattered evenly.
double peaked(double angle) { return share * gaussian(angle, width * width) + (1 - share) / (4 * pi); }

/// The medium's angles, but dense in the peak.
Medium peakedLayer(double opticalDepth)
{
    auto medium = layer(opticalDepth, 1, 0, peaked);
    medium.scatteringAngles.clear();
    for (int k = 0; k <= 2000; ++k)
        medium.scatteringAngles.push_back(pi * std::pow(k / 2000., 2));
    auto& phase = medium.species[0].phaseFunction;
    phase.clear();
    for (const double angle : medium.scatteringAngles)
        phase.push_back(peaked(angle));
    return medium;
}

/// As if the peak and nothing else were truncated.
Optics withoutPeak(const Medium& medium)
{
    Optics optics = makeOptics(medium, 8, false);
    const double all = optics.extinction[0];
    optics.truncation[0] = share;
    optics.extinction[0] = optics.scattering[0] = (1 - share) * all;
    for (int l = 0; l <= optics.degree; ++l)
        optics.moments[l] = l == 0;
    return optics;
}

double factorAt(const Aureole& aureole, const std::vector<double>& depths, double angle, int species = 0)
{
    double factor = 1;
    aureole.multiply(species, angle, depths, &factor);
    return factor;
}

} // namespace

TEST_CASE("aureole: a Gaussian peak is the mean of Gaussians by Poisson's law of the number of events, and far from it nothing changes")
{
    for (const double depth : {0.05, 0.3, 1., 3., 10.}) {
        const auto medium = peakedLayer(depth / share);
        const Profile profile(medium);
        const Optics optics = withoutPeak(medium);
        RayTracer tracer(profile, optics);
        const Aureole aureole(medium, optics);
        const auto depths = aureole.depths(tracer, 0, 1, 0);
        REQUIRE(depths.size() == 1);
        CHECK(depths[0] == Approx(depth).epsilon(1e-3));
        for (const double angle : {0., 0.005, 0.01, 0.02, 0.04, 0.06}) {
            double blurred = 0, probability = std::exp(-depth); // F^(n-1) / n! exp(-F)
            for (int n = 1; n < 60; ++n) {
                blurred += probability / n * gaussian(angle, n * width * width);
                probability *= depth / n;
            }
            const double expected = share * blurred + (1 - share) / (4 * pi);
            INFO("depth " << depth << ", angle " << angle);
            CHECK(factorAt(aureole, depths, angle) * peaked(angle) == Approx(expected).epsilon(0.02)); // nodes of depth
        }
        CHECK(factorAt(aureole, depths, 0.5) == Approx(1).epsilon(0.01));
        for (const double angle : {1.5, pi})
            CHECK(factorAt(aureole, depths, angle) == 1);
    }
}

TEST_CASE("aureole: particles have the same one, described once or as two halves")
{
    const auto whole = layer(4, 1, 0, [](double t) { return sky::test::henyeyGreenstein(0.97, t); });
    auto halves = whole;
    halves.species.push_back(whole.species[0]);
    for (auto& species : halves.species)
        species.extinctionCrossSection[0] /= 2;
    const Optics once = makeOptics(whole, 14, true), twice = makeOptics(halves, 14, true);
    const Profile one(whole), two(halves);
    RayTracer alone(one, once), both(two, twice);
    const Aureole a(whole, once), b(halves, twice);
    REQUIRE(a.any());
    const auto depthsA = a.depths(alone, 0, 0.5, 0.1), depthsB = b.depths(both, 0, 0.5, 0.1);
    CHECK(depthsB[0] == Approx(depthsA[0]).epsilon(1e-6));
    CHECK(factorAt(a, depthsA, 0) < 0.1);
    CHECK(factorAt(a, depthsA, 0.9) == 1);
    for (const double angle : {0., 0.03, 0.1, 0.3})
        for (const int species : {0, 1})
            CHECK(factorAt(b, depthsB, angle, species) == Approx(factorAt(a, depthsA, angle)).epsilon(1e-5));
}

TEST_CASE(
    "aureole: of the air between camera and Sun: none in space, but through the limb; below the horizon that of the horizon; beside a low Sun that of higher views")
{
    const auto medium = layer(
        3, 1, 0, [](double t) { return sky::test::henyeyGreenstein(0.97, t); }, 6.4e6, 1e4);
    const Optics optics = makeOptics(medium, 14, true);
    const Profile profile(medium);
    RayTracer tracer(profile, optics);
    const Aureole aureole(medium, optics);
    const auto towards = [&](double altitude, double muSun, double theta = 0) { return aureole.depths(tracer, altitude, muSun, theta)[0]; };
    const double overhead = towards(0, 1);
    CHECK(overhead == Approx(3 * optics.truncation[0]).epsilon(1e-3));
    CHECK(towards(5e3, 1) == Approx(overhead / 2).epsilon(1e-3));
    CHECK(towards(0, 0) > 10 * overhead);
    CHECK(towards(0, -0.3) == Approx(towards(0, 0)).epsilon(1e-6));
    CHECK(towards(0, std::sin(0.2), 0.3) == Approx(towards(0, std::sin(0.5))).epsilon(1e-9));
    CHECK(towards(0, std::sin(-0.2), 0.3) == Approx(towards(0, std::sin(0.1))).epsilon(1e-9));
    CHECK(towards(0, std::sin(0.2), 3) == Approx(overhead).epsilon(1e-9));
    CHECK(towards(1e4, 1) == 0);
    CHECK(towards(4e5, 0.2) == 0);
    CHECK(towards(4e5, horizonMu({6.4e6, 1e4}, 4e5)) == Approx(2 * towards(0, 0)).epsilon(1e-3));
    CHECK(towards(4e5, horizonMu({6.41e6, 0}, 3.9e5) + 1e-4) == 0); // above the top of the air
}

TEST_CASE("aureole: where nothing is truncated there is nothing to ask")
{
    const auto medium = layer(3, 1, 0, sky::test::rayleighPhase);
    const Optics optics = makeOptics(medium, 8, true);
    const Profile profile(medium);
    RayTracer tracer(profile, optics);
    const Aureole aureole(medium, optics);
    CHECK_FALSE(aureole.any());
    CHECK(aureole.depths(tracer, 0, 1, 0).empty());
    CHECK(factorAt(aureole, {}, 0.01) == 1);
}
