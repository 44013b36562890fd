// The canonical writer: reading what it wrote gives the same description, bit for bit.
#include <catch2/catch.hpp>

#include "atmo/keys.hpp"
#include "atmo/write.hpp"
#include "base/error.hpp"
#include "sample.hpp"

#include <cmath>
#include <random>

using namespace sky::atmo;
using Catch::Matchers::Contains;

namespace {

/// Legal descriptions of all kinds.
class Generator
{
public:
    explicit Generator(unsigned seed) : engine_(seed) {}

    Description description()
    {
        Description d;
        for (const LengthKey& key : lengthKeys())
            key.field(d) = coin() && key.fallback ? *key.fallback : logUniform(key.min, key.max);
        for (const WholeNumberKey& key : wholeNumberKeys())
            key.field(d) = key.even ? 2 * whole(key.min / 2, 64) : whole(key.min, 128);
        d.allScatteringOrders = coin();
        d.scatteringOrders = d.allScatteringOrders ? 0 : whole(1, mostScatteringOrders);
        d.wavelengths.count = whole(1, mostWavelengths);
        d.wavelengths.minNm = logUniform(10, 1000);
        d.wavelengths.maxNm = d.wavelengths.count == 1 ? d.wavelengths.minNm : logUniform(1001, 1e5);
        d.solarIrradiance = spectrum(d, 1e20);
        d.groundAlbedo = spectrum(d, 1);
        if (coin())
            d.lightPollutionRadiance = spectrum(d, 1e-3);
        for (int i = whole(0, 3); i > 0; --i)
            d.scatterers.push_back({name(), code(), code(), static_cast<PhaseFunctionType>(whole(0, 2)),
                                    coin() ? 0 : logUniform(1e-40, 1e-3), coin() ? -0.0 : uniform(-20, 20), spectrum(d, 1), coin()});
        for (int i = whole(0, 3); i > 0; --i)
            d.absorbers.push_back({name(), code(), spectrum(d, 1e-20)});
        return d;
    }

private:
    bool coin() { return whole(0, 1) == 1; }
    int whole(int min, int max) { return std::uniform_int_distribution(min, max)(engine_); }
    double uniform(double min, double max) { return std::uniform_real_distribution(min, max)(engine_); }
    double logUniform(double min, double max) { return std::min(max, std::exp(uniform(std::log(min), std::log(max)))); }

    Spectrum spectrum(const Description& d, double max)
    {
        Spectrum values;
        for (int i = 0; i < d.wavelengths.count; ++i)
            values.push_back(coin() ? logUniform(max * 1e-300, max) : coin() ? 0.0 : max * uniform(0, 1));
        return values;
    }

    std::string name()
    {
        static constexpr std::string_view letters = "abcxyzABCXYZ0189_";
        std::string name = std::to_string(names_++) + "_"; // unique
        for (int i = whole(0, 20); i > 0; --i)
            name += letters[static_cast<std::size_t>(whole(0, static_cast<int>(letters.size()) - 1))];
        return name;
    }

    CodeBlock code()
    {
        // Everything that could disturb a reader: fences short of one sign, our own signs, blank first and last lines.
        static const std::vector<std::string> pieces{
            "return 1.0;",      "\n", "\n\n",  " ", "\t", "``", "` `", "{", "}", "#", ":", "\"", "// H\u00F6he \u221D e^-z", "\xFC\xFF",
            "/* version: 6 */", "\\", "file x"};
        CodeBlock block;
        for (int i = whole(0, 12); i > 0; --i)
            block.text += pieces[static_cast<std::size_t>(whole(0, static_cast<int>(pieces.size()) - 1))];
        while (block.text.find("```") != std::string::npos)
            block.text.erase(block.text.find("```"), 1);
        block.text.insert(static_cast<std::size_t>(whole(0, static_cast<int>(block.text.size()))), "x"); // never blank
        return block;
    }

    std::mt19937 engine_;
    int names_ = 0;
};

} // namespace

TEST_CASE("writer: description -> text -> description is the identity, for 500 random descriptions")
{
    for (unsigned seed = 0; seed < 500; ++seed) {
        const Description description = Generator(seed).description();
        const std::string text = write(description);
        INFO("seed " << seed << "\n" << text);
        const Description again = parse(text, "canonical.atmo", "/nowhere");
        REQUIRE(again == description);
        REQUIRE(write(again) == text);
    }
}

TEST_CASE("writer: quantities need no extension of the language")
{
    const std::string text = write(sample::parse(sample::text));
    CHECK_THAT(text, Contains("\nEarth-Sun distance: 149597870700 m\n"));
    CHECK_THAT(text, Contains("cross section at 1 um: 0.00000000000000000000000000000004022 m^2\n"));
    CHECK_THAT(text, Contains("\nwavelengths: min=400nm,max=700nm,count=4\n"));
    CHECK_THAT(text, !Contains("moon radius"));
}

TEST_CASE("writer: refuses what no text stands for")
{
    Description d = sample::parse(sample::text);
    d.groundAlbedo.pop_back();
    CHECK_THROWS_AS(write(d), sky::RangeError);
    for (const std::string& text : {std::string("a ``` b"), std::string("a\rb"), std::string("a\0b", 3)}) {
        d = sample::parse(sample::text);
        d.absorbers[0].numberDensity.text = text;
        CHECK_THROWS_AS(write(d), sky::RangeError);
    }
}
