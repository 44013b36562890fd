#pragma once

#include "scene_options.hpp"
#include <string>

namespace showmysky::app::preview {

/// What the window shows and how: all that a restart brings back.
struct State {
    SceneOptions scene;
    int windowWidth = 1280, windowHeight = 800; ///< pixels
    std::string sceneFile = "sky.scene";        ///< that the buttons save to and load from
};

} // namespace showmysky::app::preview
