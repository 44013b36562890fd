#include "preferences.hpp"

#include "base/error.hpp"
#include "base/files.hpp"
#include "number_text.hpp"
#include "places.hpp"
#include "scene_file.hpp"

namespace showmysky::app::preview {

namespace {

constexpr std::uint64_t longestFile = 1 << 20;            // bytes
constexpr double smallestSide = 100, largestSide = 16384; // pixels
constexpr const char *widthName = "window-width", *heightName = "window-height", *sceneFileName = "scene-file";

int side(std::string_view text)
{
    const auto value = parseNumber(text);
    if (!value || !(*value >= smallestSide && *value <= largestSide))
        throw sky::UsageError("`" + std::string(text) + "` is not a number of pixels from 100 to 16384.");
    return static_cast<int>(*value);
}

std::filesystem::path file()
{
    const auto directory = configDirectory();
    return directory.empty() ? directory : directory / "preview.conf";
}

} // namespace

std::string writePreferences(const State& state)
{
    return writeScene(state.scene) + widthName + ": " + std::to_string(state.windowWidth) + "\n" + heightName + ": " +
           std::to_string(state.windowHeight) + "\n" + sceneFileName + ": " + state.sceneFile + "\n";
}

void readPreferences(State& state, std::string_view text, const std::string& fileName)
{
    State result = state;
    auto known = fieldNames();
    known.insert(known.end(), {widthName, heightName, sceneFileName});
    readLines(
        text, fileName,
        [&](const std::string& name, std::string_view value) {
            if (name == widthName)
                result.windowWidth = side(value);
            else if (name == heightName)
                result.windowHeight = side(value);
            else if (name == sceneFileName)
                result.sceneFile = value;
            else
                return setField(result.scene, name, value);
            return true;
        },
        known);
    state = result;
}

void loadPreferences(State& state)
{
    const auto path = file();
    std::error_code error;
    if (!path.empty() && std::filesystem::exists(path, error))
        readPreferences(state, sky::readTextFile(path, longestFile), path.string());
}

void savePreferences(const State& state)
{
    const auto path = file();
    if (path.empty())
        return;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error); // a failure shows when the file is written
    sky::writeTextFile(path, writePreferences(state));
}

} // namespace showmysky::app::preview
