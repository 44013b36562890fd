#include "physics/levels.hpp"
#include "media.hpp"
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

using namespace sky::physics;
using sky::test::layer;
using sky::test::withDensity;

namespace {

constexpr double top = 20e3;

Profile profileOf(const std::vector<double>& altitudes, const std::vector<double>& densities, double tolerance = 3e-4)
{
    return Profile(withDensity(layer(1, 1, 0, sky::test::isotropicPhase, 6.371e6), altitudes, densities), tolerance);
}

/// A layer with edges a centimetre wide, from 1 to 2 km.
Profile cloud() { return profileOf({0, 1000, 1000.01, 2000, 2000.01, top}, {0, 0, 1, 1, 0, 0}); }

/// max(0, 1 - x^2) as the medium is sampled: so that it is log-linear between nodes, down to where they touch; a shell at
/// each of them.
Profile bump()
{
    const double centre = 5e3, width = 1e3;
    std::vector<double> altitudes{0}, densities{0};
    const auto add = [&](double h) {
        altitudes.push_back(h);
        densities.push_back(std::max(0., 1 - (h - centre) * (h - centre) / (width * width)));
    };
    add(centre - width);
    for (double depth = 1e-3; depth < width; depth *= 1.03)
        add(centre - width + depth);
    const auto below = altitudes;
    for (std::size_t k = below.size() - 1; k > 0; --k)
        add(2 * centre - below[k]);
    altitudes.push_back(top);
    densities.push_back(0);
    return profileOf(altitudes, densities, 0);
}

} // namespace

TEST_CASE("bending depth: the optical depth itself near edges, its logarithm far from them, and even between two")
{
    const BendingDepth slab({0, 1000});
    CHECK(slab(0) == 0);
    CHECK(slab(1.5) == Approx(1.5));
    CHECK(slab(1000) == Approx(2 * slab(500)));
    CHECK(slab(1000) - slab(999) == Approx(slab(1)));
    CHECK(slab(400) - slab(200) == Approx(slab(200) - slab(100))); // one more doubling of the distance to the edge
    double before = 0;
    for (double depth = 0.5; depth <= 1000; depth += 0.5) {
        const double now = slab(depth);
        REQUIRE(now > before);
        REQUIRE(now <= before + 0.5 + 1e-12);
        before = now;
    }
    const BendingDepth two({0, 300, 300, 1000}); // also where two edges meet
    CHECK(two(300) == Approx(2 * slab(150)).epsilon(1e-12));
    CHECK(two(1000) - two(300) == Approx(BendingDepth({0, 700})(700)).epsilon(1e-12));
}

TEST_CASE("field levels: inside a cloud their number grows with the logarithm of its depth, and never beyond a bound")
{
    const auto count = [](double depth, int even) {
        const auto levels = fieldLevels(cloud(), {depth / 1000}, even);
        CHECK(levels.front() == 0);
        CHECK(levels.back() == top);
        CHECK(std::adjacent_find(levels.begin(), levels.end(), std::greater_equal<>()) == levels.end());
        return static_cast<int>(levels.size());
    };
    const int at10 = count(10, 14), at100 = count(100, 14), at1000 = count(1000, 14);
    CHECK(at10 > count(1, 14));
    CHECK(at100 > at10);
    CHECK(at1000 - at100 == Approx(at100 - at10).margin(6));
    for (const double depth : {1e3, 1e4, 1e6}) {
        CHECK(count(depth, 14) <= 8 * 14);
        CHECK(count(depth, 24) <= 8 * 24);
    }
}

TEST_CASE("field levels: between two of them the field of a cloud bends by less than a bound, also where it is 1000 deep")
{
    const auto levels = fieldLevels(cloud(), {1.}, 24);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
        if (levels[k] < 1000.1 || levels[k + 1] > 1999.9)
            continue;
        const double nearest = std::min(levels[k] - 1000, 2000 - levels[k + 1]); // optical depth from an edge
        INFO("from " << levels[k] << " to " << levels[k + 1] << " m");
        CHECK(levels[k + 1] - levels[k] <= std::max(1., 0.5 * nearest));
    }
    const auto within = [&](double depth) {
        return std::count_if(levels.begin(), levels.end(), [&](double h) { return h > 2000 - depth && h < 2000.1; });
    };
    CHECK(within(1) >= 5); // the skin that light gets into first
    CHECK(within(10) >= 12);
}

TEST_CASE("field levels: where a density goes to zero, hundreds of shells are no jumps")
{
    const Profile air = bump();
    REQUIRE(air.shells().size() > 300);
    const auto levels = fieldLevels(air, {100. / 1333}, 14); // the bump is 100 deep
    const auto atFoot = [](double h) { return std::abs(h - 4000) < 1 || std::abs(h - 6000) < 1; };
    CHECK(std::count_if(levels.begin(), levels.end(), atFoot) <= 8);
    CHECK(levels.size() < 90); // of 112 that there may be
}

TEST_CASE("field levels: dense air without nodes of its own has them where it becomes opaque, seen from above")
{
    // 14 scale heights in one shell, 20 000 deep: what is seen from space is seven of them up.
    const double depth = 2e4, height = 2e3, top = 28e3;
    const Profile profile(sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), {0, top}, {1, std::exp(-14.)}));
    const auto levels = fieldLevels(profile, {depth / height}, 14);
    CHECK(levels.size() <= 8 * 14);
    const auto above = [&](double h) { return depth * std::exp(-h / height); };
    for (std::size_t k = 0; k + 1 < levels.size(); ++k)
        if (above(levels[k + 1]) < 3) {
            INFO(levels[k] << " to " << levels[k + 1] << " m");
            CHECK(above(levels[k]) - above(levels[k + 1]) < 0.7);
        }
}
