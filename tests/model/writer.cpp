#include "base/error.hpp"
#include "base/files.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <cstdlib>
#include <limits>

#if defined(__linux__)
#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace sky;
using namespace sky::model;
using namespace sky::model::test;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> namesIn(const fs::path& directory)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace

TEST_CASE("two runs write the same bytes")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "a");
    writeSmallModel(scratch.path / "b");
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(scratch.path / "a"))
        if (entry.is_regular_file()) {
            ++files;
            CHECK(readFile(entry.path()) == readFile(scratch.path / "b" / fs::relative(entry.path(), scratch.path / "a")));
        }
    CHECK(files == 4);
}

TEST_CASE("values that are no radiance are refused with their place")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const int bits : {24, 16, 11})
        for (const auto& [value, word] :
             {std::pair{nan, "not a number"}, {-nan, "not a number"}, {inf, "infinite"}, {-inf, "infinite"}, {-1e-30f, "negative"}}) {
            const Scratch scratch;
            const TableSpec spec = skySpec("layer", Channels::Luminance, bits);
            auto values = skyValues(spec);
            values[(33 * 18 + 4) * 4 + 2] = value; // row 33: altitude 1, sun 1; column 4: view 1, azimuth 1; channel Z
            ModelWriter writer(scratch.path / "m");
            CHECK_THROWS_WITH(writer.table(spec, values),
                              "Table 'layer': the value at row 33, column 4 (altitude[1] = 1000 m, sunZenithAngle[1] = 0.1 "
                              "rad, viewZenithAngle[1] = 0.5 rad, relativeAzimuth[1] = 1 rad), channel Z is " +
                                  std::string(word) + ". No model was written.");
        }
    const Scratch scratch;
    TableSpec spec = skySpec("moments", Channels::Luminance, 24);
    auto values = skyValues(spec);
    values[5] = -0.f; // no value is less than zero
    ModelWriter writer(scratch.path / "m");
    CHECK_NOTHROW(writer.table(spec, values));
    spec.name = "signed";
    spec.isSigned = true;
    values[5] = -3;
    CHECK_NOTHROW(writer.table(spec, values));
}

TEST_CASE("a writer that is not committed leaves no trace, and the old model whole")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    {
        ModelWriter writer(scratch.path / "m");
        TableWriter table = writer.table(skySpec("half-done", Channels::Luminance, 11));
        const auto values = skyValues(table.spec());
        table.writeRows(0, 32, values.data());
        CHECK(namesIn(scratch.path).size() == 2);
        CHECK_THROWS_WITH(writer.commit(smallManifest()), Catch::Contains("'half-done' has 32 of 128 rows"));
        CHECK_NOTHROW(Model::open(scratch.path / "m").verifyChecksums());
    }
    CHECK(namesIn(scratch.path) == std::vector<std::string>{"m"});
    CHECK(Model::open(scratch.path / "m").tables().size() == 2);
    {
        ModelWriter writer(scratch.path / "new" / "deep" / "model");
    }
    CHECK(namesIn(scratch.path) == std::vector<std::string>{"m"}); // parents made for it are gone too
}

TEST_CASE("a commit can be stopped up to its last moment; then the old model is whole")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    for (const double last : {0., 1.}) {
        ModelWriter writer(scratch.path / "m");
        writer.text("description.atmo", "second\n");
        CHECK_THROWS_AS(writer.commit(smallManifest(),
                                      [&](double done) {
                                          if (done >= last)
                                              throw Cancelled("stop");
                                      }),
                        Cancelled);
    }
    CHECK(namesIn(scratch.path) == std::vector<std::string>{"m"});
    CHECK(Model::open(scratch.path / "m").text("description.atmo") == "version: 6\n");
}

TEST_CASE("commit replaces the old model; nothing of it stays")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    {
        ModelWriter writer(scratch.path / "m");
        writer.text("description.atmo", "second\n");
        writer.commit(smallManifest());
        CHECK(namesIn(scratch.path) == std::vector<std::string>{"m"});
    }
    CHECK(namesIn(scratch.path) == std::vector<std::string>{"m"});
    CHECK(namesIn(scratch.path / "m") == std::vector<std::string>{"description.atmo", "manifest.json"});
    CHECK(Model::open(scratch.path / "m").text("description.atmo") == "second\n");
}

TEST_CASE("a directory that is not a model is left alone")
{
    const Scratch scratch;
    fs::create_directory(scratch.path / "photos");
    writeFile(scratch.path / "photos" / "manifest.json", "{\"format\": \"photos\"}");
    CHECK_THROWS_WITH(ModelWriter(scratch.path / "photos"), Catch::Contains("holds something that is not a model"));
    writeFile(scratch.path / "file", "");
    CHECK_THROWS_WITH(ModelWriter(scratch.path / "file"), Catch::Contains("a file of that name exists"));
    CHECK_THROWS_AS(ModelWriter(scratch.path / "file" / "m"), FileError);
    fs::create_directory(scratch.path / "empty");
    {
        ModelWriter writer(scratch.path / "empty");
        writer.commit(smallManifest());
    }
    CHECK_NOTHROW(Model::open(scratch.path / "empty"));
    CHECK(namesIn(scratch.path) == std::vector<std::string>{"empty", "file", "photos"});
}

TEST_CASE("debris of killed runs is removed, the work of living ones is not")
{
    const Scratch scratch;
    fs::create_directories(scratch.path / ".m.partial-0123" / "layers");
    fs::create_directories(scratch.path / ".other.partial-0123");
    ModelWriter alive(scratch.path / "m");
    ModelWriter second(scratch.path / "m");
    const auto names = namesIn(scratch.path);
    CHECK(names.size() == 3); // two writers and the other model's
    CHECK(names.back() == ".other.partial-0123");
    alive.text("a.txt", "still there");
    alive.commit(smallManifest());
    CHECK(Model::open(scratch.path / "m").text("a.txt") == "still there");
}

TEST_CASE("rows follow one another; names are unique; specs are checked")
{
    const Scratch scratch;
    ModelWriter writer(scratch.path / "m");
    TableSpec spec = skySpec("t", Channels::Luminance, 24);
    TableWriter table = writer.table(spec);
    const auto values = skyValues(spec);
    CHECK_THROWS_AS(table.writeRows(1, 1, values.data()), RangeError);
    CHECK_THROWS_AS(table.writeRows(0, 129, values.data()), RangeError);
    CHECK_THROWS_WITH(writer.table(spec), Catch::Contains("already has a table 't'"));
    spec.name = "T";
    CHECK_THROWS_WITH(writer.table(spec), Catch::Contains("already has a file")); // some file systems fold case
    spec.name = "bits";
    spec.significandBits = 25;
    CHECK_THROWS_WITH(writer.table(spec), Catch::Contains("significandBits is 25, expected 1 to 24"));
    CHECK_THROWS_AS(writer.text("manifest.json", "{}"), RangeError);
    CHECK_THROWS_AS(writer.text("../x", ""), RangeError);
    Manifest wrong = smallManifest();
    wrong.groundAlbedo = {2, 2, 2, 2};
    table.writeRows(0, 128, values.data());
    CHECK_THROWS_WITH(writer.commit(wrong), Catch::Contains("groundAlbedo[0]: is 2.0"));
}

TEST_CASE("file names are safe and distinct for any species")
{
    CHECK(safeFileName("single-scattering/molecules") == "single-scattering/molecules.exr");
    CHECK(safeFileName("fine dust") == "fine_20dust.exr");
    CHECK(safeFileName("fine_20dust") == "fine_5F20dust.exr");
    for (const char* name : {"../../x", "/etc/passwd", "a//b", ".hidden", "a/", "", "\xc3\xa9t\xc3\xa9", "con:\\x"}) {
        INFO(name);
        CHECK(isPlainRelativePath(safeFileName(name)));
    }
}

#if defined(__linux__)
TEST_CASE("child of the next test: writes a model where files can't grow", "[.full-disk]")
{
    CHECK_THROWS_WITH(writeSmallModel(std::getenv("SKY_TEST_MODEL")), Catch::Contains("radiance.exr': File too large."));
}

TEST_CASE("a full disk is a sentence, and the old model stays")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    // In a process of its own: the limit that stands for the full disk can't be lifted again, and OpenEXR's threads
    // don't survive a mere fork.
    const std::string model = (scratch.path / "m").string();
    const pid_t child = fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{3000, 3000};
        setrlimit(RLIMIT_FSIZE, &limit);
        setenv("SKY_TEST_MODEL", model.c_str(), 1);
        execl("/proc/self/exe", "test_model", "[.full-disk]", "--out", "/dev/null", nullptr);
        _exit(127);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(namesIn(scratch.path) == std::vector<std::string>{"m"});
    CHECK_NOTHROW(Model::open(scratch.path / "m").verifyChecksums());
}
#endif
