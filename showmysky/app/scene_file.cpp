#include "scene_file.hpp"

#include "base/error.hpp"
#include "base/files.hpp"
#include "base/suggest.hpp"
#include "number_text.hpp"
#include "scene_fields.hpp"
#include <algorithm>

namespace showmysky::app {

namespace {

constexpr std::uint64_t longestFile = 1 << 20; // bytes

/// Columns are counted in characters: bytes that continue one in UTF-8 don't count.
std::size_t columnOf(std::string_view line, std::size_t byte)
{
    return 1 + static_cast<std::size_t>(std::count_if(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(byte),
                                                      [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

} // namespace

void readLines(std::string_view text, const std::string& file,
               const std::function<bool(const std::string& name, std::string_view value)>& take, const std::vector<std::string>& known)
{
    std::vector<std::string> seen;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::string_view content = trimmed(line.substr(0, line.find('#')));
        if (content.empty())
            continue;
        const auto fail = [&](std::string_view at, const std::string& message) {
            throw sky::UsageError(file + ":" + std::to_string(number) + ":" +
                                  std::to_string(columnOf(line, static_cast<std::size_t>(at.data() - line.data()))) + ": " + message);
        };
        const auto colon = content.find(':');
        if (colon == std::string_view::npos)
            fail(content, "expected `NAME: VALUE`, for instance `altitude: 100`.");
        const std::string name(trimmed(content.substr(0, colon)));
        if (std::find(seen.begin(), seen.end(), name) != seen.end())
            fail(content, "`" + name + "` is given twice.");
        seen.push_back(name);
        std::string_view value = content.substr(colon + 1);
        const auto blanks = std::min(value.find_first_not_of(" \t"), value.size());
        value.remove_prefix(blanks);
        try {
            if (!take(name, value))
                fail(content, "there is no setting `" + name + "`." + sky::suggestion(name, known));
        } catch (const sky::UsageError& error) {
            const std::string message = error.what();
            if (message.rfind(file + ":", 0) == 0)
                throw;
            fail(value, "`" + name + "`: " + message);
        }
    }
}

bool setField(SceneOptions& scene, std::string_view name, std::string_view value)
{
    for (const auto& field : sceneFields())
        if (field.name == name) {
            field.read(scene, value);
            return true;
        }
    return false;
}

std::vector<std::string> fieldNames()
{
    std::vector<std::string> names;
    for (const auto& field : sceneFields())
        names.push_back(field.name);
    return names;
}

void readScene(SceneOptions& scene, std::string_view text, const std::string& file)
{
    SceneOptions result = scene;
    readLines(
        text, file, [&](const std::string& name, std::string_view value) { return setField(result, name, value); }, fieldNames());
    scene = result;
}

void loadScene(SceneOptions& scene, const std::filesystem::path& path)
{
    readScene(scene, sky::readTextFile(path, longestFile), path.string());
}

std::string writeScene(const SceneOptions& scene)
{
    std::string text = "# A scene of showmysky. Settings that aren't named keep their values.\n";
    for (const auto& field : sceneFields())
        text += field.name + ": " + field.write(scene) + "\n";
    return text;
}

void saveScene(const SceneOptions& scene, const std::filesystem::path& path) { sky::writeTextFile(path, writeScene(scene)); }

} // namespace showmysky::app
