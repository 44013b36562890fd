// The seeds of the model reader's fuzzer, and random damage done to them, without the fuzzer.
#include <catch2/catch.hpp>

#include "../fuzz/damage.hpp"
#include "../fuzz/model_fuzz.hpp"
#include "support.hpp"

using namespace sky::model::test;

namespace {

std::vector<std::string> seeds()
{
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SKY_SOURCE_DIR) / "tests/fuzz/model_seeds"))
        texts.push_back(readFile(entry.path()));
    return texts;
}

std::filesystem::path seed(const std::string& name) { return std::filesystem::path(SKY_SOURCE_DIR) / "tests/fuzz/model_seeds" / name; }

} // namespace

TEST_CASE("fuzz: the seeds of manifest, header and pixels are good ones")
{
    CHECK_NOTHROW(sky::model::parseManifest(readFile(seed("manifest.json")), "seed"));
    CHECK(fuzz::checkHeader(readFile(seed("header.exr"))));
    const fuzz::Models models;
    CHECK(models.checkModel(models.manifest()));
    CHECK(models.checkModel(readFile(seed("model.json"))));
    for (const char* name : {"header.exr", "pixels_plain.exr", "pixels_zip.exr"}) {
        INFO(name);
        CHECK(models.checkPixels(readFile(seed(name)), false) == "");
    }
    CHECK(models.checkPixels(readFile(seed("pixels_half.exr")), true) == "");
}

TEST_CASE("pixels of a file that are no radiance are refused with their row")
{
    const fuzz::Models models;
    const std::string floats = readFile(seed("pixels_plain.exr")), halves = readFile(seed("pixels_half.exr"));
    struct Value {
        const char *asFloat, *asHalf, *what; // little-endian
    };
    for (const auto& value : {Value{"\x00\x00\xc0\x7f", "\x00\x7e", "not finite."},
                              {"\x01\x00\x80\xff", "\x01\xfc", "not finite."},
                              {"\x00\x00\x80\x7f", "\x00\x7c", "not finite."},
                              {"\x00\x00\x80\xff", "\x00\xfc", "not finite."},
                              {"\x00\x00\x80\xbf", "\x00\xbc", "negative."}}) {
        // Rows without compression: their number, their size, then X and Y; the last value of the last row is the file's last.
        CHECK_THAT(models.checkPixels(floats.substr(0, floats.size() - 4) + std::string(value.asFloat, 4), false),
                   Catch::Contains("pixels") && Catch::EndsWith("a value in row 3 is " + std::string(value.what)));
        CHECK_THAT(models.checkPixels(halves.substr(0, halves.size() - 2) + std::string(value.asHalf, 2), true),
                   Catch::Contains("pixels") && Catch::EndsWith("a value in row 3 is " + std::string(value.what)));
    }
}

TEST_CASE("fuzz: every seed of a model, and every damaged one, is refused with a ModelError or taken")
{
    std::mt19937 engine(6);
    const fuzz::Models models;
    const std::vector<std::string> texts = seeds();
    for (const std::string& text : texts)
        CHECK_NOTHROW(models.check(text));
    for (int round = 0; round < 3000; ++round) {
        const std::string text = fuzz::damaged(texts, "0123456789-e.,:{}[]\"\\", engine);
        INFO(text);
        REQUIRE_NOTHROW(models.check(text));
    }
    // Most seeds are small; these are where there is most to damage.
    for (int round = 0; round < 1000; ++round) {
        const std::string text =
            fuzz::damaged({readFile(seed("model.json")), readFile(seed("pixels_zip.exr")), readFile(seed("pixels_half.exr"))},
                          "0123456789-e.,:", engine);
        INFO(text);
        REQUIRE_NOTHROW(models.check(text));
    }
}
