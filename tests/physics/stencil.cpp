// What an interpolation must keep: constants, straight lines, parabolas inside, symmetry at mirrors, positivity in
// logarithms.
#include "physics/stencil.hpp"
#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <utility>

using namespace sky::physics;

namespace {

double apply(const Stencil& s, const std::function<double(int)>& value)
{
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        sum += s.weight[i] * value(s.index[i]);
    return sum;
}

std::array<double, 4> gathered(const Stencil& s, const std::function<double(int)>& value)
{
    return {value(s.index[0]), value(s.index[1]), value(s.index[2]), value(s.index[3])};
}

} // namespace

TEST_CASE("stencil: weights sum to one and straight lines stay straight, at the ends too")
{
    for (const int n : {2, 3, 4, 9})
        for (double x = 0; x <= n - 1; x += 0.0625) {
            const Stencil s = uniformStencil(x, n);
            INFO("n " << n << " position " << x);
            for (const int i : s.index)
                CHECK((i >= 0 && i < n));
            CHECK(apply(s, [](int) { return 1.; }) == Approx(1).margin(1e-14));
            CHECK(apply(s, [](int i) { return 3. * i - 5; }) == Approx(3 * x - 5).margin(1e-13));
            if (x >= 1 && x <= n - 2) // Catmull-Rom: inside, parabolas too
                CHECK(apply(s, [](int i) { return double(i) * i; }) == Approx(x * x).margin(1e-12));
        }
}

TEST_CASE("stencil: at a node it is the node's value, beyond the ends the end's")
{
    const auto value = [](int i) { return std::sin(3. * i) + 2; };
    for (const int n : {2, 5}) {
        for (int k = 0; k < n; ++k)
            CHECK(apply(uniformStencil(k, n), value) == Approx(value(k)).margin(1e-14));
        CHECK(apply(uniformStencil(-0.7, n), value) == Approx(value(0)).margin(1e-14));
        CHECK(apply(uniformStencil(n + 5., n), value) == Approx(value(n - 1)).margin(1e-14));
    }
}

TEST_CASE("stencil: slopes are continuous across nodes")
{
    const auto value = [](int i) { return std::sin(1.3 * i) + 0.1 * i; };
    const double d = 1e-6;
    for (int k = 1; k < 7; ++k) {
        const double before = apply(uniformStencil(k, 8), value) - apply(uniformStencil(k - d, 8), value);
        const double after = apply(uniformStencil(k + d, 8), value) - apply(uniformStencil(k, 8), value);
        CHECK(before / d == Approx(after / d).margin(1e-4)); // second derivative times d, and roundings over d
    }
}

TEST_CASE("stencil: mirrored ends are flat, and cosines of azimuth keep their symmetry")
{
    for (const int n : {2, 3, 8}) {
        const auto value = [n](int i) { return std::cos(3.14159265358979323846 * i / (n - 1)) + 2; };
        for (double x = 0; x <= n - 1; x += 0.125) {
            const Stencil s = mirroredStencil(x, n), mirrored = mirroredStencil(n - 1 - x, n);
            INFO("n " << n << " position " << x);
            for (const int i : s.index)
                CHECK((i >= 0 && i < n));
            CHECK(apply(s, [](int) { return 1.; }) == Approx(1).margin(1e-14));
            CHECK(apply(s, value) - 2 == Approx(2 - apply(mirrored, value)).margin(1e-13)); // cos(pi - phi) = -cos phi
        }
        const double slope = apply(mirroredStencil(1e-6, n), value) - value(0);
        CHECK(std::abs(slope) < 1e-10); // quadratic in the step, not linear
    }
}

TEST_CASE("stencil: exponentials are exact in logarithms, and stay positive where a curve through values would not")
{
    for (double x = 0; x <= 5; x += 0.1) {
        const Stencil s = uniformStencil(x, 6);
        CHECK(interpolateLog(s, gathered(s, [](int i) { return std::exp(-4. * i); })) == Approx(std::exp(-4 * x)).epsilon(1e-12));
        CHECK(interpolateLog(s, gathered(s, [](int i) { return i < 3 ? 1. : 1e-12; })) > 0);
    }
}

TEST_CASE("stencil: light goes on falling towards a dark node as it fell before it, and is zero there")
{
    const auto value = [](int i) { return i < 2 ? 0. : std::exp(3. * i); };
    for (const double x : {0., 0.25, 1., 1.25, 1.5, 1.999, 2., 2.5, 3., 3.75, 4.}) {
        const Stencil s = uniformStencil(x, 5);
        INFO("position " << x);
        const double result = interpolateLog(s, gathered(s, value));
        if (x <= 1)
            CHECK(result == 0);
        else if (x < 2) // one node of the cell is dark
            CHECK(result == Approx((x - 1) * std::exp(3 * x)).epsilon(1e-12));
        else // the dark neighbour is replaced by what the others foretell: a straight line of logarithms
            CHECK(result == Approx(std::exp(3 * x)).epsilon(1e-12));
        CHECK(interpolateLog(s, {0, 0, 0, 0}) == 0);
    }
}

TEST_CASE("stencil: beside darkness it is continuous, finite, positive, and no brighter than the brighter node")
{
    const std::vector<double> values{0, 0, 1e-9, 4, 4.1, 0, 0, 7, 0, 1e-30, 2};
    double before = 0;
    for (double x = 0; x <= 10; x += 1. / 512) {
        const Stencil s = uniformStencil(x, 11);
        const double result = interpolateLog(s, gathered(s, [&](int i) { return values[static_cast<std::size_t>(i)]; }));
        INFO("position " << x);
        CHECK(std::isfinite(result));
        CHECK(result >= 0);
        const auto k = static_cast<std::size_t>(x);
        CHECK(result <= 1.35 * std::max(values[k], values[std::min<std::size_t>(k + 1, 10)]) + 1e-12);
        CHECK(std::abs(result - before) < 0.5); // the steepest: 4 falling to 1e-9 within a cell
        before = result;
    }
}

TEST_CASE("stencil: a Sun near the zenith is interpolated from both sides of it")
{
    // A sky that varies as sin(e - pi/2) cos(phi): odd in the Sun's way past the zenith, where phi turns into pi - phi.
    constexpr int n = 5;
    const auto skyAt = [](double fromZenith, double cosine) { return std::sin(fromZenith) * cosine; };
    for (const double position : {3.2, 3.5, 3.9, 4.}) {
        const auto [s, beyond] = sunStencil(position, n);
        REQUIRE(beyond);
        REQUIRE(s.index[3] == n - 2);
        double sum = 0, weights = 0;
        for (int i = 0; i < 4; ++i) {
            sum += s.weight[i] * skyAt(0.4 * (n - 1 - s.index[i]), i == 3 ? -1 : 1);
            weights += s.weight[i];
        }
        CHECK(weights == Approx(1));
        CHECK(sum == Approx(skyAt(0.4 * (n - 1 - position), 1)).margin(0.002)); // the cubic: 0.4^3 / 60
    }
    CHECK_FALSE(sunStencil(2.5, n).beyondZenith);
    const auto plain = uniformStencil(2.5, n);
    CHECK(sunStencil(2.5, n).stencil.weight == plain.weight);
}

TEST_CASE("stencil: what is no number among the neighbours makes none, and not darkness")
{
    for (const double between : {0., 0.3, 1.})
        for (const double light : {0., 1e-5}) // beside a dark node too
            for (int i = 0; i < 4; ++i)
                for (const double flaw : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
                    std::array<double, 4> values{0.5, 1, light, 0.1};
                    values[static_cast<std::size_t>(i)] = flaw;
                    INFO("neighbour " << i << " at " << between);
                    CHECK_FALSE(std::isfinite(interpolateLog(uniformStencil(3 + between, 9), values)));
                }
    std::array<double, 4> logarithms{0, -1, -2, -3};
    for (double& logarithm : logarithms) {
        const double sound = std::exchange(logarithm, std::numeric_limits<double>::quiet_NaN());
        CHECK(std::isnan(logarithmBetween(uniformStencil(3.3, 9))(logarithms[0], logarithms[1], logarithms[2], logarithms[3])));
        logarithm = sound;
    }
}
