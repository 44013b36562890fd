// docs/stress.md, docs/campaign.md: the tests that they name exist.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace {

std::string textOf(const std::filesystem::path& path)
{
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> quoted(const std::string& text, const std::regex& pattern)
{
    std::set<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        found.insert((*it)[1]);
    return found;
}

} // namespace

TEST_CASE("the tests that docs/stress.md and docs/campaign.md name exist")
{
    std::set<std::string> tests;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SKY_SOURCE_DIR "/tests"))
        if (entry.path().extension() == ".cpp")
            tests.merge(quoted(textOf(entry.path()), std::regex(R"re(TEST_CASE\(\s*"([^"]*)")re")));
    for (const char* page : {"stress", "campaign"}) {
        const auto named = quoted(textOf(std::string(SKY_SOURCE_DIR "/docs/") + page + ".md"), std::regex(R"re("([^"\n]*)")re"));
        CHECK(named.size() > 20);
        for (const auto& name : named) {
            INFO(page << ": " << name);
            CHECK(tests.count(name) == 1);
        }
    }
}
