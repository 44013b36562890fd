// The seeds of the model reader's fuzzer, and random damage done to them, without the fuzzer.
#include <catch2/catch.hpp>

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
    const auto below = [&](std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(engine); };
    const std::vector<std::string> texts = seeds();
    for (const std::string& text : texts) {
        CHECK_NOTHROW(fuzz::checkManifest(text));
        CHECK_NOTHROW(fuzz::checkHeader(text));
    }
    for (int round = 0; round < 3000; ++round) {
        std::string text = texts[below(texts.size())];
        for (std::size_t damage = below(4) + 1; damage > 0 && !text.empty(); --damage) {
            const std::size_t at = below(text.size()), length = std::min<std::size_t>(below(40) + 1, text.size() - at);
            switch (below(4)) {
            case 0: text[at] = static_cast<char>(below(256)); break;
            case 1: text.erase(at, length); break;
            case 2: text.insert(below(text.size()), text.substr(at, length)); break;
            default: text.insert(at, 1, "0123456789-e.,:{}[]\"\\"[below(21)]);
            }
        }
        INFO(text);
        REQUIRE_NOTHROW(fuzz::checkManifest(text));
        REQUIRE_NOTHROW(fuzz::checkHeader(text));
    }
}
