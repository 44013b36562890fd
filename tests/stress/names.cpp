// Pages of docs/ that name tests by their names: those tests exist.

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

/// A page as one line, so that a name may go on in the next line.
std::string pageOf(const std::string& name)
{
    return std::regex_replace(textOf(SKY_SOURCE_DIR "/docs/" + name + ".md"), std::regex(R"(\n *)"), " ");
}

std::set<std::string> quoted(const std::string& text, const std::regex& pattern)
{
    std::set<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        found.insert((*it)[1]);
    return found;
}

} // namespace

TEST_CASE("the tests exist that docs name: stress, campaign, method, sharp-peaks, deep-air")
{
    std::set<std::string> tests;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SKY_SOURCE_DIR "/tests"))
        if (entry.path().extension() == ".cpp")
            tests.merge(quoted(textOf(entry.path()), std::regex(R"re(TEST_CASE\(\s*"([^"]*)")re")));
    for (const char* page : {"stress", "campaign", "method", "sharp-peaks", "deep-air"}) {
        const auto named = quoted(pageOf(page), std::regex(R"re("([^"]*)")re"));
        CHECK(!named.empty());
        for (const auto& name : named) {
            INFO(page << ": " << name);
            CHECK(tests.count(name) == 1);
        }
    }
}
