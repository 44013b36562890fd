// Keys, units, blocks and their variations, by table.
#include <catch2/catch.hpp>

#include "atmo/keys.hpp"
#include "atmo/value.hpp"
#include "base/error.hpp"
#include "sample.hpp"

#include <utility>
#include <vector>

using namespace sky::atmo;
using Catch::Matchers::Contains;

namespace {

double quantity(const std::string& text, Dimension dimension)
{
    const Source source(text, "quantity");
    ValueReader reader(source, {1, 0}, text);
    const double value = reader.quantity(dimension);
    reader.expectEnd();
    return value;
}

} // namespace

TEST_CASE("quantities: every unit of every dimension")
{
    const std::vector<std::pair<std::string, double>> lengths{
        {"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3}, {"m", 1}, {"km", 1e3}, {"Mm", 1e6}, {"Gm", 1e9}, {"AU", 149597870700.0},
    };
    for (const auto& [unit, metres] : lengths) {
        INFO(unit);
        // A unit is one number times a power of ten, so that only one rounding happens.
        CHECK(quantity("1.234 " + unit, Dimension::Length) == Approx(1.234 * metres).epsilon(1e-15));
        CHECK(quantity("1.234" + unit, Dimension::Length) == quantity("+1.234  " + unit, Dimension::Length));
        if (unit != "AU")
            CHECK(quantity("2 " + unit + "^-1", Dimension::ReciprocalLength) == Approx(2 / metres).epsilon(1e-15));
    }
    const std::vector<std::pair<std::string, double>> areas{
        {"am^2", 1e-36}, {"fm^2", 1e-30}, {"pm^2", 1e-24}, {"nm^2", 1e-18}, {"um^2", 1e-12}, {"mm^2", 1e-6},
        {"cm^2", 1e-4},  {"m^2", 1},      {"km^2", 1e6},   {"Mm^2", 1e12},  {"Gm^2", 1e18},
    };
    for (const auto& [unit, squareMetres] : areas) {
        INFO(unit);
        CHECK(quantity("0.5 " + unit, Dimension::Area) == Approx(0.5 * squareMetres).epsilon(1e-15));
    }
}

TEST_CASE("quantities: scientific notation and typographic signs are understood")
{
    CHECK(quantity("1.5e3 km", Dimension::Length) == 1.5e6);
    CHECK(quantity("1.5E-3 km", Dimension::Length) == 1.5);
    CHECK(quantity(".5 m", Dimension::Length) == 0.5);
    CHECK(quantity("550 \u00B5m", Dimension::Length) == Approx(550e-6));
    CHECK(quantity("2 m\u00B2", Dimension::Area) == 2);
    CHECK(quantity("2 km\u207B\u00B9", Dimension::ReciprocalLength) == Approx(2e-3));
}

TEST_CASE("quantities: powers of ten lose nothing")
{
    // The reader divides by powers of ten, which are exact; multiplying by 1e-9 would miss by a unit in the last place.
    CHECK(quantity("360 nm", Dimension::Length) == 360e-9);
    CHECK(quantity("0.3 nm", Dimension::Length) == 0.3e-9);
    CHECK(sample::parse(sample::text).wavelengths == Wavelengths{400, 700, 4});
    CHECK(sample::parse(sample::with("min=400nm, max=700nm", "max = 0.7 um , min = 0.4um")).wavelengths == Wavelengths{400, 700, 4});
}

TEST_CASE("keys: every length and its limits")
{
    for (const LengthKey& key : lengthKeys()) {
        INFO(key.key);
        const std::string name(key.key);
        std::string text = sample::text;
        if (const std::size_t at = text.find(name + ":"); at != std::string::npos)
            text.erase(at, text.find('\n', at) - at + 1);
        else
            CHECK(key.fallback);
        const auto parsed = [&](double metres) {
            char number[64];
            std::snprintf(number, sizeof number, "%.17g", metres);
            Description description = sample::parse(text + name + ": " + number + " m\n");
            return key.field(description);
        };
        CHECK(parsed(key.min) == key.min);
        CHECK(parsed(key.max) == key.max);
        CHECK_THROWS_WITH(parsed(key.min * 0.99), Contains(std::string(key.range)));
        CHECK_THROWS_WITH(parsed(key.max * 1.01), Contains(std::string(key.range)));
        if (key.fallback) {
            Description description = sample::parse(text);
            CHECK(key.field(description) == *key.fallback);
        } else {
            CHECK_THROWS_WITH(sample::parse(text), Contains("has no `" + name + "`"));
        }
    }
}

TEST_CASE("keys: every whole number, its default and its limits")
{
    CHECK(wholeNumberKeys().size() == 22);
    Description defaults = sample::parse(sample::text);
    for (const WholeNumberKey& key : wholeNumberKeys()) {
        INFO(key.key);
        const std::string line = std::string(key.key) + ": ";
        CHECK(key.field(defaults) == key.fallback);
        Description description = sample::parse(sample::text + line + "6\n");
        CHECK(key.field(description) == 6);
        // No other field moved.
        key.field(description) = key.fallback;
        CHECK(description == defaults);
        CHECK_NOTHROW(sample::parse(sample::text + line + std::to_string(key.min) + "\n"));
        CHECK_THROWS_WITH(sample::parse(sample::text + line + std::to_string(key.min - 1) + "\n"),
                          Contains("from " + std::to_string(key.min)));
        CHECK_THROWS_WITH(sample::parse(sample::text + line + std::to_string(key.max + 1) + "\n"),
                          Contains("to " + std::to_string(key.max)));
        CHECK_THROWS_WITH(sample::parse(sample::text + line + "6 km\n"), Contains("end of the line"));
    }
}

TEST_CASE("keys: values of the rest")
{
    const Description d = sample::parse(sample::text);
    CHECK(d.version == 6);
    CHECK(d.scatteringOrders == 4);
    CHECK(d.solarIrradiance == Spectrum{1.5, 1.9, 1.8, 1.4});
    CHECK(d.groundAlbedo == Spectrum{0.1, 0.2, 0.3, 0.4});
    CHECK(d.lightPollutionRadiance.empty());
    REQUIRE(d.scatterers.size() == 1);
    CHECK(d.scatterers[0].name == "molecules");
    CHECK(d.scatterers[0].singleScatteringAlbedo == Spectrum(4, 1.0));
    CHECK(d.scatterers[0].phaseFunctionType == PhaseFunctionType::General);
    CHECK_FALSE(d.scatterers[0].needsInterpolationGuides);
    CHECK(d.scatterers[0].crossSectionAt1um == Approx(4.022e-32));
    REQUIRE(d.absorbers.size() == 1);
    CHECK(d.absorbers[0].crossSection == Spectrum{1e-27, 1e-25, 4e-25, 2e-26});

    const auto inScatterer = [](const std::string& line) {
        return sample::parse(sample::with("angstrom exponent: 4", "angstrom exponent: 4\n" + line)).scatterers[0];
    };
    CHECK(inScatterer("phase function type: general").phaseFunctionType == PhaseFunctionType::General);
    CHECK(inScatterer("phase function type: achromatic").phaseFunctionType == PhaseFunctionType::Achromatic);
    CHECK(inScatterer("Phase function type: Smooth # as sky blue").phaseFunctionType == PhaseFunctionType::Smooth);
    CHECK(inScatterer("needs interpolation guides").needsInterpolationGuides);
    CHECK(inScatterer("single scattering albedo: 1, 0.9, 0.8, 0").singleScatteringAlbedo == Spectrum{1, 0.9, 0.8, 0});

    const Description all = sample::parse(sample::with("orders: 4", "orders: All"));
    CHECK(all.allScatteringOrders);
    CHECK(all.scatteringOrders == 0);
    const Description lamp = sample::parse(sample::text + "light pollution relative radiance: 0, 0, 1e-5, 2.5E-5\n");
    CHECK(lamp.lightPollutionRadiance == Spectrum{0, 0, 1e-5, 2.5e-5});
}

TEST_CASE("keys: a person's variations mean the same")
{
    const Description plain = sample::parse(sample::text);
    const std::vector<std::pair<std::string, std::string>> variations{
        {"Earth radius:", "EARTH RADIUS :"},
        {"Earth radius:", "\tearth\tradius:"},
        {"Earth-Sun distance:", "earth sun distance:"},
        {"angstrom exponent:", "\u00C5ngstr\u00F6m exponent:"},
        {"cross section at 1 um:", "cross section at 1um:"},
        {"cross section at 1 um:", "cross section at 1 \u00B5m:"},
        {"Scatterer \"molecules\":", "scatterer   \"molecules\"  :"},
        {"Scatterer \"molecules\":\n{", "Scatterer \"molecules\": {   # on the same line"},
        {"Scatterer \"molecules\":\n{", "Scatterer \"molecules\":\n\n  # before it\n  { # and after"},
        {"angstrom exponent: 4\n}", "angstrom exponent: 4\n  }  # the end"},
        {"number density:\n    ```", "number density: ```"},
        {"number density:\n    ```", "number density:\n\n# here\n```glsl"},
        {"km));\n    ```", "km));\n\t```   # done"},
        {"scattering orders: 4", "scattering orders:4#5"},
        {"400nm, max=700nm, count=4", "400 nm,MAX=700 nm,Count = 4"},
        {"0.1, 0.2, 0.3, 0.4", "1e-1,2.0e-01 ,  .3,+0.4"},
        {"version: 6", "# a title: with a colon\n\n  Version :  6   # comment"},
    };
    for (const auto& [from, to] : variations) {
        INFO(to);
        CHECK(sample::parse(sample::with(from, to)) == plain);
    }
}

TEST_CASE("text: line ends, byte order mark and a missing last line end do not matter")
{
    const Description plain = sample::parse(sample::text);
    std::string dos, mac;
    for (const char c : sample::text) {
        dos += c == '\n' ? "\r\n" : std::string(1, c);
        mac += c == '\n' ? '\r' : c;
    }
    CHECK(sample::parse(dos) == plain);
    CHECK(sample::parse(mac) == plain);
    CHECK(sample::parse("\xEF\xBB\xBF" + dos) == plain);
    CHECK(sample::parse(sample::text.substr(0, sample::text.size() - 1)) == plain);
    CHECK(sample::parse(sample::text + "# Gr\u00FC\u00DFe, \xFC in Latin-1\n") == plain);
}

TEST_CASE("keys: their order is free")
{
    const Description plain = sample::parse(sample::text);
    const std::string wavelengths = "wavelengths: min=400nm, max=700nm, count=4\n";
    CHECK(sample::parse(sample::with(wavelengths, "") + wavelengths) == plain);
    const std::size_t species = sample::text.find("Scatterer"), second = sample::text.find("Earth radius");
    CHECK(sample::parse("version: 6\n" + sample::text.substr(species) + sample::text.substr(second, species - second)) == plain);
}

TEST_CASE("code blocks: kept to the letter, with the line where they begin")
{
    const std::string code = "    // H\u00F6he # no comment of ours\n\n#define A { } : \"\n\treturn A;  ";
    const Description d = sample::parse(sample::with("        return 370.0*dobsonUnit/(30.0*km);", code));
    CHECK(d.absorbers[0].numberDensity.text == code);
    CHECK(d.absorbers[0].numberDensity.firstLine == 29);
    CHECK(d.absorbers[0].numberDensity.file == "test.atmo");
    CHECK(d.scatterers[0].phaseFunction.firstLine == 19);
}

TEST_CASE("species: none at all is a legal atmosphere, and their order is kept")
{
    const Description none = sample::parse(sample::text.substr(0, sample::text.find("Scatterer")));
    CHECK(none.scatterers.empty());
    CHECK(none.absorbers.empty());

    std::string text = sample::text;
    const std::string absorber = text.substr(text.find("Absorber"));
    for (int i = 0; i < 3; ++i)
        text += sample::with("ozone", "gas_" + std::to_string(2 - i), absorber);
    const Description many = sample::parse(text);
    REQUIRE(many.absorbers.size() == 4);
    CHECK(many.absorbers[1].name == "gas_2");
    CHECK(many.absorbers[3].name == "gas_0");
    for (int i = 0; i < 64; ++i)
        text += sample::with("ozone", "more" + std::to_string(i), absorber);
    CHECK_THROWS_WITH(sample::parse(text), Contains("too many species"));
}

TEST_CASE("suggestions: near misses are recognised, far ones are not")
{
    CHECK(nearest("grond albedo", topLevelKeys()) == "ground albedo");
    CHECK(nearest("Atmosphere hieght", topLevelKeys()) == "atmosphere height");
    CHECK(nearest("earth moon dist", topLevelKeys()) == "Earth-Moon distance");
    CHECK(nearest("temperature", topLevelKeys()).empty());
    CHECK(nearest("", topLevelKeys()).empty());
    CHECK(nearest(std::string(100000, 'x'), topLevelKeys()).empty());
}

TEST_CASE("errors: the place is counted in characters, from one")
{
    try {
        sample::parse(sample::with("0.1, 0.2", "0.1, \u00FC0.2"));
        FAIL("accepted");
    } catch (const sky::AtmoError& error) {
        CHECK(error.location().file == "test.atmo");
        CHECK(error.location().line == 9);
        CHECK(error.location().column == 21);
    }
}
