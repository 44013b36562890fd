#include "physics/sun.hpp"
#include "media.hpp"
#include "physics/eclipse.hpp"
#include "physics/quadrature.hpp"
#include "physics/ray.hpp"
#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

using namespace sky::physics;
using sky::test::pi;

namespace {

struct Air {
    Medium medium;
    Profile profile;
    Optics optics;
    SunTable sun;
    explicit Air(Medium m)
        : medium(std::move(m)), profile(medium), optics(makeOptics(medium, 4, true)), sun(profile, optics, medium.sunAngularRadius)
    {
    }
    Air(const Air&) = delete;

    double tabulated(double altitude, double elevation, int wavelength) const
    {
        std::vector<double> result(optics.wavelengths);
        sun.transmittance(altitude, std::sin(elevation), result.data());
        return result[wavelength];
    }

    /// Mean over the disc by brute force: horizontal strips of the part above the horizon, each with its own ray. A Moon of the same size
    /// stands lower by `below` radii.
    double brute(double altitude, double elevation, int wavelength, bool onGround = false, double below = 2) const
    {
        RayTracer tracer(profile, optics);
        const double radius = medium.sunAngularRadius, horizon = horizonElevation(profile.planet(), altitude);
        const double from = std::max(-radius, horizon - elevation);
        if (from >= radius)
            return 0;
        std::vector<double> columns(optics.species);
        const int strips = 400;
        double mean = 0;
        for (int i = 0; i < strips; ++i) {
            // Strips crowd at the horizon, where the transmittance falls by factors over the disc.
            const double a = from + (radius - from) * std::pow(double(i) / strips, 2);
            const double b = from + (radius - from) * std::pow((i + 1.) / strips, 2), y = 0.5 * (a + b), e = elevation + y;
            tracer.columns(altitude, std::sin(std::max(e, horizon)), columns.data());
            double tau = 0;
            for (int s = 0; s < optics.species; ++s)
                tau += columns[s] * optics.extinction[s * optics.wavelengths + wavelength];
            const double hidden = std::sqrt(std::max(0., radius * radius - std::pow(y + below * radius, 2)));
            const double width = 2 * std::max(0., std::sqrt(radius * radius - y * y) - hidden) * (b - a) / (pi * radius * radius);
            mean += width * std::exp(-tau) * (onGround ? std::sin(e) : 1);
        }
        return mean;
    }
};

const Air& earth()
{
    static const Air air(sky::test::sampleEarth(sky::test::Aerosol::Yes));
    return air;
}

} // namespace

TEST_CASE("direct sunlight: what the Moon leaves of a low Sun comes through the air from where it stands")
{
    const Air& air = earth();
    const double radius = air.medium.sunAngularRadius;
    std::vector<double> through(static_cast<std::size_t>(air.optics.wavelengths));
    for (const double elevation : {2., 5., 20.})
        for (const double below : {0.2, 0.7, 1.5})
            for (const int w : {0, 2}) {
                const double e = elevation * pi / 180, truth = air.brute(0, e, w, false, below);
                const Discs<double> discs{radius, radius, below * radius};
                air.sun.transmittance(0, std::sin(e), through.data(), middleOfVisible(discs) * std::cos(e));
                CAPTURE(elevation, below, w);
                // The second moment of a crescent is not the disc's.
                CHECK(visibleFraction(discs) * through[static_cast<std::size_t>(w)] == Approx(truth).epsilon(elevation < 3 ? 0.02 : 2e-3));
            }
}

TEST_CASE("direct sunlight: the table against the mean over the disc, through sunrise, from several altitudes")
{
    const Air& air = earth();
    const double radius = air.medium.sunAngularRadius;
    for (const double h : {0., 10., 1500., 9e3, 35e3, 100e3}) {
        const double horizon = horizonElevation(air.profile.planet(), h);
        for (const double above : {-0.9 * radius, -0.5 * radius, 0., 0.5 * radius, 0.99 * radius, 2 * radius, 4 * radius, 0.05, 0.3, 1.2})
            for (const int w : {0, 2}) {
                const double e = std::min(horizon + above, pi / 2), truth = air.brute(h, e, w);
                INFO("h " << h << " above the horizon " << above << " wavelength " << w);
                // Linear interpolation of the depth over 56 x 112 nodes: up to 3 % where a thousandth of the light is left.
                CHECK(air.tabulated(h, e, w) == Approx(truth).epsilon(0.035).margin(1e-6));
            }
    }
}

TEST_CASE("direct sunlight: straight lines of the table are right in the mean, so that they darken no sky")
{
    const auto medium = sky::test::sampleEarth(sky::test::Aerosol::Yes);
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 4, true);
    const SunTable usual(profile, optics, medium.sunAngularRadius),
        fine(profile, optics, medium.sunAngularRadius, 8 * SunTable::usualAltitudes, 8 * SunTable::usualElevations);
    for (const int w : {0, 2}) {
        std::vector<double> some(optics.wavelengths), exact(optics.wavelengths);
        double error = 0, light = 0;
        for (double h = 50; h < 12e3; h *= 1.37)
            for (double above = 0.003; above < 0.2; above *= 1.029) {
                const double mu = std::sin(horizonElevation(profile.planet(), h) + above);
                usual.transmittance(h, mu, some.data());
                fine.transmittance(h, mu, exact.data());
                error += some[w] - exact[w];
                light += exact[w];
            }
        INFO("wavelength " << w << ": " << 100 * error / light << " %");
        CHECK(std::abs(error) < 2e-4 * light); // 6e-4 and 5e-4 by lines through the optical depths themselves
    }
}

TEST_CASE("direct sunlight: in haze, between the levels of the table")
{
    const Air air(sky::test::haze(1.25));
    for (const double h : {15., 60., 120., 230., 480., 800., 1300., 2500.})
        for (const double e : {0.2, 0.37, 0.8, 1.4}) {
            INFO("h " << h << " elevation " << e);
            CHECK(air.tabulated(h, e, 0) == Approx(air.brute(h, e, 0)).epsilon(0.006));
        }
}

TEST_CASE("direct sunlight: a shell of some metres, where the Sun goes out within a tenth of a degree")
{
    // As thick as the Earth's in scale heights, 1500 times thinner in metres: all that the Earth shows in 8 degrees happens in 0.15.
    auto medium = sky::test::exponentialAir(0.5);
    for (double& altitude : medium.altitudes)
        altitude *= 16 / medium.topOfAtmosphere;
    for (double& density : medium.species[0].numberDensity)
        density *= medium.topOfAtmosphere / 16;
    medium.topOfAtmosphere = 16;
    medium.sunAngularRadius = 0;
    const Air air(medium);
    RayTracer tracer(air.profile, air.optics);
    for (const double h : {0., 1.5, 7.3, 15.3})
        for (const double above : {1e-6, 1e-4, 3e-4, 7e-4, 1.1e-3, 2e-3, 4e-3, 0.02, 0.3}) {
            const double e = horizonElevation(air.profile.planet(), h) + above;
            double column = 0;
            tracer.columns(h, std::sin(e), &column);
            INFO("h " << h << " above the horizon " << above);
            CHECK(air.tabulated(h, e, 0) == Approx(std::exp(-column * air.optics.extinction[0])).epsilon(0.03).margin(1e-4));
        }
}

TEST_CASE("direct sunlight: of optical depth 1000 the table resolves what light gets into, and not what lies under it")
{
    const Air air(sky::test::layer(1000, 1, 0, sky::test::isotropicPhase)); // 1000 m
    CHECK(air.sun.altitudes().size() < 56 + 16 * 4); // 20 of optical depth lie in one interval of the evenly spread ones
    for (const double depth : {0.5, 2., 8.}) {
        const double mu = 0.8; // within 2e-3: linear between altitudes
        CHECK(air.tabulated(1000 - depth, std::asin(mu), 0) == Approx(std::exp(-depth / mu)).epsilon(2e-3));
    }
}

TEST_CASE("direct sunlight: a low Sun goes out within metres under a sharp edge of the air")
{
    auto medium = sky::test::layer(3, 1, 0, sky::test::isotropicPhase, 6.4e8,
                                   1000); // a horizontal ray from a metre under the edge: optical depth 100
    medium.sunAngularRadius = 0.00465;
    const Air air(std::move(medium));
    for (const double under : {0.03, 0.3, 1., 3., 8.})
        for (const double elevation : {-0.003, 0., 0.002}) {
            INFO(under << " m under the edge, elevation " << elevation);
            CHECK(air.tabulated(1000 - under, elevation, 0) ==
                  Approx(air.brute(1000 - under, elevation, 0)).epsilon(0.05).margin(1e-8)); // between altitudes
        }
}

TEST_CASE("direct sunlight: air opaque to its top has its horizon there, not at the ground")
{
    // 60 scattering lengths of 16 m under the top, of a thousand; the ground's horizon is seen from there 2.6 degrees below the horizontal.
    const double top = 16e3, beta = 1000 / top, radius = 1.6e7;
    const Air air(sky::test::layer(1000, 1, 0, sky::test::isotropicPhase, radius, top));
    CHECK(air.sun.sunlessAltitude() == Approx(top - std::pow(46 / beta, 2) / (2 * radius)).epsilon(1e-8));
    CHECK(air.sun.horizon(0.5 * top) == 0);
    CHECK(air.sun.horizon(top) == Approx(-46 / beta / radius).epsilon(1e-3));
    for (const double under : {0., 1e-3, 1e-2, 0.1, 1.})
        for (const double elevation : {-2e-5, 1e-4, 3e-4, 7e-4, 2e-3, 8e-3}) {
            INFO(under << " m under the top, elevation " << elevation);
            CHECK(air.tabulated(top - under, elevation, 0) ==
                  Approx(std::exp(-beta * distanceToTop({radius, top}, top - under, std::sin(elevation)))).epsilon(0.04).margin(1e-3));
        }
}

TEST_CASE("direct sunlight: behind a shell so thin that the Sun's light goes out over a tenth of its disc")
{
    // 500 m of fog and 500 m of nothing: the horizon at the top is 0.00056 rad below the ground's.
    auto medium = sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), {0, 500, 500.01, 1000}, {1, 1, 0, 0});
    medium.sunAngularRadius = 0.00465;
    const Air air(std::move(medium));
    for (const double altitude : {500.01, 900.})
        for (const double above : {-0.5, 0., 0.3, 0.8, 1.1, 2.}) {
            INFO(altitude << " m, centre of the disc " << above << " radii above the horizon");
            const double elevation = above * 0.00465 + horizonElevation(air.profile.planet(), altitude);
            CHECK(air.tabulated(altitude, elevation, 0) ==
                  Approx(air.brute(altitude, elevation, 0)).epsilon(0.015)); // between altitudes of the table
        }
}

TEST_CASE("direct sunlight: none before the first edge, the whole disc after the last, never more than came in")
{
    const Air& air = earth();
    const double radius = air.medium.sunAngularRadius;
    for (const double h : {0., 1e-4, 100., 20e3, 120e3}) {
        const double horizon = horizonElevation(air.profile.planet(), h);
        CHECK(air.tabulated(h, horizon - 1.0001 * radius, 2) == 0);
        double before = 0;
        for (double above = -1.1 * radius; above < 0.3; above += 0.1 * radius) {
            const double value = air.tabulated(h, horizon + above, 2);
            CHECK(value >= before * (1 - 1e-12)); // a rising Sun brightens
            CHECK(value <= 1);
            before = value;
        }
    }
    // At the top and above the horizontal no air is in the way.
    CHECK(air.tabulated(120e3, 0.02, 0) == Approx(1).epsilon(1e-9));
}

TEST_CASE("direct sunlight: without air only the edge of the disc is left")
{
    auto medium = sky::test::layer(0, 1, 0, sky::test::isotropicPhase, 6.4e6);
    medium.sunAngularRadius = 0.005;
    const Air air(medium);
    for (const double e : {-0.004, -0.001, 0., 0.003, 0.1, 1.5})
        CHECK(air.tabulated(0, e, 0) == Approx(visibleDiscFraction(e, 0.005)).epsilon(1e-12));
    // Irradiance of the ground by half a disc: integral of y over it, (2/3) radius^3 / (pi radius^2).
    double half = 0;
    air.sun.groundIrradiance(0, &half);
    CHECK(half == Approx(2. / 3 * 0.005 / pi).epsilon(1e-4));
    air.sun.groundIrradiance(std::sin(0.7), &half);
    CHECK(half == Approx(std::sin(0.7)).epsilon(1e-9));
}

TEST_CASE("direct sunlight: a point-like Sun is a step at the horizon")
{
    auto medium = sky::test::exponentialAir(0.2);
    const Air air(medium);
    CHECK(air.tabulated(0, -1e-9, 0) == 0);
    RayTracer tracer(air.profile, air.optics);
    for (const double e : {1e-9, 0.01, 0.3, pi / 2}) {
        double column = 0;
        tracer.columns(0, std::sin(e), &column);
        CHECK(air.tabulated(0, e, 0) == Approx(std::exp(-column * air.optics.extinction[0])).epsilon(1e-3)); // 128 elevations
    }
}

TEST_CASE("direct sunlight on the ground: through sunrise, against the mean over the disc")
{
    const Air& air = earth();
    const double radius = air.medium.sunAngularRadius;
    std::vector<double> value(4);
    for (const double e : {-0.9 * radius, -0.5 * radius, 0., 0.3 * radius, 0.5 * radius, radius, 2 * radius, 0.05, 0.1, 0.2, 0.5, 1.2}) {
        air.sun.groundIrradiance(std::sin(e), value.data());
        INFO("elevation " << e);
        for (const int w : {0, 2})
            CHECK(value[w] == Approx(air.brute(0, e, w, true)).epsilon(3e-3)); // linear interpolation of the depth
    }
}

TEST_CASE("direct sunlight on a horizontal surface: the sum over the disc, through sunset, on the ground and above")
{
    // Strips of even height, each with its own ray and cosine.
    const Air& air = earth();
    const double radius = air.medium.sunAngularRadius;
    RayTracer tracer(air.profile, air.optics);
    std::vector<double> columns(air.optics.species), found(4);
    for (const double h : {0., 300., 9e3})
        for (const double e : {-0.9 * radius, -0.5 * radius, 0., 0.5 * radius, 2 * radius, 0.05, 0.1, 0.3, 0.31, 1.2}) {
            double expected[2] = {0, 0};
            constexpr int strips = 2000;
            for (int i = 0; i < strips; ++i) {
                const double x = 2 * (i + 0.5) / strips - 1, elevation = e + radius * x;
                if (elevation <= 0)
                    continue;
                tracer.columns(h, std::sin(elevation), columns.data());
                for (const int w : {0, 2}) {
                    double tau = 0;
                    for (int s = 0; s < air.optics.species; ++s)
                        tau += columns[s] * air.optics.extinction[s * air.optics.wavelengths + w];
                    expected[w / 2] += 4 / (pi * strips) * std::sqrt(1 - x * x) * std::exp(-tau) * std::sin(elevation);
                }
            }
            sunOnSurface(air.profile, air.optics, radius, h, e, found.data());
            INFO("h " << h << " elevation " << e);
            for (const int w : {0, 2})
                CHECK(found[w] == Approx(expected[w / 2]).epsilon(2e-3)); // what the strips at the limbs leave
        }
    sunOnSurface(air.profile, air.optics, radius, 0, -1.001 * radius, found.data());
    CHECK(found == std::vector<double>(4, 0.));
}

TEST_CASE("direct sunlight: the axis of elevations runs from the lowest Sun that shows to the zenith")
{
    const Air& air = earth();
    for (const double h : {0., 30e3}) {
        const double horizon = horizonElevation(air.profile.planet(), h);
        CHECK(air.sun.axis(horizon - air.medium.sunAngularRadius, horizon) == Approx(0).margin(1e-14)); // a sum rounds
        CHECK(air.sun.axis(-1, horizon) == 0);
        CHECK(air.sun.axis(pi / 2, horizon) == Approx(1));
        CHECK(air.sun.axis(0.2, horizon) > air.sun.axis(0.1, horizon));
    }
}

TEST_CASE("sunlight: its table can be called off at any Sun")
{
    const Air air(sky::test::sampleEarth(sky::test::Aerosol::Yes));
    std::atomic<int> asked = 0;
    const auto stop = [&asked] { return ++asked > 100; };
    CHECK_THROWS_AS(SunTable(air.profile, air.optics, air.medium.sunAngularRadius, 56, 112, stop), sky::base::Stopped);
    CHECK(asked < 100 + 2 * static_cast<int>(std::thread::hardware_concurrency()) + 2);
}
