// Light of a glowing ground: closed forms and laws. Monte Carlo judges it in tests/montecarlo/ground_light.cpp.
#include "media.hpp"
#include "physics/glow_light.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

namespace {

struct Glow {
    Medium medium;
    Profile profile;
    Optics optics;
    GlowField field;
    explicit Glow(Medium m, GlowSettings settings = {}, bool keepEvents = false)
        : medium(std::move(m)), profile(glowProfile(medium)), optics(glowOptics(medium, settings.degree)),
          field(solveGroundGlow(medium, profile, optics, settings, keepEvents))
    {
    }
    Glow(const Glow&) = delete;

    double radiance(double altitude, double mu, int wavelength = 0) const
    {
        RayTracer tracer(profile, optics);
        std::vector<double> result(medium.wavelengthCount());
        GlowLight(medium, optics, field.total)
            .seen(tracer.cells(altitude, mu, hitsGround(profile.planet(), altitude, mu), GlowLight::deepest), result.data());
        return result[wavelength];
    }
    /// Net upward flux, per radiance of the ground: Y_10 = sqrt(3 / 4 pi) mu, and light that is seen below goes up.
    double flux(double altitude) const
    {
        std::vector<double> moments((field.total.degree + 1) * field.total.wavelengths);
        field.total.interpolate(altitude, moments.data());
        return -moments[field.total.wavelengths] / std::sqrt(3 / (4 * pi));
    }
};

} // namespace

TEST_CASE("ground glow: without air the ground shows its own radiance and the sky none")
{
    const Glow bare(sky::test::layer(0, 1, 0.3, sky::test::isotropicPhase));
    for (const double altitude : {0., 500., 1000.}) {
        CHECK(bare.radiance(altitude, -1) == Approx(1).epsilon(1e-12));
        CHECK(bare.radiance(altitude, -0.01) == Approx(1).epsilon(1e-12));
        CHECK(bare.radiance(altitude, 0.01) == 0);
        CHECK(bare.radiance(altitude, 1) == 0);
    }
    CHECK(bare.field.total.groundIrradiance[0] == 0);
}

TEST_CASE("ground glow: thin isotropic air scatters half of its optical depth over the cosine")
{
    for (const double depth : {1e-5, 1e-3}) {
        const Glow thin(sky::test::layer(depth, 0.9, 0, sky::test::isotropicPhase));
        for (const double mu : {0.1, 0.5, 1.}) // the next order is about depth ln depth; the horizon's dip takes 4e-4 of the ground
            CHECK(thin.radiance(0, mu) == Approx(0.9 * depth / 2 / mu).epsilon(12 * depth + 5e-4));
    }
}

TEST_CASE("ground glow: flat air that does not absorb lets out all that a black ground does not take back")
{
    for (const double depth : {0.1, 1., 3.})
        for (const double albedo : {0., 0.5, 1.}) {
            GlowSettings settings;
            settings.tolerance = 1e-5;
            const Glow glow(sky::test::layer(depth, 1, albedo, sky::test::rayleighPhase), settings);
            const double kept = glow.field.total.groundIrradiance[0] * (1 - albedo);
            INFO("optical depth " << depth << ", albedo " << albedo);
            CHECK(glow.flux(1000) == Approx(pi - kept).epsilon(depth < 2 ? 0.0015 : 0.008)); // levels
        }
}

TEST_CASE("ground glow: a planet's air that does not absorb lets out what its ground does not take back")
{
    const Glow planet(sky::test::exponentialAir(0.3, 0.2, sky::test::rayleighPhase));
    const auto& p = planet.profile.planet();
    const double wider = std::pow(1 + p.topOfAtmosphere / p.radius, 2);
    const double given = pi - 0.8 * planet.field.total.groundIrradiance[0];
    CHECK(wider * planet.flux(p.topOfAtmosphere) == Approx(given).epsilon(0.002));
}

TEST_CASE("ground glow: events add up to the whole, and reach a geometric end")
{
    const Glow glow(sky::test::sampleEarth(sky::test::Aerosol::Yes), {}, true);
    const auto& events = glow.field.perEvent;
    REQUIRE(static_cast<int>(events.size()) == glow.field.eventCount + 1);
    CHECK(glow.field.remainder < 3e-4);
    double sum = 0;
    for (const auto& event : events)
        sum += std::exp(event.values[0]);
    const double whole = std::exp(glow.field.total.values[0]);
    CHECK(sum < whole); // by what closing the series adds
    CHECK(sum > 0.99 * whole);
    for (std::size_t e = 2; e < events.size(); ++e)
        CHECK(events[e].values[0] < events[e - 1].values[0]);
}

TEST_CASE("ground glow: scenes at the edges stay finite and positive")
{
    std::vector<Medium> media;
    media.push_back(sky::test::layer(60, 0.999, 1, [](double t) { return sky::test::henyeyGreenstein(0.85, t); })); // fog over snow
    media.push_back(sky::test::layer(200, 1, 1, sky::test::isotropicPhase));
    media.push_back(sky::test::layer(3, 0, 0.5, sky::test::isotropicPhase));
    media.push_back(sky::test::exponentialAir(0.3, 1));
    for (auto& medium : media) {
        GlowSettings settings;
        settings.mostEvents = 8;
        const Glow glow(medium, settings);
        const double top = glow.profile.planet().topOfAtmosphere;
        for (const double altitude : {0., 0.01 * top, 0.5 * top, top})
            for (const double mu : {-1., -0.3, -1e-3, 0., 1e-3, 0.3, 1.}) {
                INFO("altitude " << altitude << ", mu " << mu);
                const double radiance = glow.radiance(altitude, mu);
                CHECK(std::isfinite(radiance));
                CHECK(radiance >= 0);
                CHECK(radiance <
                      160); // air of depth t over white ground that glows holds 1 + 3/4 t in the diffusion limit: 151 at most here
            }
    }
}
