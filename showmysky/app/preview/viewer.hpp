#pragma once
// The window as a whole: events to the scene, the scene to the library, its light to the screen.

#include "developer.hpp"
#include "exhibit.hpp"
#include "gl/context.hpp"
#include "input.hpp"
#include "interface.hpp"
#include "light_meter.hpp"
#include "panel.hpp"
#include "screen.hpp"
#include "stage.hpp"
#include "state.hpp"
#include "window.hpp"

namespace showmysky::app::preview {

class Viewer
{
public:
    /// throws sky::Error where no window can be opened
    explicit Viewer(State state);

    /// A model directory, a description, or a scene file (.scene). Problems are shown, not thrown.
    void open(const std::string& path);
    /// Something to tell, beside the picture.
    void note(const std::string& sentence) { note_ = sentence; }
    /// Until the window is closed.
    void run();
    const State& state() const { return state_; }

private:
    void handle(const std::vector<Event>& events);
    void obey(const Wishes& wishes);
    void learnAboutModel();
    void updateModel();
    void updateSky();
    void updateRefusals();
    void drawFrame();
    void saveSceneFile();
    void loadSceneFile(const std::string& path);
    PanelFacts facts() const;

    State state_;
    Window window_;
    Interface interface_;
    sky::gl::BorrowedContext context_;
    Developer developer_;
    Screen screen_;
    Exhibit exhibit_;
    Stage stage_;
    Pointer pointer_;
    PanelFacts known_; ///< what only changes with the model or the scene
    SceneOptions lastScene_;
    std::optional<Point> pick_;
    std::optional<Reading> reading_;
    std::string note_;
    double exposure_ = 0, frameSeconds_ = 0;
    int framesDue_ = 3; ///< widgets need some frames to settle after an event
    bool chrome_ = true, atRest_ = false, quit_ = false;
};

} // namespace showmysky::app::preview
