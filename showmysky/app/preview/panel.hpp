#pragma once
// The widgets of a scene.

#include "state.hpp"
#include <string>
#include <vector>

namespace showmysky::app::preview {

/// What the panel shows beside the state.
struct PanelFacts {
    std::string model;                                                              ///< its path
    std::vector<std::string> scatterers;                                            ///< of the model; empty while there is none
    double topOfAtmosphere = 100e3;                                                 ///< m
    double exposure = 0;                                                            ///< that the picture has, log10
    std::string refusal;                                                            ///< why the scene can't be drawn
    std::string eclipseRefusal, pollutionRefusal, texturesRefusal, onTheFlyRefusal; ///< why a switch can't be on
    std::string eclipseTableNote; ///< why higher orders are followed on the fly though the table is asked for
    std::string obscuration;      ///< of the Sun by the Moon, in words
    std::string activity;         ///< what is waited for
    double fraction = 1;          ///< of it
    double frameSeconds = 0, skySeconds = 0, screenSeconds = 0;
    std::string problem; ///< that the whole window has
    std::string note;    ///< of the last save or load
};

/// What was pressed.
struct PanelWishes {
    bool reload = false, save = false, load = false;
};

/// The panel at the left, the line at the bottom.
PanelWishes drawPanel(State& state, const PanelFacts& facts);

/// What must be seen even without the panel: why there is no picture, and what is waited for before the first one.
void drawNotice(const PanelFacts& facts, bool hasPicture);

} // namespace showmysky::app::preview
