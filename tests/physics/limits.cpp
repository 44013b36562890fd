// Limits in which the radiation field is known: flat and deep, conservative, empty.
#include "media.hpp"
#include "physics/harmonics.hpp"
#include "physics/quadrature.hpp"
#include "physics/source_iteration.hpp"
#include "physics/table_axes.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

namespace {

struct Solution {
    Medium medium;
    Profile profile;
    Optics optics;
    SunTable sun;
    MomentGrid grid;
    Moments moments;
    Solution(Medium m, const MomentSettings& settings, const std::vector<double>& levels, double lowestSun, int events)
        : medium(std::move(m)), profile(medium), optics(makeOptics(medium, settings.degree, settings.truncatePeaks)),
          sun(profile, optics, medium.sunAngularRadius), grid(profile.planet(), levels, lowestSun, settings.suns),
          moments(iterateSource(medium, profile, optics, sun, grid, settings, events))
    {
    }
    /// On the grid that such air gets.
    Solution(Medium m, const MomentSettings& settings, int events)
        : medium(std::move(m)), profile(medium), optics(makeOptics(medium, settings.degree, settings.truncatePeaks)),
          sun(profile, optics, medium.sunAngularRadius),
          grid(profile, largestExtinctions(optics), settings.altitudes, settings.suns, medium.sunAngularRadius),
          moments(iterateSource(medium, profile, optics, sun, grid, settings, events))
    {
    }
    Solution(const Solution&) = delete;

    double radiance(double altitude, double mu, double muSun, double nu) const
    {
        RayTracer tracer(profile, optics);
        const SkyEvaluator sky(medium, profile, optics, sun);
        double result = 0;
        sky.radiance(tracer, &moments, altitude, mu, muSun, nu, {}, &result);
        return result;
    }

    /// Diffuse light that leaves the top, per area; nothing diffuse comes in there. Y_10 = sqrt(3 / 4 pi) mu.
    double escape(double muSun) const
    {
        std::vector<double> field(harmonicCount(moments.degree));
        moments.interpolate(profile.planet().topOfAtmosphere, muSun, field.data());
        return -field[harmonicIndex(1, 0)] / std::sqrt(3 / (4 * pi));
    }
};

std::vector<double> evenLevels(double top, int count)
{
    std::vector<double> levels;
    for (int i = 0; i < count; ++i)
        levels.push_back(top * i / (count - 1));
    return levels;
}

/// Levels that crowd at ground and top: below an edge the field has a logarithm in its slope.
std::vector<double> edgeLevels(double top, int count)
{
    std::vector<double> levels;
    for (int i = 0; i < count; ++i)
        levels.push_back(i + 1 == count ? top : 0.5 * top * (1 - std::cos(pi * i / (count - 1))));
    return levels;
}

/// Few Suns are enough where the air is flat: all nodes of a ray see the same one.
MomentSettings flatSettings(int degree)
{
    MomentSettings s;
    s.suns = 6;
    s.degree = degree;
    s.azimuths = degree + 1;
    s.groundDirections = 8;
    s.limbDirections = 1;
    s.skyDirections = 8;
    s.directNodes = 24;
    s.nodes = 16;
    return s;
}

/// Chandrasekhar's H function for isotropic scattering, from its own integral equation (Radiative Transfer, 1960, ch. V):
/// 1 / H(mu) = sqrt(1 - w) + (w / 2) integral_0^1 mu' H(mu') / (mu + mu') dmu'.
double chandrasekharH(double albedo, double mu)
{
    const auto rule = gaussLegendre(40, 0, 1);
    std::vector<double> h(40, 1.);
    const auto next = [&](double x) {
        double integral = 0;
        for (int i = 0; i < 40; ++i)
            integral += rule.weights[i] * rule.nodes[i] * h[i] / (x + rule.nodes[i]);
        return 1 / (std::sqrt(1 - albedo) + 0.5 * albedo * integral);
    };
    for (int round = 0; round < 200; ++round) {
        std::vector<double> better;
        for (const double x : rule.nodes)
            better.push_back(next(x));
        h = better;
    }
    return next(mu);
}

} // namespace

TEST_CASE("H function: its integral is 2 (1 - sqrt(1 - w)) / w, and it begins at one")
{
    const auto rule = gaussLegendre(20, 0, 1);
    for (const double albedo : {0.2, 0.8, 0.95}) {
        double integral = 0;
        for (int i = 0; i < 20; ++i)
            integral += rule.weights[i] * chandrasekharH(albedo, rule.nodes[i]);
        CHECK(integral == Approx(2 / albedo * (1 - std::sqrt(1 - albedo))).epsilon(1e-4)); // H has a logarithm at mu = 0
        CHECK(chandrasekharH(albedo, 1e-9) == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("isotropic, flat and deep: Chandrasekhar's H function")
{
    const double albedo = 0.8, depth = 8; // e^(-2 k depth) = 1e-5 of the light would see the bottom, k = 0.71
    for (const int degree : {2, 4}) {
        const Solution deep(sky::test::layer(depth, albedo, 0, sky::test::isotropicPhase), flatSettings(degree), edgeLevels(1000, 33),
                            -0.01, 22); // 0.8^22 = 0.7 %, of which few come out
        for (int j = 3; j < 6; ++j) {
            const double muSun = std::sin(deep.grid.sunElevation(j));
            for (const double mu : {0.1, 0.5, 1.}) {
                const double truth = albedo / (4 * pi) * muSun / (mu + muSun) * chandrasekharH(albedo, mu) * chandrasekharH(albedo, muSun);
                INFO("degree " << degree << " muSun " << muSun << " mu " << mu);
                // Cells of half an optical depth along a ray, in which sunlight falls by e^(0.5 / muSun).
                CHECK(deep.radiance(1000, -mu, muSun, 0.1) == Approx(truth).epsilon(0.035));
            }
        }
    }
}

TEST_CASE("isotropic and opaque up to where it ends: the Sun sets on a planet as on Chandrasekhar's half-space")
{
    // At the top the horizon of the ground is 2.6 degrees below the horizontal; where air is so opaque, the Sun, a point, sets at the latter. Of the
    // light that comes before, 0.001 of noon's and less, the planet's curve takes little.
    const double albedo = 0.6, radius = 1.6e7, top = 16e3;
    MomentSettings settings = flatSettings(2);
    settings.altitudes = 8;
    settings.suns = 28;
    settings.directNodes = 64;
    const Solution deep(sky::test::layer(200, albedo, 0, sky::test::isotropicPhase, radius, top), settings, 14);
    for (const double elevation : {0.05, 0.01, 0.004, 0.0017, 0.0009})
        for (const double mu : {0.2, 0.9}) {
            const double muSun = std::sin(elevation);
            const double truth = albedo / (4 * pi) * muSun / (mu + muSun) * chandrasekharH(albedo, mu) * chandrasekharH(albedo, muSun);
            INFO("elevation of the Sun " << elevation << " rad, mu " << mu << "; " << deep.grid.sunCount() << " Suns");
            CHECK(deep.radiance(top, -mu, muSun, 0.1) == Approx(truth).epsilon(0.07));
        }
    CHECK(deep.radiance(top, -0.9, std::sin(-0.0005), 0.1) < 1e-6); // set
}

TEST_CASE("energy: flat air that does not absorb, over white ground, returns all the sunlight")
{
    for (const auto& phase : {sky::test::isotropicPhase, sky::test::rayleighPhase}) {
        const Solution white(sky::test::layer(0.5, 1, 1, phase), flatSettings(2), evenLevels(1000, 9), -0.01, 24);
        for (int j = 2; j < 6; ++j) {
            const double muSun = std::sin(white.grid.sunElevation(j));
            CHECK(white.escape(muSun) == Approx(muSun).epsilon(0.005)); // nodes and levels; the 25th event brings 1e-4
        }
    }
}

TEST_CASE("energy: a whole planet of conservative air and white ground returns all the light it catches")
{
    MomentSettings settings;
    settings.degree = 2;
    settings.altitudes = 12;
    settings.suns = 24;
    settings.groundDirections = 5;
    settings.skyDirections = 6;
    settings.azimuths = 4;
    const Medium medium = sky::test::exponentialAir(0.3, 1, sky::test::rayleighPhase);
    const Planet p{medium.planetRadius, medium.topOfAtmosphere};
    const Solution planet(medium, settings, altitudeNodes(p, settings.altitudes), -0.65,
                          12); // each event leaves less than half: 2e-4 to come
    const double R = p.radius, rTop = p.radius + p.topOfAtmosphere;

    // Caught: the disc of the planet, and beside it what the limb does not let through, in units of pi R^2.
    double caught = 1;
    RayTracer tracer(planet.profile, planet.optics);
    const auto limb = gaussLegendre(40, 0, 1);
    for (int i = 0; i < 40; ++i) {
        const double h = p.topOfAtmosphere * limb.nodes[i];
        double column = 0;
        tracer.columns(h, 0, &column);
        caught += limb.weights[i] * p.topOfAtmosphere * 2 * (R + h) / (R * R) * -std::expm1(-2 * column * planet.optics.extinction[0]);
    }
    // Returned: over the sphere of the top.
    double returned = 0;
    const auto suns = gaussLegendre(200, -1, 1);
    for (int i = 0; i < 200; ++i)
        returned += suns.weights[i] * 2 * rTop * rTop / (R * R) * planet.escape(suns.nodes[i]);
    CHECK(returned == Approx(caught).epsilon(0.01)); // a coarse grid of levels and Suns
}

TEST_CASE("no air: the ground reflects by Lambert's law, and the sky is black")
{
    auto settings = flatSettings(2);
    const Solution bare(sky::test::layer(0, 1, 0.3, sky::test::isotropicPhase), settings, evenLevels(1000, 4), -0.01, 2);
    for (int j = 2; j < 6; ++j) {
        const double muSun = std::sin(bare.grid.sunElevation(j));
        std::vector<double> field(harmonicCount(2));
        bare.moments.interpolate(500, muSun, field.data());
        // Half a sphere of radiance A muSun / pi: I_00 = 2 pi L / sqrt(4 pi), I_10 = -pi L sqrt(3 / 4 pi).
        const double radiance = 0.3 * muSun / pi;
        CHECK(field[0] == Approx(2 * pi * radiance / std::sqrt(4 * pi)).epsilon(2e-3)); // the dip of the horizon at 500 m, 4e-4
        CHECK(field[1] == Approx(-pi * radiance * std::sqrt(3 / (4 * pi))).epsilon(2e-3));
        CHECK(bare.radiance(0, 1, muSun, muSun) == 0);
        CHECK(bare.moments.groundIrradiance[j] == 0);
    }
}
