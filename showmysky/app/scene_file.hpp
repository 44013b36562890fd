#pragma once
// Scenes as small text files: `NAME: VALUE` on each line, by the names of the command line's options; `#` starts a
// comment.

#include "scene_options.hpp"
#include <filesystem>
#include <functional>
#include <string_view>

namespace showmysky::app {

/// Calls `take` with each name and value.
///   take    returns false where it knows no such name; throws sky::UsageError where the value is wrong
///   known   names, for suggestions
///   throws  sky::UsageError starting with `file:line:column: `
void readLines(std::string_view text, const std::string& file,
               const std::function<bool(const std::string& name, std::string_view value)>& take, const std::vector<std::string>& known);

/// What isn't named keeps its value.   throws sky::UsageError, `scene` is then as before
void readScene(SceneOptions& scene, std::string_view text, const std::string& file);
/// The same for a file.   throws sky::FileError too
void loadScene(SceneOptions& scene, const std::filesystem::path& path);

/// All fields, one a line.
std::string writeScene(const SceneOptions& scene);
void saveScene(const SceneOptions& scene, const std::filesystem::path& path);

/// Sets the field of that name; false where there is none.   throws sky::UsageError
bool setField(SceneOptions& scene, std::string_view name, std::string_view value);
/// Names of all fields.
std::vector<std::string> fieldNames();

} // namespace showmysky::app
