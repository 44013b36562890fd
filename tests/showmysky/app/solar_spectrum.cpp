// Other suns for a model.

#include "solar_spectrum.hpp"

#include "base/error.hpp"
#include "physics/colour.hpp"
#include <catch2/catch.hpp>

using namespace showmysky::app;

namespace {

/// 360 to 830 nm in steps of 5 nm, and a sun of any shape on them.
const std::vector<double> wavelengths = [] {
    std::vector<double> nm;
    for (int i = 0; i <= 94; ++i)
        nm.push_back(360 + 5 * i);
    return nm;
}();
const std::vector<double> irradiance = [] {
    std::vector<double> values;
    for (const double nm : wavelengths)
        values.push_back(2 - 1e-3 * nm);
    return values;
}();

std::vector<double> sun(const SolarSpectrum& spectrum)
{
    auto values = solarFactors(spectrum, wavelengths, irradiance);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= irradiance[i];
    return values;
}

sky::physics::XYZ colour(const std::vector<double>& spectrum)
{
    const auto weights = sky::physics::luminanceWeights(wavelengths);
    sky::physics::XYZ sum{};
    for (std::size_t i = 0; i < spectrum.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += weights[i][c] * spectrum[i];
    return sum;
}

double total(const std::vector<double>& spectrum)
{
    double sum = 0;
    for (std::size_t i = 0; i + 1 < spectrum.size(); ++i)
        sum += 5 * (spectrum[i] + spectrum[i + 1]) / 2;
    return sum;
}

} // namespace

TEST_CASE("solar spectrum: a black body has its own colour temperature")
{
    for (const double temperature : {2000., 3500., 5772., 12000.}) {
        const auto found = sky::physics::correlatedColourTemperature(colour(sun({SolarSpectrum::Kind::blackBody, temperature, {}})));
        REQUIRE(found);
        CHECK(*found == Approx(temperature).epsilon(0.003)); // the 5 nm steps
    }
}

TEST_CASE("solar spectrum: equal energy is the equal-energy point")
{
    const auto xy = sky::physics::chromaticity(colour(sun({SolarSpectrum::Kind::flat, 0, {}})));
    REQUIRE(xy);
    CHECK((*xy)[0] == Approx(1. / 3).margin(1e-4));
    CHECK((*xy)[1] == Approx(1. / 3).margin(1e-4));
}

TEST_CASE("solar spectrum: other suns are as strong as the model's")
{
    CHECK(total(sun({SolarSpectrum::Kind::flat, 0, {}})) == Approx(total(irradiance)));
    CHECK(total(sun({SolarSpectrum::Kind::blackBody, 4000, {}})) == Approx(total(irradiance)));
    CHECK(solarFactors({}, wavelengths, irradiance).empty());
    for (const double factor : solarFactors({SolarSpectrum::Kind::blackBody, 500, {}}, wavelengths, irradiance))
        CHECK((std::isfinite(factor) && factor >= 0));
    CHECK(solarFactors({SolarSpectrum::Kind::flat, 0, {}}, {550}, {1.5}) == std::vector<double>{1});
}

TEST_CASE("solar spectrum: text goes both ways, and wrong text is refused")
{
    for (const char* text : {"model", "flat", "black-body:3500", "1,0.5,2"})
        CHECK(toText(parseSolarSpectrum(text)) == text);
    for (const char* text : {"flatt", "black-body:", "black-body:nan", "black-body:1", "1,-2", "1,x"})
        CHECK_THROWS_AS(parseSolarSpectrum(text), sky::UsageError);
    CHECK_THROWS_AS(solarFactors(parseSolarSpectrum("1,2"), wavelengths, irradiance), sky::UsageError);
}
