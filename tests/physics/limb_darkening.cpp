#include "physics/limb_darkening.hpp"
#include "media.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

namespace {

/// Sum over a fine polar grid of the disc, each cell asked whether it lies in the Moon.
double brute(double exponent, double b, double d)
{
    const int rings = 1500, sectors = 3000;
    double seen = 0, all = 0;
    for (int i = 0; i < rings; ++i) {
        const double r = (i + 0.5) / rings, light = r * std::pow(1 - r * r, 0.5 * exponent);
        int left = 0;
        for (int k = 0; k < sectors; ++k) {
            const double x = r * std::cos(2 * pi * (k + 0.5) / sectors) - d, y = r * std::sin(2 * pi * (k + 0.5) / sectors);
            left += x * x + y * y > b * b;
        }
        seen += light * left;
        all += light * sectors;
    }
    return seen / all;
}

} // namespace

TEST_CASE("limb darkening: what the Moon leaves against brute force")
{
    const LimbDarkening law({400, 700});
    for (const auto& [b, d] : {std::pair{1.03, 0.1}, {1.03, 0.6}, {1.03, 1.5}, {0.95, 0.02}, {0.95, 0.3}, {0.3, 0.9}}) {
        double left[2];
        law.visible({1, b, d}, left);
        CAPTURE(b, d);
        CHECK(left[0] == Approx(brute(LimbDarkening::exponent(400), b, d)).margin(4e-4)); // cells of the brute sum
        CHECK(left[1] == Approx(brute(LimbDarkening::exponent(700), b, d)).margin(4e-4));
    }
}

TEST_CASE("limb darkening: exponents fall with the wavelength, without steps")
{
    CHECK(LimbDarkening::exponent(550) == Approx(0.508).margin(0.001));
    for (double nm = 303; nm < 1099; ++nm) {
        REQUIRE(LimbDarkening::exponent(nm + 1) < LimbDarkening::exponent(nm) + 1e-3);
        REQUIRE(std::abs(LimbDarkening::exponent(nm + 1) - LimbDarkening::exponent(nm)) < 6e-3);
    }
}

TEST_CASE("limb darkening: a thin crescent is dimmer and redder than the uniform disc has it")
{
    const LimbDarkening law({400, 550, 700});
    double left[3];
    const Discs<double> crescent{1, 1.03, 0.13};
    law.visible(crescent, left);
    CHECK(left[2] < visibleFraction(crescent));
    CHECK(left[0] < left[1]);
    CHECK(left[1] < left[2]);
    CHECK(left[0] > 0);
}

TEST_CASE("limb darkening: exact outside and in totality, continuous at the contacts")
{
    const LimbDarkening law({400});
    double left = -1;
    law.visible({1, 1.03, 2.03}, &left);
    CHECK(left == 1);
    law.visible({1, 1.03, 0.03}, &left);
    CHECK(left == 0);
    law.visible({1, 1.03, 2.0299}, &left);
    CHECK(left == Approx(1).margin(1e-5));
    law.visible({1, 1.03, 0.0301}, &left);
    CHECK(left == Approx(0).margin(1e-5));
    double before = 0;
    for (int i = 0; i <= 4000; ++i) {
        law.visible({1, 1.03, 2.04 * i / 4000}, &left);
        REQUIRE(left >= before - 1e-4); // the quadrature's own error
        REQUIRE(left - before < 2e-3);
        before = left;
    }
}

TEST_CASE("limb darkening: the profile's mean over the disc is one")
{
    const LimbDarkening law({360, 550, 830});
    std::vector<double> sum(3), value(3);
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double square = (i + 0.5) / n; // of the radius: equal areas
        law.profile(std::sqrt(square), value.data());
        for (std::size_t w = 0; w < 3; ++w)
            sum[w] += value[w] / n;
    }
    for (const double mean : sum)
        CHECK(mean == Approx(1).epsilon(1e-3));
}
