#pragma once
// From mouse and keys to changes of the scene.

#include "events.hpp"
#include "scene_options.hpp"
#include <optional>

namespace showmysky::app::preview {

/// Size of the window in pixels.
struct Canvas {
    int width = 1, height = 1;
};

/// What an event asks for beyond a change of the scene.
struct Wishes {
    std::optional<Point> pick;
    bool closePick = false, toggleChrome = false, reload = false, save = false, quit = false;
    std::vector<std::string> open; ///< paths that were dropped
};

/// The sky under the pointer follows it, exactly so in the middle of the picture. `dx`, `dy`: pixels right and down.
void turnCamera(SceneOptions& scene, const Canvas& canvas, double dx, double dy);
// The body goes as far in azimuth and zenith angle as the pointer does on the sky: grabbed by its middle, it stays
// there.
void moveSun(SceneOptions& scene, const Canvas& canvas, const Point& from, const Point& to);
void moveMoon(SceneOptions& scene, const Canvas& canvas, const Point& from, const Point& to);
/// The field of view shrinks by a tenth for each step, within what the projection can show.
void zoom(SceneOptions& scene, double steps);
/// Brings the field of view into what the projection can show.
void limitFieldOfView(SceneOptions& scene);
/// The Moon's centre in front of the Sun's, seen from the camera.
void putMoonOnSun(SceneOptions& scene);
/// A town of 8 km radius, 30 km away in the middle of the picture.
void addCity(SceneOptions& scene);

/// The pointer between events: what is being dragged.
class Pointer
{
public:
    /// Changes the scene as the event asks.
    ///   captured  the event belongs to a widget: only a drag that began on the sky goes on
    Wishes handle(const Event& event, SceneOptions& scene, const Canvas& canvas, bool captured);
    /// A drag on the sky is under way.
    bool dragging() const { return drag_ != Drag::none; }

private:
    enum class Drag { none, click, camera, sun, moon };
    void press(const ButtonPressed& event);
    void move(const PointerMoved& event, SceneOptions& scene, const Canvas& canvas);

    Drag drag_ = Drag::none;
    Button button_ = Button::left;
    Point start_, last_;
};

} // namespace showmysky::app::preview
