// Where the nodes of the tables stand: on the horizon from both sides, at both ends, and back from a place to its
// index.
#include "physics/table_axes.hpp"
#include "base/angles.hpp"
#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>

using namespace sky::physics;

namespace {

using sky::base::pi;
const Planet earth{6.371e6, 120e3}, shallow{1e10, 1.}, swollen{1e5, 1e6};

} // namespace

TEST_CASE("table axes: altitudes reach from the ground to the top, evenly in the distance to the horizon")
{
    for (const Planet& planet : {earth, shallow, swollen})
        for (const int count : {2, 3, 32}) {
            const auto h = altitudeNodes(planet, count);
            INFO("R " << planet.radius << " H " << planet.topOfAtmosphere << " count " << count);
            REQUIRE(h.size() == static_cast<std::size_t>(count));
            CHECK(h.front() == 0);
            CHECK(h.back() == planet.topOfAtmosphere);
            const double whole = std::sqrt(radiusExcessSquared(planet, planet.topOfAtmosphere));
            for (int i = 0; i < count; ++i)
                CHECK(std::sqrt(radiusExcessSquared(planet, h[i])) ==
                      Approx(whole * i / (count - 1)).epsilon(1e-12)); // no radii subtracted
        }
}

TEST_CASE("table axes: both halves of the views have a node on the horizon, and reach nadir and zenith")
{
    for (const Planet& planet : {earth, shallow, swollen})
        for (const double share : {0., 1e-6, 0.3, 1.})
            for (const int count : {4, 6, 128}) {
                const double h = share * planet.topOfAtmosphere, horizon = horizonElevation(planet, h);
                const auto mu = viewMuNodes(planet, h, count);
                INFO("R " << planet.radius << " h " << h << " count " << count);
                REQUIRE(mu.size() == static_cast<std::size_t>(count));
                CHECK(mu.front() == Approx(-1).margin(1e-15));
                CHECK(mu.back() == Approx(1).margin(1e-15));
                CHECK(mu[count / 2 - 1] == std::sin(horizon));
                CHECK(mu[count / 2] == std::sin(horizon));
                CHECK(std::is_sorted(mu.begin(), mu.end()));
                // Apart from the two on the horizon no two are the same: every texel tells something.
                CHECK(std::adjacent_find(mu.begin(), mu.begin() + count / 2) == mu.begin() + count / 2);
                CHECK(std::adjacent_find(mu.begin() + count / 2, mu.end()) == mu.end());
            }
}

TEST_CASE("table axes: angles from the horizon are fine at the horizon and end on their range exactly")
{
    for (const double range : {0.01, 1., pi / 2, 3.1}) {
        const auto x = horizonAngleNodes(range, 64);
        CHECK(x.front() == 0);
        CHECK(x.back() == range);
        for (std::size_t k = 2; k < x.size(); ++k)
            CHECK(x[k] - x[k - 1] > x[k - 1] - x[k - 2]);
    }
    // A pixel of 64 over the whole sky would be 1.4 degrees high.
    CHECK(horizonAngleNodes(pi / 2, 64)[1] * 180 / pi < 0.2);
}

TEST_CASE("table axes: a Sun on a node is at that node's index")
{
    for (const double depth : {0.01, 0.38, 1.})
        for (const Planet& planet : {earth, shallow})
            for (const auto& [share, sunset] : {std::pair{0., 1.}, {0.01, 0.02}, {1., 0.3}}) {
                const double h = share * planet.topOfAtmosphere;
                const SunTableAxis axis = sunTableAxis(depth, sunset);
                const auto suns = sunElevationNodes(planet, h, axis, 32);
                REQUIRE(suns.size() == 32);
                for (int k = 0; k < 32; ++k) {
                    INFO("depth " << depth << " h " << h << " node " << k);
                    CHECK(sunElevationPosition(planet, h, axis, 32, suns[k]) == Approx(k).margin(1e-9)); // roundings of asinh and sinh
                }
                CHECK(suns.back() == Approx(pi / 2));
                // The dark end is `depth` below the horizon of the ground, and in proportion to the range above it
                // elsewhere.
                const double horizon = horizonElevation(planet, h);
                CHECK(suns.front() == Approx(horizon - depth * (pi / 2 - horizon) / (pi / 2)));
                CHECK(sunElevationPosition(planet, h, axis, 32, suns.front() - 1e-6) < 0);
            }
}

TEST_CASE("table axes: the Sun's horizon is the same share of the way at every altitude")
{
    const SunTableAxis axis = sunTableAxis(0.38);
    const double atHorizon = -axis.vDark / (1 - axis.vDark) * 31;
    for (const double h : {0., 10., 1e4, 120e3})
        CHECK(sunElevationPosition(earth, h, axis, 32, horizonElevation(earth, h)) == Approx(atHorizon));
}

TEST_CASE("table axes: a sunset meets as many Suns of a table on any planet")
{
    constexpr double usual = 0.15;
    for (const double sunset : {1., 0.3, 0.03, 0.003}) {
        const double angle = sunset * usual;
        const SunTableAxis axis = sunTableAxis(2 * angle, sunset);
        INFO("sunset of " << angle);
        CHECK(sunElevationPosition(earth, 0, axis, 32, 0.5 * angle) - sunElevationPosition(earth, 0, axis, 32, -0.5 * angle) > 7);
        CHECK(sunElevationNodes(earth, 0, axis, 32)[29] > 0.5); // noon has its share
    }
}

TEST_CASE("table axes: on a planet that hides nothing the Sun's axis stops at the nadir and stays in order")
{
    const auto suns = sunElevationNodes(swollen, swollen.topOfAtmosphere, sunTableAxis(1.08), 32);
    CHECK(suns.front() == -pi / 2);
    CHECK(std::is_sorted(suns.begin(), suns.end()));
    CHECK(suns.back() == Approx(pi / 2));
}

TEST_CASE("table axes: azimuths go from towards the Sun to away from it")
{
    CHECK(azimuthNodes(2) == std::vector<double>{0, pi});
    const auto nodes = azimuthNodes(8);
    for (int k = 0; k < 8; ++k)
        CHECK(nodes[k] == Approx(pi * k / 7));
}
