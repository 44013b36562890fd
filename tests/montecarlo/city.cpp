// Light of cities: closed form, the even glow as their limit, and random paths at several distances.
#include "physics/city.hpp"
#include "montecarlo/ground_light.hpp"
#include "montecarlo/reference.hpp"
#include "physics/glow_light.hpp"
#include "sample_air.hpp"
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

using namespace sky;
using namespace sky::physics;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180;

/// A layer of 1 km on an Earth: angles at the centre of test::flatLayer's planet would be lost in rounding.
Medium layer(double depth, double albedo, double groundAlbedo, const std::function<double(double)>& phase)
{
    Medium medium = test::flatLayer(depth, albedo, groundAlbedo, phase);
    medium.planetRadius = 6.371e6;
    return medium;
}

struct Town {
    Medium medium;
    CityAir air;
    RayTracer tracer;
    double radius; // angle at the planet's centre
    std::optional<CityField> field;
    Town(Medium m, double metres, bool higherOrders)
        : medium(std::move(m)), air(medium), tracer(air.profile(), air.optics(), 2), radius(metres / medium.planetRadius)
    {
        if (higherOrders)
            field.emplace(air, radius);
    }
    std::vector<double> seen(double distance, double altitude, double viewZenithAngle, double azimuth, bool single = false)
    {
        const double angle = distance / medium.planetRadius, mu = std::cos(viewZenithAngle);
        const CityView view{altitude, mu, angle, mu * std::cos(angle) + std::sin(viewZenithAngle) * std::cos(azimuth) * std::sin(angle),
                            hitsGround(air.profile().planet(), altitude, mu)};
        std::vector<double> result(medium.wavelengthsNm.size());
        cityRadiance(air, field && !single ? &*field : nullptr, radius, view, {tracer, altitude, mu, view.hitsGround}, true, result.data());
        return result;
    }
};

} // namespace

TEST_CASE("city: a small disc lights thin air as its area and the inverse square say")
{
    const double depth = 1e-4, disc = 20;
    Town town(layer(depth, 1, 0, test::isotropicPhase), disc, false);
    for (const double distance : {100., 500., 2000., 5e3}) {
        const double expected = depth / 1000 / (4 * pi) * pi * disc * disc * (1 / distance - 1 / std::hypot(distance, 1000.));
        INFO(distance << " m");
        CHECK(town.seen(distance, 0, 0, 0)[0] == Approx(expected).epsilon(0.015)); // nodes; the disc's own size, 20 m in 100; curvature
    }
}

TEST_CASE("city: one as large as a country makes the sky of an evenly glowing ground", "[slow]")
{
    auto medium = test::sampleEarth(test::Aerosol::Yes);
    Town town(medium, 600e3, true);
    const GlowSettings settings;
    const Profile profile = glowProfile(medium);
    const Optics optics = glowOptics(medium, settings.degree);
    const auto glow = solveGroundGlow(medium, profile, optics, settings);
    const GlowLight light(medium, optics, glow.total);
    RayTracer tracer(profile, optics, settings.cells);
    std::vector<double> whole(medium.wavelengthsNm.size());
    for (const double altitude : {0., 5000.})
        for (const double angle : {0., 60., 80., 150.}) {
            const double mu = std::cos(angle * degree);
            if (altitude == 0 && mu < 0)
                continue;
            light.seen(tracer.cells(altitude, mu, mu < 0, GlowLight::deepest), whole.data());
            const auto seen = town.seen(0, altitude, angle * degree, 0);
            INFO("altitude " << altitude << ", zenith angle " << angle);
            for (const std::size_t w : {0u, 2u})
                CHECK(seen[w] == Approx(whole[w]).epsilon(0.035)); // the field's coarse grid
        }
}

TEST_CASE("city: single and higher orders agree with Monte Carlo at several distances", "[slow]")
{
    const double disc = 5e3;
    Town town(test::sampleEarth(test::Aerosol::Yes), disc, true);
    const montecarlo::Reference judge(town.medium);
    const auto judged = [&](double distance, double altitude, double angle, double azimuth, int orders, int paths) {
        const montecarlo::Query query{
            .altitude = altitude, .viewZenithAngle = angle * degree, .relativeAzimuth = azimuth * degree, .wavelength = 1};
        return judge.groundLight(query, montecarlo::GroundDisc{distance, 0, disc},
                                 {.orders = orders, .relativeError = 0, .maxPaths = paths, .seed = 3});
    };
    struct Place {
        double distance, altitude, angle, azimuth;
    };
    for (const auto& [distance, altitude, angle, azimuth] : {Place{0, 0, 0, 0},
                                                             {0, 3000, 60, 0},
                                                             {5e3, 0, 60, 180},
                                                             {20e3, 0, 0, 0},
                                                             {20e3, 0, 85, 0},
                                                             {50e3, 0, 60, 0},
                                                             {50e3, 3000, 85, 0},
                                                             {100e3, 0, 85, 0},
                                                             {100e3, 0, 60, 180},
                                                             {0, 0, 85, 0},
                                                             {5.2e3, 0, 85, 0}}) { // the last two pass low over the edge
        INFO("distance " << distance << ", altitude " << altitude << ", zenith angle " << angle << ", azimuth " << azimuth);
        const double single = town.seen(distance, altitude, angle * degree, azimuth * degree, true)[1];
        const double all = town.seen(distance, altitude, angle * degree, azimuth * degree)[1];
        const auto one = judged(distance, altitude, angle, azimuth, 1, 1 << 14);
        const auto any = judged(distance, altitude, angle, azimuth, 0, 1 << 14);
        CAPTURE(100 * (single / one.scattered - 1), 100 * one.scatteredStderr / one.scattered, 100 * (all / any.scattered - 1),
                100 * any.scatteredStderr / any.scattered); // errors and noise, per cent
        CHECK(std::abs(single - one.scattered) < 0.05 * one.scattered + 3.5 * one.scatteredStderr);
        CHECK(std::abs(all - any.scattered) < 0.08 * any.scattered + 3.5 * any.scatteredStderr);
    }
}

TEST_CASE("city: the disc itself is seen where it stands, and sets beyond the horizon")
{
    Town town(layer(0.5, 0, 0.3, test::isotropicPhase), 100, false);
    const double angle = pi - std::acos(0.5); // meets the ground 1732 m away
    CHECK(town.seen(1700, 1000, angle, 0)[0] == Approx(std::exp(-1.)).epsilon(1e-3));
    CHECK(town.seen(1600, 1000, angle, 0)[0] == 0);
    CHECK(town.seen(1700, 1000, angle, 0.3)[0] == 0);

    // Straight up, the lowest air that sees the disc is as high as the curvature says: none within 120 km at 2000 km.
    Town earth(test::sampleEarth(test::Aerosol::Yes), 5e3, true);
    double before = 1;
    for (const double distance : {10e3, 30e3, 100e3, 300e3, 1000e3, 2000e3}) {
        const auto light = earth.seen(distance, 0, 0, 0);
        for (const double value : light) {
            CHECK(std::isfinite(value));
            CHECK(value >= 0);
        }
        CHECK(light[1] < before);
        before = light[1];
        CHECK((earth.seen(distance, 0, 0, 0, true)[1] > 0) == (distance < 1500e3));
    }
}

TEST_CASE("city: scenes at the edges stay finite and positive", "[slow]")
{
    std::vector<Medium> media{layer(0, 1, 0.3, test::isotropicPhase), layer(8, 1, 1, test::rayleighPhase)};
    for (const auto& medium : media) {
        Town town(medium, 2000, true);
        const double top = medium.topOfAtmosphere;
        for (const double altitude : {0., 0.5 * top, top})
            for (const double distance : {0., 2000., 50e3})
                for (const double angle : {0., 89.9, 90.1, 120., 180.}) {
                    INFO("altitude " << altitude << ", distance " << distance << ", zenith angle " << angle);
                    for (const double value : town.seen(distance, altitude, angle * degree, 1)) {
                        CHECK(std::isfinite(value));
                        CHECK(value >= 0);
                        CHECK(value < 30); // within fog over snow a lamp may be seen several times
                    }
                }
    }
}
