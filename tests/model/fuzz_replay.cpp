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

} // namespace

TEST_CASE("fuzz: the seeds of manifest and header are good ones")
{
    const std::filesystem::path folder = std::filesystem::path(SKY_SOURCE_DIR) / "tests/fuzz/model_seeds";
    CHECK_NOTHROW(sky::model::parseManifest(readFile(folder / "manifest.json"), "seed"));
    const std::string header = readFile(folder / "header.exr");
    std::istringstream stream(header);
    CHECK_NOTHROW(sky::model::checkExrHeader(stream, header.size(), fuzz::tableOfTheHeader(), "seed"));
}

TEST_CASE("fuzz: every seed of a model, and every damaged one, is refused with a ModelError or taken")
{
    std::mt19937 engine(6);
    const std::vector<std::string> texts = seeds();
    for (const std::string& text : texts) {
        CHECK_NOTHROW(fuzz::checkManifest(text));
        CHECK_NOTHROW(fuzz::checkHeader(text));
    }
    for (int round = 0; round < 3000; ++round) {
        const std::string text = fuzz::damaged(texts, "0123456789-e.,:{}[]\"\\", engine);
        INFO(text);
        REQUIRE_NOTHROW(fuzz::checkManifest(text));
        REQUIRE_NOTHROW(fuzz::checkHeader(text));
    }
}
