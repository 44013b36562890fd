// The fuzzer's seeds, and random damage done to them, without the fuzzer.
#include <catch2/catch.hpp>

#include "../fuzz/atmo_fuzz.hpp"
#include "../fuzz/damage.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
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
    const std::vector<std::string> texts = seeds();
    for (int round = 0; round < 3000; ++round) {
        const std::string text = fuzz::damaged(texts, ":{}`\"#\n,=[]", engine);
        INFO(text);
        REQUIRE_NOTHROW(fuzz::checkDescription(text));
        REQUIRE_NOTHROW(fuzz::checkTable(text));
    }
}
