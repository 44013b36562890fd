// The judge in eclipses: what it sees of the Sun against the closed form, its quadrature against its paths.

#include "physics/eclipse.hpp"
#include "base/error.hpp"
#include "montecarlo/moon.hpp"
#include "montecarlo/reference.hpp"
#include "sample_air.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <sstream>

using namespace sky;
using namespace sky::montecarlo;
using std::numbers::pi;

namespace {

constexpr double degree = pi / 180, astronomicalUnit = 149597870700., lunarRadius = 1737.4e3;

physics::Medium earth()
{
    physics::Medium medium = test::sampleEarth(test::Aerosol::Yes);
    medium.sunAngularRadius = 695700e3 / astronomicalUnit;
    return medium;
}

/// Sun at 50 degrees from the zenith, the Moon `apart` degrees beside it in azimuth.
Query total(double viewZenithDeg, double relativeAzimuthDeg, double apart, double distance = 371925e3)
{
    Query query{0, 50 * degree, viewZenithDeg * degree, relativeAzimuthDeg * degree, 1};
    query.moon = MoonPlace{50 * degree, apart * degree, distance, lunarRadius, astronomicalUnit};
    return query;
}

} // namespace

TEST_CASE("Monte Carlo eclipse: chords see of the Sun what the closed form of two discs says")
{
    const double r = 6371e3;
    const Rule rule = gaussLegendre(32);
    for (const double distance : {371925e3, 400000e3})
        for (const double x : {0., 40e3, 60e3, 300e3, 1200e3, 2500e3, 3200e3, 3700e3}) {
            const Vec sun{0, 0, astronomicalUnit}, moon{0, 0, distance};
            const double radius = 695700e3 / astronomicalUnit;
            const Eclipse eclipse(sun, moon, lunarRadius, radius);
            const Place place{0, normalized({x, 0, std::sqrt(r * r - x * x)})};
            const double seen = eclipse.average(r, place, rule, [](Vec) { return 1.0; });
            const Vec p = r * place.up;
            const double apart = angleBetween(normalized(sun - p), normalized(moon - p));
            const double expected =
                physics::visibleFraction(physics::Discs<double>{radius, std::asin(lunarRadius / length(moon - p)), apart});
            CAPTURE(distance, x);
            CHECK(seen == Approx(expected).epsilon(1e-4).margin(1e-6)); // flat discs against spherical caps
        }
}

TEST_CASE("Monte Carlo eclipse: random points of what is left are seen, and as many as are left")
{
    constexpr int side = 200; // midpoints of a grid of random numbers
    const double r = 6371e3, radius = 695700e3 / astronomicalUnit;
    const Rule rule = gaussLegendre(32);
    for (const double distance : {371925e3, 400000e3})
        for (const double x : {0., 130e3, 300e3, 1200e3, 3200e3, 3700e3}) {
            const Eclipse eclipse({0, 0, astronomicalUnit}, {0, 0, distance}, lunarRadius, radius);
            const Place place{0, normalized({x, 0, std::sqrt(r * r - x * x)})};
            double share = 0, middle = 0;
            for (int i = 0; i < side; ++i)
                for (int k = 0; k < side; ++k) {
                    const auto left = eclipse.pointLeft(r * place.up, (i + 0.5) / side, (k + 0.5) / side);
                    share += left.share / (side * side);
                    middle += left.share * left.point.x / (side * side);
                    if (left.share > 1e-6) // of thinner chords an edge may be met within its rounding
                        REQUIRE_FALSE(eclipse.hides(r * place.up, left.point));
                    REQUIRE(angleBetween(left.point, eclipse.sunFrom(r * place.up).centre()) < radius * (1 + 1e-6));
                }
            const double seen = eclipse.average(r, place, rule, [](Vec) { return 1.0; });
            const double aside = eclipse.average(r, place, rule, [](Vec point) { return point.x; });
            CAPTURE(distance, x);
            CHECK(share == Approx(seen).epsilon(3e-3).margin(1e-6)); // the grid's step at the limb
            CHECK(middle == Approx(aside).epsilon(3e-3).margin(1e-6 * radius));
        }
}

TEST_CASE("Monte Carlo eclipse: the quadrature of order 1 agrees with random paths")
{
    const Reference reference(earth());
    for (const Query& query : {total(88, 180, 0), total(80, 90, 0.1), total(60, 180, 0.35), total(20, 20, 0.4)}) {
        const Result quadrature = reference.radiance(query, {.orders = 1});
        const Result paths = reference.singleByPaths(query, {.relativeError = 0, .maxPaths = 400000, .seed = 3});
        CAPTURE(query.viewZenithAngle, quadrature.single, paths.multiple);
        CHECK(quadrature.single > 0);
        CHECK(std::abs(paths.multiple - quadrature.single) < 4 * paths.multipleStderr + 3 * quadrature.singleStderr);
        CHECK(quadrature.singleStderr < 2e-3 * quadrature.single);
    }
}

TEST_CASE("Monte Carlo eclipse: a Moon that hides nothing changes nothing, one on the Sun much")
{
    const Reference reference(earth());
    Query query = total(40, 60, 20);
    const Settings settings{.orders = 3, .relativeError = 0, .maxPaths = 60000, .seed = 5};
    const Result aside = reference.radiance(query, settings);
    query.moon->relativeAzimuth = 0;
    const Result before = reference.radiance(query, settings);
    query.moon.reset();
    const Result ordinary = reference.radiance(query, settings);
    CHECK(aside.single == Approx(ordinary.single).epsilon(1e-4));
    CHECK(std::abs(aside.multiple - ordinary.multiple) < 4 * std::hypot(aside.multipleStderr, ordinary.multipleStderr));
    CHECK(before.single < 1e-2 * ordinary.single);
    CHECK(before.multiple < 1e-2 * ordinary.multiple);
    CHECK(before.multiple > 0);
}

TEST_CASE("Monte Carlo eclipse: the sky is symmetric about the plane of Sun, Moon and zenith")
{
    const Reference reference(earth());
    Query left = total(70, 50, 0), right = total(70, -50, 0);
    left.moon->zenithAngle = right.moon->zenithAngle = 50.1 * degree;
    CHECK(reference.radiance(left, {.orders = 1}).single == Approx(reference.radiance(right, {.orders = 1}).single).epsilon(1e-6));
}

TEST_CASE("Monte Carlo eclipse: tables name the Moon, impossible Moons are refused")
{
    const Reference reference(earth());
    std::ostringstream table;
    writeCsv(table, {{"earth", 1, total(40, 60, 0), {}}}, reference.medium().wavelengthsNm);
    CHECK(table.str().find("moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m\n") != std::string::npos);
    CHECK(table.str().find(",50,0,371925000\n") != std::string::npos);
    CHECK_THROWS_AS(reference.radiance(total(40, 60, 0, 6400e3), {.orders = 1}), RangeError);
}
