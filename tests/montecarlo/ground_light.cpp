// Light from the ground by random paths: closed forms, and judging the moments of the glow.
#include "montecarlo/ground_light.hpp"
#include "montecarlo/reference.hpp"
#include "physics/glow_light.hpp"
#include "sample_air.hpp"
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace sky;
using namespace sky::montecarlo;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180;

Settings fixed(std::int64_t paths, int orders = 0) { return {.orders = orders, .relativeError = 0, .maxPaths = paths, .seed = 11}; }

Query looking(double altitude, double viewZenithAngle, int wavelength = 0, double azimuth = 0)
{
    return {.altitude = altitude, .viewZenithAngle = viewZenithAngle, .relativeAzimuth = azimuth, .wavelength = wavelength};
}

} // namespace

TEST_CASE("ground light: thin flat air scatters half of its optical depth over the cosine")
{
    const Reference thin(test::flatLayer(1e-4, 0.9, 0, test::isotropicPhase));
    const auto light = thin.groundLight(looking(0, std::acos(0.5)), std::nullopt, fixed(1 << 16));
    CHECK(std::abs(light.scattered - 0.9e-4) < 3.5 * light.scatteredStderr + 1e-3 * 0.9e-4);
    CHECK(light.scatteredStderr < 0.01 * light.scattered);
    CHECK(light.direct == 0);
}

TEST_CASE("ground light: the ground itself is dimmed by the air before it, inside the disc only")
{
    const Reference absorber(test::flatLayer(0.7, 0, 0.3, test::isotropicPhase));
    const auto all = absorber.groundLight(looking(1000, pi - std::acos(0.5)), std::nullopt, fixed(256));
    CHECK(all.direct == Approx(std::exp(-1.4)).epsilon(1e-6));
    CHECK(all.scattered == 0);
    // The ray meets the ground 1732 m away in azimuth 0.4.
    const auto seen = [&](double distance, double azimuth) {
        return absorber.groundLight(looking(1000, pi - std::acos(0.5), 0, 0.4), GroundDisc{distance, azimuth, 100}, fixed(256)).direct;
    };
    CHECK(seen(1700, 0.4) == Approx(all.direct).epsilon(1e-12));
    CHECK(seen(1600, 0.4) == 0);
    CHECK(seen(1732, 0.5) == 0);
}

TEST_CASE("ground light: a disc as large as the country is the glowing ground")
{
    const Reference earth(test::sampleEarth(test::Aerosol::Yes));
    for (const double altitude : {0., 3000.}) {
        const auto all = earth.groundLight(looking(altitude, 0.5, 1), std::nullopt, fixed(1 << 15));
        const auto disc = earth.groundLight(looking(altitude, 0.5, 1), GroundDisc{0, 0, 3e6}, fixed(1 << 16));
        CHECK(std::abs(all.scattered - disc.scattered) < 3.5 * std::hypot(all.scatteredStderr, disc.scatteredStderr));
        CHECK(disc.scatteredStderr < 0.02 * disc.scattered);
    }
}

TEST_CASE("ground light: a small disc far below lights thin air as its area and the inverse square say")
{
    // Isotropic, so thin that only one scattering counts: L = w tau / (4 pi top) integral A cos / d^2 ds, cos = h / d.
    const double depth = 1e-4, distance = 2000, radius = 20;
    const Reference thin(test::flatLayer(depth, 1, 0, test::isotropicPhase));
    const auto light = thin.groundLight(looking(0, 0), GroundDisc{distance, 0, radius}, fixed(1 << 15, 1));
    // The integral over h of h / (h^2 + D^2)^(3/2) from 0 to H is 1 / D - 1 / sqrt(D^2 + H^2).
    const double expected = depth / 1000 / (4 * pi) * pi * radius * radius * (1 / distance - 1 / std::hypot(distance, 1000.));
    CHECK(std::abs(light.scattered - expected) < 3.5 * light.scatteredStderr + 2e-3 * expected);
    CHECK(light.scatteredStderr < 0.01 * expected);
}

TEST_CASE("ground glow: moments agree with Monte Carlo, from the ground to space, zenith to nadir")
{
    const auto medium = test::sampleEarth(test::Aerosol::Yes);
    const Reference judge(medium);
    const physics::GlowSettings settings;
    const physics::Profile profile = physics::glowProfile(medium);
    const auto optics = physics::glowOptics(medium, settings.degree);
    const auto field = physics::solveGroundGlow(medium, profile, optics, settings);
    const physics::GlowLight light(medium, optics, field.total);
    physics::RayTracer tracer(profile, optics, settings.cells);
    std::vector<double> value(medium.wavelengthsNm.size());
    double squares = 0, noise = 0;
    int count = 0;
    for (const double altitude : {0., 2000., 12e3, medium.topOfAtmosphere})
        for (const double angle : {0., 60., 85., 89.5, 100., 150.})
            for (const int wavelength : {0, 2}) {
                const double mu = std::cos(angle * degree);
                const bool ground = physics::hitsGround(profile.planet(), altitude, mu);
                if ((altitude == 0 && angle > 90) || (altitude == medium.topOfAtmosphere && !ground))
                    continue;
                const auto truth = judge.groundLight(looking(altitude, angle * degree, wavelength), std::nullopt, fixed(1 << 14));
                light.seen(tracer.cells(altitude, mu, ground, physics::GlowLight::deepest), value.data());
                // Light reflected by the ground in direct view is in the table alone.
                const double reflected = truth.direct * medium.groundAlbedo[wavelength] / pi * field.total.groundIrradiance[wavelength];
                const double whole = truth.direct + truth.scattered + reflected, off = value[wavelength] / whole - 1;
                INFO("altitude " << altitude << ", zenith angle " << angle << ", wavelength " << wavelength << ": " << value[wavelength]
                                 << " for " << whole << " +- " << truth.scatteredStderr);
                CHECK(std::abs(off) < 0.005 + 3.5 * truth.scatteredStderr / whole); // grids and a cut series: docs/light-pollution.md
                squares += off * off;
                noise += std::pow(truth.scatteredStderr / whole, 2);
                ++count;
            }
    const double rms = std::sqrt(std::max(0., squares - noise) / count);
    CAPTURE(rms, std::sqrt(noise / count));
    CHECK(rms < 0.003);
}
