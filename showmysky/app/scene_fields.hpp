#pragma once
// The one list of a scene's settings: their names, what they mean, how they are read and written.

#include "scene_options.hpp"
#include <functional>
#include <string_view>

namespace showmysky::app {

struct SceneField {
    std::string name; ///< `sun-zenith`: the option --sun-zenith, the line `sun-zenith: 45`
    std::string group, help;
    enum class Kind {
        value,
        flag,
        list,
        repeated
    } kind = Kind::value; ///< a flag is an option without value, `yes` or `no` in a file; repeated ones are joined by semicolons
    /// throws sky::UsageError: what was expected
    std::function<void(SceneOptions&, std::string_view text)> read;
    std::function<std::string(const SceneOptions&)> write;
    std::function<double&(SceneOptions&)> number{}; ///< where it is one
};

/// All of them, in the order of --help and of scene files.
const std::vector<SceneField>& sceneFields();

/// Names of colour modes and the like, in the order of their enumeration, for menus.
const std::vector<std::string>& projectionNames();
const std::vector<std::string>& toneCurveNames();
const std::vector<std::string>& colourModeNames();
const std::vector<std::string>& ditheringNames();
const std::vector<std::string>& depthNames();

} // namespace showmysky::app
