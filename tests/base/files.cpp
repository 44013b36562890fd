#include "base/files.hpp"
#include "base/error.hpp"
#include <catch2/catch.hpp>

#include <cerrno>
#include <random>

using namespace sky;
namespace fs = std::filesystem;

namespace {

/// A directory of its own for each test, removed with it.
struct Scratch {
    fs::path path = fs::temp_directory_path() / ("sky-files-" + std::to_string(std::random_device{}()));
    Scratch() { fs::create_directories(path); }
    ~Scratch() { fs::remove_all(path); }
    std::size_t entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator())); }
};

} // namespace

TEST_CASE("text files: what is written is read, and too much is refused")
{
    const Scratch scratch;
    const std::string text = std::string("line\n\0\xff", 7) + std::string(100000, 'x');
    writeTextFile(scratch.path / "file", text);
    CHECK(readTextFile(scratch.path / "file", 1 << 20) == text);
    CHECK(readTextFile(scratch.path / "file", text.size()) == text);
    CHECK_THROWS_AS(readTextFile(scratch.path / "file", text.size() - 1), FileError);
    writeTextFile(scratch.path / "file", "");
    CHECK(readTextFile(scratch.path / "file", 10).empty());
}

TEST_CASE("text files: an error names the file and the reason")
{
    const Scratch scratch;
    CHECK_THROWS_WITH(readTextFile(scratch.path / "nothing", 10), Catch::Contains("nothing") && Catch::Contains(systemReason(ENOENT)));
    CHECK_THROWS_AS(readTextFile(scratch.path, 10), FileError);
    CHECK_THROWS_WITH(writeTextFile(scratch.path / "no" / "where", "x"), Catch::Contains("where") && Catch::Contains(systemReason(ENOENT)));
}

TEST_CASE("replacement: the old directory stays until the new one takes its place")
{
    const Scratch scratch;
    const fs::path target = scratch.path / "model";
    fs::create_directories(target);
    writeTextFile(target / "old", "1");
    {
        ReplacementDirectory replacement(target);
        writeTextFile(replacement.path() / "new", "2");
        CHECK(fs::exists(target / "old"));
        replacement.replaceTarget();
        CHECK(fs::exists(target / "new"));
        CHECK_FALSE(fs::exists(target / "old"));
    }
    CHECK(fs::exists(target / "new"));
    CHECK(scratch.entries() == 1); // nothing beside it
}

TEST_CASE("replacement: given up, it leaves the target as it was, and no debris")
{
    const Scratch scratch;
    const fs::path target = scratch.path / "model";
    fs::create_directories(target);
    writeTextFile(target / "old", "1");
    {
        const ReplacementDirectory replacement(target);
        writeTextFile(replacement.path() / "half", "2");
    }
    CHECK(fs::exists(target / "old"));
    CHECK(scratch.entries() == 1);
    {
        const ReplacementDirectory replacement(scratch.path / "deep" / "er" / "model"); // parents made on the way go too
    }
    CHECK(scratch.entries() == 1);
}
