// The fuzzer's seeds, and random damage done to them, without the fuzzer.
#include <catch2/catch.hpp>

#include "../fuzz/atmo_fuzz.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

namespace {

std::vector<std::string> seeds()
{
    std::vector<std::string> texts;
    for (const char* folder : {"tests/fuzz/atmo_seeds", "tests/atmo/corpus", "examples"}) {
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SKY_SOURCE_DIR) / folder)) {
            std::ifstream file(entry.path(), std::ios::binary);
            if (entry.is_regular_file())
                texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
        }
    }
    return texts;
}

} // namespace

TEST_CASE("fuzz: every seed is refused with a message or means what its canonical text means")
{
    const std::vector<std::string> texts = seeds();
    CHECK(texts.size() > 100);
    for (const std::string& text : texts) {
        INFO(text);
        CHECK_NOTHROW(fuzz::checkDescription(text));
        CHECK_NOTHROW(fuzz::checkTable(text));
    }
}

TEST_CASE("fuzz: so is every damaged seed")
{
    std::mt19937 engine(6);
    const auto below = [&](std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(engine); };
    const std::vector<std::string> texts = seeds();
    for (int round = 0; round < 3000; ++round) {
        std::string text = texts[below(texts.size())];
        for (std::size_t damage = below(4) + 1; damage > 0 && !text.empty(); --damage) {
            const std::size_t at = below(text.size()), length = std::min<std::size_t>(below(40) + 1, text.size() - at);
            switch (below(4)) {
            case 0: text[at] = static_cast<char>(below(256)); break;
            case 1: text.erase(at, length); break;
            case 2: text.insert(below(text.size()), text.substr(at, length)); break;
            default: text.insert(at, 1, ":{}`\"#\n,=[]"[below(11)]);
            }
        }
        INFO(text);
        REQUIRE_NOTHROW(fuzz::checkDescription(text));
        REQUIRE_NOTHROW(fuzz::checkTable(text));
    }
}
