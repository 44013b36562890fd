// What the window remembers, watches, computes and says, without the window.

#include "base/error.hpp"
#include "base/files.hpp"
#include "preview/computation.hpp"
#include "preview/places.hpp"
#include "preview/preferences.hpp"
#include "preview/watch.hpp"
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <thread>

using namespace showmysky;
using namespace showmysky::app;
using namespace showmysky::app::preview;
namespace fs = std::filesystem;

namespace {

/// An environment variable for a scope.
class Variable
{
public:
    Variable(const char* name, const std::string& value) : name_(name)
    {
        if (const char* before = std::getenv(name))
            before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

/// A directory that is gone in the end.
struct Scratch {
    fs::path path = fs::temp_directory_path() / ("showmysky-test-" + std::to_string(std::rand()) + std::to_string(getpid()));
    Scratch() { fs::create_directories(path); }
    ~Scratch() { fs::remove_all(path); }
};

void write(const fs::path& path, const std::string& text, bool executable = false)
{
    std::ofstream(path) << text;
    if (executable)
        fs::permissions(path, fs::perms::owner_all);
}

/// Runs a script in place of calcmysky.
std::string problemOf(const std::string& script, std::string* lastStage = nullptr, double* fraction = nullptr)
{
    const Scratch scratch;
    write(scratch.path / "program", "#!/bin/sh\n" + script, true);
    Computation computation(scratch.path / "program", "a.atmo", scratch.path / "model");
    for (int i = 0; i < 500 && !computation.done(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        computation.update();
    }
    REQUIRE(computation.done());
    if (lastStage)
        *lastStage = computation.stage();
    if (fraction)
        *fraction = computation.fraction();
    return computation.problem();
}

} // namespace

TEST_CASE("preferences: the state survives a restart")
{
    const Scratch scratch;
    const Variable home("XDG_CONFIG_HOME", (scratch.path / "not yet").string());
    State state;
    state.scene.sunZenith = 91.25;
    state.scene.development.colours = ColourMode::hue;
    state.windowWidth = 777;
    state.windowHeight = 555;
    state.sceneFile = "a dusk.scene";
    savePreferences(state);
    State back;
    loadPreferences(back);
    CHECK(back.scene == state.scene);
    CHECK(back.windowWidth == 777);
    CHECK(back.windowHeight == 555);
    CHECK(back.sceneFile == "a dusk.scene");

    write(configDirectory() / "preview.conf", "altitude: 3\nwindow-width: 3");
    CHECK_THROWS_WITH(loadPreferences(back), Catch::Contains("preview.conf:2:15: `window-width`: `3` is not a number of pixels"));
    CHECK(back.scene == state.scene);
}

TEST_CASE("preferences: a first start finds none")
{
    const Scratch scratch;
    const Variable home("XDG_CONFIG_HOME", scratch.path.string());
    State state;
    loadPreferences(state);
    CHECK(state.scene == SceneOptions{});
}

TEST_CASE("places: each description has a model directory of its own in the cache")
{
    const Variable cache("XDG_CACHE_HOME", "/a/cache");
    const auto one = modelDirectoryOf("/b/earth.atmo"), other = modelDirectoryOf("/c/earth.atmo");
    CHECK(one.string().rfind("/a/cache/showmysky/models/earth-", 0) == 0);
    CHECK(one != other);
    CHECK(one == modelDirectoryOf("/b/../b/earth.atmo"));
    const Variable relative("XDG_CACHE_HOME", "a/cache");
    const Variable home("HOME", "/home/somebody");
    CHECK(modelDirectoryOf("/b/earth.atmo").string().rfind("/home/somebody/.cache/", 0) == 0);
}

TEST_CASE("places: of computed models the last ones are kept, and nothing else is touched")
{
    const Scratch scratch;
    const Variable cache("XDG_CACHE_HOME", scratch.path.string());
    const auto now = fs::file_time_type::clock::now();
    const auto model = [&](int age) {
        const auto path = modelDirectoryOf("/b/" + std::to_string(age) + ".atmo");
        fs::create_directories(path);
        write(path / "manifest.json", R"({"format": "sky model", "formatVersion": 1})");
        write(path / "medium.exr", "air");
        fs::last_write_time(path / "manifest.json", now - std::chrono::hours(age));
        return path;
    };
    std::vector<fs::path> models;
    for (int age = 0; age < static_cast<int>(mostModels) + 3; ++age)
        models.push_back(model(age));
    const auto parent = models.front().parent_path();
    fs::create_directories(parent / "photographs");
    write(parent / "photographs" / "sky.png", "dear");
    fs::create_directory_symlink(scratch.path, parent / "link");

    // The newest is kept though its file is the oldest: a clock may have been set back.
    forgetOldModels(models.back());
    CHECK(fs::exists(models.back()));
    for (std::size_t i = 0; i + 1 < models.size(); ++i) {
        CAPTURE(i);
        CHECK(fs::exists(models[i]) == (i < mostModels - 1));
    }
    CHECK(fs::exists(parent / "photographs" / "sky.png"));
    CHECK(fs::is_symlink(parent / "link"));
    forgetOldModels(models.back());
    CHECK(fs::exists(models[mostModels - 2]));
    forgetOldModels(scratch.path / "nowhere" / "model");
}

TEST_CASE("watch: edits are told once, whether in place or by a new file")
{
    const Scratch scratch;
    const auto path = scratch.path / "a.atmo";
    write(path, "one");
    Watch watch(path);
    const auto changed = [&] { // two looks see a file at rest
        const bool first = watch.changed();
        return watch.changed() || first;
    };
    CHECK_FALSE(changed());
    write(path, "three");
    CHECK(changed());
    CHECK_FALSE(changed());
    write(scratch.path / "new", "other");
    fs::last_write_time(scratch.path / "new", fs::last_write_time(path) + std::chrono::seconds(1));
    fs::rename(scratch.path / "new", path);
    CHECK(changed());
    // Between a removal and the new file there is nothing to read.
    fs::remove(path);
    CHECK_FALSE(changed());
    write(path, "it is back");
    CHECK(changed());
}

TEST_CASE("computation: progress, the child's own words, and a child without words")
{
    std::string stage;
    double fraction = 0;
    CHECK(problemOf(R"(echo '{"event":"stage","stage":"moments","fraction":0.5}' >&2)", &stage, &fraction).empty());
    CHECK(stage == "moments");
    CHECK(fraction == 0.5);
    CHECK(problemOf(R"(echo '{"event":"error","message":"a.atmo:3:1: no."}' >&2; exit 2)") == "a.atmo:3:1: no.");
    CHECK(problemOf("echo '{ broken' >&2; echo 'a library is missing' >&2; exit 127") == "{ broken\na library is missing\n");
    CHECK(problemOf("kill -9 $$") == "calcmysky ended without a word.");
    CHECK_THROWS_AS(Computation("/no/such/program", "a.atmo", "/tmp/model"), sky::FileError);
}

TEST_CASE("computation: stopping it doesn't wait for its end")
{
    const Scratch scratch;
    write(scratch.path / "program", "#!/bin/sh\nexec sleep 60\n", true);
    const auto start = std::chrono::steady_clock::now();
    {
        Computation computation(scratch.path / "program", "a.atmo", scratch.path / "model");
        computation.update();
        CHECK_FALSE(computation.done());
    }
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
}
