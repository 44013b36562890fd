#include "base/error.hpp"
#include "model/precision.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <limits>

using namespace sky;
using namespace sky::model;
using namespace sky::model::test;
namespace fs = std::filesystem;

TEST_CASE("a model comes back as it was written")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    const Model model = Model::open(scratch.path / "m");
    const TableSpec spec = skySpec("radiance", Channels::SpectralRadiance, 24);
    const auto values = skyValues(spec);

    CHECK(model.readAll("radiance") == values);
    CHECK(model.text("description.atmo") == "version: 6\n");
    CHECK(model.tables().size() == 2);
    CHECK(model.table("radiance").axes == spec.axes);
    CHECK(model.table("radiance").channelNames == std::vector<std::string>{"S0.391,333nm", "S0.500nm", "S0.600nm", "S0.700nm"});
    CHECK(model.table("layers/luminance").file == "layers/luminance.exr");
    model.verifyChecksums();

    Manifest expected = smallManifest();
    const Manifest& found = model.manifest();
    CHECK(found.wavelengthsNm == expected.wavelengthsNm); // exactly: doubles in JSON carry 17 digits
    CHECK(found.species == expected.species);
    CHECK(found.skipped == expected.skipped);
    CHECK(found.warnings == expected.warnings);
    CHECK(found.estimatedError == expected.estimatedError);
    CHECK(found.settings == expected.settings);
    CHECK(found.sunAngularRadius == expected.sunAngularRadius);
}

TEST_CASE("one altitude is read without the others")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    const Model model = Model::open(scratch.path / "m");
    const auto all = model.readAll("layers/luminance");
    const auto part = model.readRows("layers/luminance", 64, 32);
    const std::size_t rowSize = model.table("layers/luminance").valueCount(1);
    REQUIRE(part.size() == 32 * rowSize);
    CHECK(std::equal(part.begin(), part.end(), all.begin() + static_cast<std::ptrdiff_t>(64 * rowSize)));
    CHECK(model.readRows("radiance", 128, 0).empty());
    CHECK_THROWS_AS(model.readRows("radiance", 128, 1), RangeError);
    CHECK_THROWS_AS(model.readRows("radiance", -1, 1), RangeError);
    CHECK_THROWS_AS(model.readRows("radiance", 1, std::numeric_limits<int>::max()), RangeError);
    CHECK_THROWS_AS(model.table("radiant"), ModelError);
}

TEST_CASE("channels keep their order though EXR sorts their names")
{
    // As text "1000nm" precedes "400nm"; X Y Z scotopic would be sorted as well.
    const Scratch scratch;
    TableSpec spec = skySpec("t", Channels::SpectralRadiance, 24);
    spec.wavelengthsNm = {400, 700, 1000, 2500.25};
    {
        ModelWriter writer(scratch.path / "m");
        writer.table(spec, skyValues(spec));
        writer.commit(smallManifest());
    }
    const Model model = Model::open(scratch.path / "m");
    CHECK(model.table("t").channelNames == std::vector<std::string>{"S0.400nm", "S0.700nm", "S0.1000nm", "S0.2500,25nm"});
    CHECK(model.readAll("t") == skyValues(spec));
}

TEST_CASE("fewer bits round to nearest within half a unit, over the range of twilight")
{
    const Scratch scratch;
    for (const int bits : {1, 4, 8, 11, 12, 16, 23}) {
        const TableSpec spec = skySpec("t", Channels::Luminance, bits);
        const auto values = skyValues(spec);
        {
            ModelWriter writer(scratch.path / "m");
            writer.table(spec, values);
            writer.commit(smallManifest());
        }
        const Model model = Model::open(scratch.path / "m");
        CHECK(model.table("t").half == (bits <= 11));
        const auto found = model.readAll("t");
        double worst = 0, sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double error = double(found[i]) / double(values[i]) - 1;
            worst = std::max(worst, std::abs(error));
            sum += error;
        }
        CHECK(worst <= std::ldexp(1., -bits) * (1 + 1e-6)); // half a unit in the last of `bits` places
        CHECK(worst > std::ldexp(1., -bits) * 0.5);         // and the bits are really gone
        // Truncation would give a mean of about -2^-bits / 1.4; the mean of rounding errors is far smaller.
        CHECK(std::abs(sum) / static_cast<double>(values.size()) < 0.15 * std::ldexp(1., -bits));
    }
}

TEST_CASE("halves with a row exponent: extremes of a row")
{
    const Scratch scratch;
    TableSpec spec{.name = "t",
                   .quantity = "q",
                   .unit = "1",
                   .axes = {axis("row", "1", 4, 1), axis("i", "1", 4, 1)},
                   .channelNames = {"v"},
                   .significandBits = 11,
                   .isSigned = true};
    const std::vector<float> values{0,       0,
                                    0,       0, //
                                    1e30f,   1e24f,
                                    -1e30f,  0, //
                                    1e-36f,  3e-37f,
                                    -1e-36f, 0, // close to the least normal float
                                    1,       5.9604645e-8f,
                                    1e-12f,  -1}; // 2^-24 of the maximum still has all bits
    {
        ModelWriter writer(scratch.path / "m");
        writer.table(spec, values);
        writer.commit(smallManifest());
    }
    const auto found = Model::open(scratch.path / "m").readAll("t");
    for (std::size_t i = 0; i < 12; ++i)
        CHECK(double(found[i]) == Approx(double(values[i])).epsilon(5e-4).margin(0));
    CHECK(found[12] == 1);
    CHECK(found[13] == values[13]);
    CHECK(std::abs(found[14] - values[14]) < 1e-11f); // below the floor: small absolute error
    CHECK(found[15] == -1);
}

TEST_CASE("floats at the limits of half and float survive", "[round-trip]")
{
    const Scratch scratch;
    TableSpec spec{
        .name = "t", .quantity = "q", .unit = "1", .axes = {axis("row", "1", 1, 1), axis("i", "1", 6, 1)}, .channelNames = {"v"}};
    const float largest = std::numeric_limits<float>::max();
    const std::vector<float> values{0, 6e-8f, 65504, 1e9f, largest, std::numeric_limits<float>::denorm_min()};
    {
        ModelWriter writer(scratch.path / "m");
        writer.table(spec, values);
        writer.commit(smallManifest());
    }
    CHECK(Model::open(scratch.path / "m").readAll("t") == values);
    CHECK(std::isfinite(roundedToBits(largest, 8)));
}
