#include <catch2/catch.hpp>

#include "base/suggest.hpp"

using namespace sky;

TEST_CASE("edit distance counts insertions, deletions, replacements and swaps")
{
    CHECK(editDistance("", "") == 0);
    CHECK(editDistance("", "abc") == 3);
    CHECK(editDistance("abc", "") == 3);
    CHECK(editDistance("kitten", "sitting") == 3);
    CHECK(editDistance("radiacne", "radiance") == 1);
    CHECK(editDistance("ca", "abc") == 3); // optimal string alignment: no edit within a swap
}

TEST_CASE("a suggestion is the nearest candidate, and none is made where nothing is near")
{
    const std::vector<std::string> candidates{"ground albedo", "wavelengths", "moments"};
    CHECK(closest("groud albedo", candidates) == "ground albedo");
    CHECK(closest("momnets", candidates) == "moments");
    CHECK(closest("xyzzy", candidates).empty());
    CHECK(closest("", candidates).empty());
    CHECK(suggestion("wavelenghts", candidates) == " Did you mean `wavelengths`?");
    CHECK(suggestion("xyzzy", candidates).empty());
}
