// docs/language.md: its samples are legal, its tables are those of the code.
#include <catch2/catch.hpp>

#include "atmo/document.hpp"
#include "atmo/keys.hpp"
#include "sample.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

using namespace sky::atmo;
using Catch::Matchers::Contains;

namespace {

std::string documentation()
{
    std::ifstream file(std::filesystem::path(SKY_SOURCE_DIR) / "docs/language.md");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Blocks between a line "~~~atmo" or "```atmo" and the next line without indentation that closes it.
std::vector<std::string> samples()
{
    const Source text(documentation(), "language.md");
    std::vector<std::string> blocks;
    std::string fence;
    for (int i = 1; i <= text.lineCount(); ++i) {
        const std::string line(text.line(i));
        if (!fence.empty() && line == fence)
            fence.clear();
        else if (!fence.empty())
            blocks.back() += line + "\n";
        else if (line == "~~~atmo" || line == "```atmo") {
            fence = line.substr(0, 3);
            blocks.emplace_back();
        }
    }
    return blocks;
}

// A complete description around a few entries: the sample without the keys that they bring along.
std::string completed(const std::string& entries)
{
    const Source fragment(entries, "fragment");
    std::vector<std::string> brought;
    for (const Entry& entry : readEntries(fragment))
        brought.push_back(comparable(entry.key));
    std::string text;
    const Source sampleText(sample::text, "sample");
    for (int i = 1; i <= sampleText.lineCount(); ++i) {
        const std::string line(sampleText.line(i));
        if (std::find(brought.begin(), brought.end(), comparable(line.substr(0, line.find(':')))) == brought.end())
            text += line + "\n";
    }
    return text + entries;
}

} // namespace

TEST_CASE("docs: every sample is a legal description or part of one")
{
    const std::vector<std::string> blocks = samples();
    CHECK(blocks.size() >= 4);
    for (const std::string& block : blocks) {
        INFO(block);
        const std::string text = block.starts_with("version") ? block : completed(block);
        CHECK_NOTHROW(parse(text, "sample.atmo", std::filesystem::path(SKY_SOURCE_DIR) / "examples"));
    }
}

TEST_CASE("docs: every key stands there, with the default and the range of the code")
{
    const std::string text = documentation();
    for (const WholeNumberKey& key : wholeNumberKeys())
        CHECK_THAT(text, Contains("| `" + std::string(key.key) + "` | " + std::to_string(key.fallback) + " | " + std::to_string(key.min) +
                                  " to " + std::to_string(key.max) + (key.even ? ", even |" : " |")));
    for (const auto& keys : {topLevelKeys(), scattererKeys(), absorberKeys()})
        for (const std::string_view key : keys)
            CHECK_THAT(text, Contains("| `" + std::string(key) + "` "));
    for (const LengthKey& key : lengthKeys())
        CHECK_THAT(text, Contains(std::string(key.range.substr(key.range.find(' ') + 1))));
}
