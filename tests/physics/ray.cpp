#include "physics/ray.hpp"
#include "media.hpp"
#include "physics/quadrature.hpp"
#include <catch2/catch.hpp>
#include <functional>

using namespace sky::physics;
using sky::test::exponentialAir;
using sky::test::pi;
using sky::test::withDensity;

namespace {

/// A medium with what is needed to follow rays through it.
struct Air {
    Medium medium;
    Profile profile;
    Optics optics;
    RayTracer tracer;
    explicit Air(Medium m, int degree = 4)
        : medium(std::move(m)), profile(medium), optics(makeOptics(medium, degree, true)), tracer(profile, optics)
    {
    }
    Air(const Air&) = delete;

    /// Optical depth to space along a ray that misses the ground, first wavelength.
    double depthToSpace(double altitude, double mu)
    {
        std::vector<double> columns(medium.species.size());
        tracer.columns(altitude, mu, columns.data());
        double tau = 0;
        for (std::size_t s = 0; s < columns.size(); ++s)
            tau += columns[s] * optics.extinction[s * optics.wavelengths];
        return tau;
    }
    RayNodes trace(double altitude, double mu, int count)
    {
        return tracer.trace(altitude, mu, count, hitsGround(profile.planet(), altitude, mu));
    }
};

double sum(const std::vector<double>& values)
{
    double total = 0;
    for (const double v : values)
        total += v;
    return total;
}

Medium shell(double opticalDepth, double albedo = 1) { return sky::test::layer(opticalDepth, albedo, 0, sky::test::isotropicPhase, 6.4e6); }

/// A cloud with step edges from 1 to 2 km, in emptiness.
Medium cloud(double opticalDepth)
{
    auto medium = withDensity(shell(1), {0, 1000, 1000.001, 2000, 2000.001, 12e3}, {0, 0, 1, 1, 0, 0});
    medium.species[0].extinctionCrossSection = {opticalDepth / 1000};
    return medium;
}

} // namespace

TEST_CASE("columns: the zenith column is the integral of the profile")
{
    Air air(exponentialAir(0.7));
    CHECK(air.depthToSpace(0, 1) == Approx(0.7).epsilon(3e-5)); // two Gauss points in cells of half a scale height
    CHECK(air.depthToSpace(8e3, 1) == Approx(0.7 * (std::exp(-1.) - std::exp(-15.)) / (1 - std::exp(-15.))).epsilon(3e-5));
    CHECK(air.depthToSpace(120e3, 1) == 0);
    Air thick(shell(1000));
    CHECK(thick.depthToSpace(0, 1) == Approx(1000).epsilon(1e-12)); // constant: exact
    CHECK(thick.depthToSpace(250, 1) == Approx(750).epsilon(1e-12));
    Air step(cloud(3));
    CHECK(step.depthToSpace(0, 1) == Approx(3).epsilon(2e-6)); // the edges add a millionth
    CHECK(step.depthToSpace(1500, 1) == Approx(1.5).epsilon(2e-6));
    CHECK(step.depthToSpace(5e3, 0.1) == 0);
}

TEST_CASE("columns: horizontal through exponential air, Chapman's closed form")
{
    Air air(exponentialAir(1));
    const double scaleHeight = 8e3, x = 6.371e6 / scaleHeight;
    // Half of the grazing column: r e^x K_1(x); asymptotic series of K_1, next term 1e-10. Above the top lies e^-15 = 3e-7.
    const double bessel = std::sqrt(pi / (2 * x)) * (1 + 3 / (8 * x) - 15 / (128 * x * x) + 105 / (1024 * x * x * x));
    const double vertical = 1 / (1 - std::exp(-15.));
    CHECK(air.depthToSpace(0, 0) == Approx(vertical * x * bessel).epsilon(1e-5));
}

TEST_CASE("columns: homogeneous air is as deep as the way is long, at any angle")
{
    Air air(shell(1));
    const Planet& p = air.profile.planet();
    for (const double h : {0., 1e-4, 1.7, 500., 999.})
        for (const double mu : {horizonMu(p, h), 0.5 * horizonMu(p, h), 0., 1e-6, 0.01, 0.3, 1.})
            CHECK(air.depthToSpace(h, mu) == Approx(distanceToTop(p, h, mu) / 1000).epsilon(1e-12));
}

TEST_CASE("columns: a ray that passes its perigee is twice the way from there, less the way behind the start")
{
    Air air(sky::test::sampleEarth(sky::test::Aerosol::Yes));
    const Planet& p = air.profile.planet();
    for (const double h : {1e3, 12e3, 40e3, 110e3})
        for (const double share : {0., 0.1, 0.5, 0.9, 0.999}) {
            const double mu = share * horizonMu(p, h), r = p.radius + h;
            // Altitude of the perigee: r sin - R, by the product (r sin - R)(r sin + R) = r^2 - R^2 - r^2 mu^2.
            const double q = radiusExcessSquared(p, h) - r * r * mu * mu;
            const double perigee = q / (std::sqrt(p.radius * p.radius + q) + p.radius);
            const double expected = 2 * air.depthToSpace(perigee, 0) - air.depthToSpace(h, -mu);
            INFO("h " << h << " mu " << mu);
            CHECK(air.depthToSpace(h, mu) == Approx(expected).epsilon(3e-5)); // cells fall differently: 1e-5 each
        }
}

TEST_CASE("transmittance multiplies along a path, and is the same both ways")
{
    Air air(sky::test::sampleEarth(sky::test::Aerosol::Yes));
    const Planet& p = air.profile.planet();
    for (const double h : {1e-2, 100., 2e3, 30e3, 120e3})
        for (const double mu : {-1., -0.8, -0.3, 1.0001 * horizonMu(p, h)}) {
            if (!hitsGround(p, h, mu) || mu < -1)
                continue;
            const RayNodes ray = air.trace(h, mu, 16);
            REQUIRE(ray.hitsGround);
            // From the ground back through the start to space: T(ground, space) = T(ground, start) T(start, space).
            const double behind = h < p.topOfAtmosphere ? air.depthToSpace(h, -mu) : 0;
            const double between = air.depthToSpace(0, -ray.ground.mu) - behind;
            INFO("h " << h << " mu " << mu);
            CHECK(ray.groundTransmittance[0] == Approx(std::exp(-between)).epsilon(1e-4)); // 1e-5 of depths up to 10
        }
}

TEST_CASE("ray weights: what a conservative medium scatters into the ray is what it takes out of it")
{
    for (const double depth : {1e-9, 1e-3, 0.5, 4., 50., 1000.}) {
        Air air(shell(depth));
        for (const double mu : {1., 0.2, -0.4}) {
            const double h = mu < 0 ? 700 : 0;
            const RayNodes ray = air.trace(h, mu, 24);
            const double way = mu < 0 ? distanceToGround(air.profile.planet(), h, mu) : distanceToTop(air.profile.planet(), h, mu);
            INFO("depth " << depth << " mu " << mu);
            CHECK(sum(ray.weights) == Approx(-std::expm1(-depth * way / 1000)).epsilon(1e-10)); // telescopes: rounding only
        }
    }
    Air earth(sky::test::sampleEarth(sky::test::Aerosol::No));
    for (const double h : {0., 5e3})
        for (const double mu : {-1., -0.02, 0., 0.1, 1.}) {
            const RayNodes ray = earth.trace(h, mu, 12);
            for (int w = 0; w < 4; ++w) {
                double seen = 0;
                for (int k = 0; k < 12; ++k)
                    seen += ray.weights[k * 4 + w];
                // Ozone only absorbs: less is scattered than lost, and not more than one.
                CHECK(seen >= 0);
                CHECK(seen < 1);
                if (ray.hitsGround)
                    CHECK(seen <= 1 - ray.groundTransmittance[w] + 1e-12);
            }
        }
}

TEST_CASE("ray weights: a thick cloud is finite, seen from below, inside and above")
{
    Air air(cloud(1000));
    for (const double h : {0., 999., 1500., 2001., 11e3})
        for (const double mu : {-1., -0.1, -1e-3, 0., 1e-3, 0.1, 1.})
            for (const int count : {2, 3, 12, 48}) {
                const RayNodes ray = air.trace(h, mu, count);
                REQUIRE(ray.nodes.size() == std::size_t(count));
                for (const double w : ray.weights) {
                    CHECK(std::isfinite(w));
                    CHECK(w >= 0);
                }
                CHECK(sum(ray.weights) < 1 + 1e-12);
            }
    for (const double mu : {0.3, 1.}) // a thousand optical depths let nothing through
        CHECK(sum(air.trace(0, mu, 12).weights) == Approx(1).epsilon(1e-9));
    CHECK(air.trace(5e3, -1, 12).groundTransmittance[0] < 1e-300);
}

TEST_CASE("ray nodes: inside the ray, in order, from its start to its end")
{
    Air air(sky::test::sampleEarth(sky::test::Aerosol::Yes));
    const Planet& p = air.profile.planet();
    for (const double h : {0., 1e-4, 1.7, 100., 20e3, std::nextafter(120e3, 0.), 120e3})
        for (const double mu : {-1., -0.3, horizonMu(p, h), -1e-9, 0., 0.1, 1.}) {
            const RayNodes ray = air.trace(h, mu, 20);
            INFO("h " << h << " mu " << mu);
            double before = -1;
            for (const auto& node : ray.nodes) {
                CHECK(node.altitude >= 0);
                CHECK(node.altitude <= p.topOfAtmosphere * (1 + 1e-12));
                CHECK(std::abs(node.mu) <= 1);
                const double r = p.radius + node.altitude, s = node.nuScale * r;
                CHECK(s >= before);
                before = s;
                CHECK(node.sunScale == Approx((p.radius + h) / r).epsilon(1e-14));
                CHECK(node.altitude == Approx(altitudeAlong(p, h, mu, s)).epsilon(1e-9).margin(1e-6));
            }
            const double length = ray.hitsGround ? distanceToGround(p, h, mu) : distanceToTop(p, h, mu);
            CHECK(ray.nodes.front().nuScale == 0);
            CHECK(before == Approx(length).epsilon(1e-12).margin(1e-9));
            CHECK(ray.nodes.back().altitude == Approx(ray.hitsGround ? 0 : p.topOfAtmosphere).margin(1e-5));
        }
}

TEST_CASE("ray weights: a field that changes linearly along the ray is seen where the light comes from")
{
    Air air(exponentialAir(0.8));
    const Planet& p = air.profile.planet();
    for (const double mu : {1., 0.3, 0.02, 0.}) {
        // Truth: fine panels; field = distance from the start over the whole way.
        const double length = distanceToTop(p, 0, mu), extinction = air.optics.extinction[0];
        const auto rule = gaussLegendre(4);
        double depth = 0, truth = 0;
        const int panels = 4000;
        for (int i = 0; i < panels; ++i) {
            const double a = length * std::pow(double(i) / panels, 2), b = length * std::pow((i + 1.) / panels, 2);
            double panel = 0;
            for (int q = 0; q < 4; ++q)
                panel += 0.5 * (b - a) * rule.weights[q] * extinction *
                         std::exp(-altitudeAlong(p, 0, mu, 0.5 * (a + b) + 0.5 * (b - a) * rule.nodes[q]) / 8e3);
            truth += std::exp(-depth) * -std::expm1(-panel) * 0.5 * (a + b) / length;
            depth += panel;
        }
        for (const int count : {2, 12, 48}) {
            const RayNodes ray = air.trace(0, mu, count);
            double value = 0;
            for (int k = 0; k < count; ++k)
                value += ray.weights[k] * ray.nodes[k].nuScale * (p.radius + ray.nodes[k].altitude) / length;
            INFO("mu " << mu << " nodes " << count);
            CHECK(std::abs(value - truth) < 0.0125); // the field is taken from the middle of cells of 1/20 of the way or less
        }
    }
}

TEST_CASE("ray weights: sunlight in haze that thins out upwards is seen where it comes from")
{
    Air air(sky::test::haze(1.25));
    const auto lit = [](double altitude) { return std::exp(-3 * 1.25 * std::exp(-altitude / 1e3)); };
    const Planet& p = air.profile.planet();
    for (const double mu : {1., 0.3, 0.1}) {
        const double length = distanceToTop(p, 0, mu);
        double depth = 0, truth = 0;
        const int cells = 40000;
        for (int i = 0; i < cells; ++i) {
            const double a = length * std::pow(double(i) / cells, 2), b = length * std::pow((i + 1.) / cells, 2);
            const double h = altitudeAlong(p, 0, mu, 0.5 * (a + b)), cell = (b - a) * 1.25e-3 * std::exp(-h / 1e3);
            truth += std::exp(-depth) * -std::expm1(-cell) * lit(h);
            depth += cell;
        }
        const RayNodes ray = air.trace(0, mu, 200);
        double value = 0;
        for (int k = 0; k < 200; ++k)
            value += ray.weights[k] * lit(ray.nodes[k].altitude);
        INFO("mu " << mu);
        CHECK(value == Approx(truth).epsilon(0.01));
    }
}

TEST_CASE("rays: planets from 100 km to 10 Gm, atmospheres from 1 m to 1000 km, optical depths from 0 to 1000")
{
    for (const double radius : {1e5, 6.4e6, 1e10})
        for (const double top : {1., 1e3, 1e6})
            for (const double depth : {0., 1e-3, 1000.}) {
                Air air(withDensity(sky::test::layer(depth, 1, 0, sky::test::isotropicPhase, radius, top), {0, 0.5 * top, top},
                                    {1, 0.1, 1e-3}));
                const Planet& p = air.profile.planet();
                for (const double h : {0., 1e-4 * top, 0.5 * top, std::nextafter(top, 0.), top}) {
                    const double horizon = horizonMu(p, h);
                    for (const double mu :
                         {-1., horizon - 1e-9, std::nextafter(horizon, -2.), horizon, std::nextafter(horizon, 1.), -1e-12, 0., 1e-3, 1.}) {
                        if (mu < -1)
                            continue;
                        const RayNodes ray = air.trace(h, mu, 12);
                        INFO("R " << radius << " H " << top << " depth " << depth << " h " << h << " mu " << mu);
                        bool sound = true;
                        for (const auto& node : ray.nodes)
                            sound = sound && node.altitude >= 0 && node.altitude <= top * (1 + 1e-9) && std::abs(node.mu) <= 1 &&
                                    node.sunScale > 0 && node.nuScale >= 0;
                        for (const double w : ray.weights)
                            sound = sound && w >= 0 && w <= 1;
                        CHECK(sound);
                        // Where a conservative ray meets the ground, what is not seen is what comes through.
                        if (ray.hitsGround)
                            CHECK(sum(ray.weights) + ray.groundTransmittance[0] == Approx(1).epsilon(1e-9));
                        else {
                            const double tau = air.depthToSpace(h, mu);
                            CHECK(sum(ray.weights) == Approx(-std::expm1(-tau)).epsilon(1e-9).margin(1e-300));
                        }
                    }
                }
            }
}
