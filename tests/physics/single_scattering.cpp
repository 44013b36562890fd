#include "media.hpp"
#include "physics/quadrature.hpp"
#include "physics/sky.hpp"
#include "reference_table.hpp"
#include <catch2/catch.hpp>
#include <functional>

using namespace sky::physics;
using sky::test::pi;

namespace {

struct Sky {
    Medium medium;
    Profile profile;
    Optics optics;
    SunTable sun;
    SkyEvaluator evaluator;
    RayTracer tracer;
    explicit Sky(Medium m)
        : medium(std::move(m)), profile(medium), optics(makeOptics(medium, 4, false)), sun(profile, optics, medium.sunAngularRadius),
          evaluator(medium, profile, optics, sun), tracer(profile, optics)
    {
    }
    Sky(const Sky&) = delete;

    std::vector<double> single(double altitude, double mu, double muSun, double nu)
    {
        std::vector<double> result(optics.wavelengths);
        SkyEvaluator::Parts parts;
        parts.multiple = false;
        evaluator.radiance(tracer, nullptr, altitude, mu, muSun, nu, parts, result.data());
        return result;
    }
};

double cosineBetween(double mu, double muSun, double phi)
{
    return mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(phi);
}

} // namespace

TEST_CASE("single scattering: flat homogeneous air in closed form")
{
    // Light from mu, seen from below: p mu0/(mu0 - mu) (e^(-tau/mu0) - e^(-tau/mu)), from above p mu0/(mu0 + mu) (1 - e^...).
    const double tau = 0.7;
    Sky sky(sky::test::layer(tau, 0.9, 0, sky::test::rayleighPhase));
    for (const double muSun : {1., 0.6, 0.15})
        for (const double mu : {0.95, 0.4, 0.1}) {
            const double nu = cosineBetween(mu, muSun, 1.1), p = 0.9 * sky::test::rayleighPhase(std::acos(nu));
            const double below = p * muSun / (muSun - mu) * (std::exp(-tau / muSun) - std::exp(-tau / mu));
            INFO("muSun " << muSun << " mu " << mu);
            // Sunlight is taken from the middle of cells of up to half an optical depth, and from a table of 96 levels.
            CHECK(sky.single(0, mu, muSun, nu)[0] == Approx(below).epsilon(0.01));
            const double nuDown = cosineBetween(-mu, muSun, 1.1), pDown = 0.9 * sky::test::rayleighPhase(std::acos(nuDown));
            const double above = pDown * muSun / (muSun + mu) * -std::expm1(-tau * (1 / muSun + 1 / mu));
            CHECK(sky.single(1000, -mu, muSun, nuDown)[0] == Approx(above).epsilon(0.01));
        }
}

TEST_CASE("single scattering: a low Sun lights only a skin of thick air, in closed form")
{
    // Seen from above: p mu0/(mu0 + mu), from a part mu0 / tau of the layer. Under the top, and under an edge in a vacuum.
    const double tau = 300;
    const Medium upToTop = sky::test::layer(tau, 1, 0, sky::test::isotropicPhase);
    for (const Medium& medium : {upToTop, sky::test::withDensity(upToTop, {0, 400, 400.0001, 500, 500.0001, 1000}, {0, 0, 10, 10, 0, 0})}) {
        Sky sky(medium);
        for (const double muSun : {0.5, 0.05, 0.005, 0.001})
            for (const double mu : {1., 0.5, 0.1}) {
                INFO("shells " << sky.profile.shells().size() << ", muSun " << muSun << " mu " << mu);
                // Sunlight is taken as linear between nodes, of which each halving of the way to the edge has some.
                CHECK(sky.single(1000, -mu, muSun, -mu * muSun)[0] == Approx(muSun / (muSun + mu) / (4 * pi)).epsilon(0.031));
            }
    }
}

TEST_CASE("single scattering: linear in optical depth when thin")
{
    Sky one(sky::test::exponentialAir(1e-6)), two(sky::test::exponentialAir(2e-6));
    for (const double mu : {1., 0.2, 0.})
        CHECK(two.single(0, mu, 0.5, 0.3)[0] == Approx(2 * one.single(0, mu, 0.5, 0.3)[0]).epsilon(1e-4)); // tau of the horizon 4e-5
}

TEST_CASE("single scattering: spherical exponential air against fine independent quadrature")
{
    // Point-like Sun. Distances, altitudes and columns from vectors in the plane of the ray, radii subtracted.
    const double R = 6.371e6, top = 120e3, tau = 0.4, H = 8e3;
    Sky sky(sky::test::exponentialAir(tau, 0, sky::test::rayleighPhase));
    const double beta = tau / (H * (1 - std::exp(-15.)));
    const auto rule = gaussLegendre(8);
    const auto chord = [&](double r, double mu) { return -r * mu + std::sqrt(r * r * (mu * mu - 1) + (R + top) * (R + top)); };
    const auto depth = [&](double r, double mu, double length) { // panels crowd at the start
        double sum = 0;
        for (int i = 0; i < 40; ++i) {
            const double a = length * std::pow(i / 40., 2), b = length * std::pow((i + 1) / 40., 2);
            for (int q = 0; q < 8; ++q) {
                const double s = 0.5 * (a + b) + 0.5 * (b - a) * rule.nodes[q];
                sum += 0.5 * (b - a) * rule.weights[q] * std::exp(-(std::sqrt(r * r + s * s + 2 * r * mu * s) - R) / H);
            }
        }
        return beta * sum;
    };
    for (const double h : {0., 12e3})
        for (const double sza : {10., 70., 88., 93.})
            for (const double vza : {20., 75., 90.}) {
                const double mu = std::cos(vza * pi / 180), muSun = std::cos(sza * pi / 180), nu = cosineBetween(mu, muSun, 0.8);
                const double r = R + h, length = chord(r, mu);
                double truth = 0;
                for (int i = 0; i < 60; ++i) {
                    const double a = length * std::pow(i / 60., 2), b = length * std::pow((i + 1) / 60., 2);
                    for (int q = 0; q < 8; ++q) {
                        const double s = 0.5 * (a + b) + 0.5 * (b - a) * rule.nodes[q];
                        const double at = std::sqrt(r * r + s * s + 2 * r * mu * s), muSunAt = (r * muSun + s * nu) / at;
                        if (muSunAt < 0 && at * std::sqrt(1 - muSunAt * muSunAt) < R)
                            continue; // in the planet's shadow
                        const double lit = std::exp(-depth(at, muSunAt, chord(at, muSunAt)) - depth(r, mu, s));
                        truth += 0.5 * (b - a) * rule.weights[q] * beta * std::exp(-(at - R) / H) * lit;
                    }
                }
                truth *= sky::test::rayleighPhase(std::acos(nu));
                INFO("h " << h << " SZA " << sza << " VZA " << vza);
                // One exponential is one interval of the profile: cells are half a scale height, and sunlight is taken from
                // their middle. Where it comes through twenty optical depths along the horizon, that is a tenth of little.
                CHECK(sky.single(h, mu, muSun, nu)[0] == Approx(truth).epsilon(0.025).margin(1e-5));
            }
}

TEST_CASE("single scattering: tables by other code, every row")
{
    for (const auto aerosol : {sky::test::Aerosol::Yes, sky::test::Aerosol::No}) {
        Sky sky(sky::test::sampleEarth(aerosol));
        const auto rows = sky::test::referenceTable(aerosol == sky::test::Aerosol::Yes ? "earth_all.csv" : "thin_all.csv");
        REQUIRE(rows.size() == 620);
        double squares = 0, worst = 0;
        for (const auto& row : rows) {
            const double value = sky.single(row.altitude, row.mu, row.muSun, row.nu())[row.wavelength];
            const double off = (value - row.single) / (row.single + row.multiple);
            squares += off * off;
            worst = std::max(worst, std::abs(off));
        }
        CHECK(std::sqrt(squares / 620) < 2.5e-3); // relative to all light; the tables are good to 1e-4, cells to a few 1e-3
        CHECK(worst < 1e-2);
    }
}
