#include "physics/colour.hpp"
#include <catch2/catch.hpp>
#include <cmath>

using namespace sky::physics;

namespace {

std::vector<double> grid(double first, double last, int count)
{
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(first + (last - first) * i / (count - 1));
    return nm;
}

template<typename Radiance>
std::array<double, 4> seen(const std::vector<double>& nm, Radiance radiance)
{
    const auto weights = luminanceWeights(nm);
    std::array<double, 4> sum{};
    for (std::size_t i = 0; i < nm.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += weights[i][c] * radiance(nm[i]);
    return sum;
}

XYZ xyz(const std::array<double, 4>& c) { return {c[0], c[1], c[2]}; }

} // namespace

TEST_CASE("matching functions: points of the table, between them, outside")
{
    CHECK(matchingFunctions(555)[1] == 1); // the photopic maximum by definition
    CHECK(matchingFunctions(437.5)[2] == Approx((1.62296 + 1.74706) / 2));
    CHECK(matchingFunctions(360)[0] == 0.0001299);
    CHECK(matchingFunctions(830)[1] == 4.5181e-7);
    for (const double outside : {0., 359.999, 830.001, 1e9, std::nan("")})
        CHECK(matchingFunctions(outside) == std::array<double, 4>{});
}

TEST_CASE("one wavelength: 1 nm of light with the luminous efficacy of its colour")
{
    CHECK(luminanceWeights({555})[0][1] == Approx(683.002));
    CHECK(luminanceWeights({505})[0][3] == Approx(1700.13 * 0.998).epsilon(1e-3)); // V' = 1 at 507 nm
    CHECK(luminanceWeights({1200})[0] == std::array<double, 4>{});
}

TEST_CASE("the equal-energy spectrum is white")
{
    // The sums of the tabulated x, y, z differ by 3.4e-4 at most; the quadrature of a constant is exact on any grid.
    for (const int count : {2, 3, 16, 95, 471}) {
        const auto xy = chromaticity(xyz(seen(grid(360, 830, count), [](double) { return 1.; })));
        REQUIRE(xy);
        CHECK((*xy)[0] == Approx(1 / 3.).epsilon(2e-4));
        CHECK((*xy)[1] == Approx(1 / 3.).epsilon(2e-4));
    }
    // 106.857 nm is the integral of y (CIE 15, 5 nm).
    CHECK(seen(grid(360, 830, 16), [](double) { return 1.; })[1] == Approx(683.002 * 106.857).epsilon(1e-5));
}

TEST_CASE("luminance is exact for radiance that is linear between the wavelengths, whatever the grid")
{
    const auto line = [](double nm) { return 0.2 + 0.003 * (nm - 400); };
    const auto fine = seen(grid(390, 700, 3101), line);
    for (const std::vector<double>& nm : {grid(390, 700, 2), grid(390, 700, 7), {390, 391.333, 555, 700}}) {
        const auto coarse = seen(nm, line);
        for (std::size_t c = 0; c < 4; ++c)
            CHECK(coarse[c] == Approx(fine[c]).epsilon(1e-9));
    }
    // Wavelengths where nothing is seen change nothing, and a grid beyond the table keeps its whole integral.
    const auto flat = [](double) { return 1.; };
    CHECK(seen({200, 2000}, flat)[1] == Approx(seen(grid(360, 830, 95), flat)[1]).epsilon(1e-5));
}

TEST_CASE("colour temperature of black bodies is their temperature")
{
    for (const double temperature : {1500., 2856., 5772., 10000., 20000.}) {
        const auto planck = [&](double nm) { return std::pow(nm / 560, -5) / std::expm1(1.4388e7 / (nm * temperature)); };
        const auto found = correlatedColourTemperature(xyz(seen(grid(360, 830, 471), planck)));
        REQUIRE(found);
        CHECK(*found == Approx(temperature).epsilon(1e-3)); // 1 nm against the 5 nm sums of the locus
    }
}

TEST_CASE("colour temperature: daylight by its name, none for green and black")
{
    const double x = 0.31272, y = 0.32903; // D65, CIE 15
    const auto found = correlatedColourTemperature({x / y, 1, (1 - x - y) / y});
    REQUIRE(found);
    CHECK(*found == Approx(6504).margin(5)); // published 6503.6 to 6504, by the table used
    CHECK_FALSE(correlatedColourTemperature({0.3, 1, 0.1}));
    CHECK_FALSE(correlatedColourTemperature({0, 0, 0}));
    CHECK_FALSE(chromaticity({0, 0, 0}));
}

TEST_CASE("sRGB: its white and its primaries")
{
    const auto light = [](double x, double y, double luminance) { return XYZ{luminance * x / y, luminance, luminance * (1 - x - y) / y}; };
    const auto white = linearSrgb(light(0.3127, 0.3290, 1));
    for (const double component : white)
        CHECK(component == Approx(1).margin(1e-9));
    const auto red = linearSrgb(light(0.64, 0.33, 0.2126390058715104)); // red's share of white's luminance
    CHECK(red[0] == Approx(1).margin(1e-9));
    CHECK(std::abs(red[1]) < 1e-9);
    CHECK(std::abs(red[2]) < 1e-9);
    const auto blue = linearSrgb(light(0.15, 0.06, 0.0721923153607337));
    CHECK(blue[2] == Approx(1).margin(1e-9));
    CHECK(std::abs(blue[0]) < 1e-9);
}

TEST_CASE("sRGB's transfer function: ends, round trip, no step at the joint")
{
    CHECK(encodeSrgb(0) == 0);
    CHECK(encodeSrgb(1) == Approx(1));
    CHECK(encodeSrgb(0.5) == Approx(0.735357).epsilon(1e-6));
    for (const double x : {-0.3, 0., 1e-4, 0.0031, 0.0032, 0.2, 0.999, 4.})
        CHECK(decodeSrgb(encodeSrgb(x)) == Approx(x).margin(1e-12));
    CHECK(encodeSrgb(0.0031309) - encodeSrgb(0.0031307) < 1e-5); // the standard's own constants miss by 3e-8
}
