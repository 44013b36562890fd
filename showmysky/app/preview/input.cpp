#include "input.hpp"

#include "base/angles.hpp"
#include "view_direction.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace showmysky::app::preview {

namespace {

using sky::base::degree;
constexpr double clickReach = 4;                                          // pixels: a hand isn't that steady
constexpr double narrowest = 0.05, widestPerspective = 170, widest = 360; // degrees

/// Angle across one pixel in the middle of the picture, degrees.
double degreesPerPixel(const SceneOptions& scene, const Canvas& canvas)
{
    if (scene.projection == Projection::perspective)
        return 2 * std::tan(scene.fieldOfView * degree / 2) / canvas.width / degree;
    return scene.fieldOfView / canvas.width;
}

double wrapped(double azimuth)
{
    const double turn = std::fmod(azimuth + 180, 360);
    return turn < 0 ? turn + 180 : turn - 180;
}

/// Azimuths crowd together near the zenith: there the same angle on the sky is a larger step of azimuth.
double azimuthStep(double angle, double elevation) { return angle / std::max(0.1, std::cos(elevation * degree)); }

/// A direction in the sky, degrees.
struct Place {
    double azimuth, zenith;
};

/// Under a point of the window; nothing outside of the projection.
std::optional<Place> placeUnder(const SceneOptions& scene, const Canvas& canvas, const Point& point)
{
    const Vector direction = builtInDirection(scene.camera(), canvas.width, canvas.height, point.x, canvas.height - point.y);
    if (direction == Vector{})
        return std::nullopt;
    return Place{std::atan2(-direction[1], direction[0]) / degree, std::acos(std::clamp(direction[2], -1., 1.)) / degree};
}

void moveOnSky(double& azimuth, double& zenith, const SceneOptions& scene, const Canvas& canvas, const Point& from, const Point& to)
{
    const auto before = placeUnder(scene, canvas, from), now = placeUnder(scene, canvas, to);
    if (!before || !now)
        return;
    azimuth = wrapped(azimuth + now->azimuth - before->azimuth);
    zenith = std::clamp(zenith + now->zenith - before->zenith, 0., 180.);
}

} // namespace

void turnCamera(SceneOptions& scene, const Canvas& canvas, double dx, double dy)
{
    const double scale = degreesPerPixel(scene, canvas);
    scene.yaw = wrapped(scene.yaw - azimuthStep(dx * scale, scene.pitch));
    scene.pitch = std::clamp(scene.pitch + dy * scale, -90., 90.);
}

void moveSun(SceneOptions& scene, const Canvas& canvas, const Point& from, const Point& to)
{
    moveOnSky(scene.sunAzimuth, scene.sunZenith, scene, canvas, from, to);
}

void moveMoon(SceneOptions& scene, const Canvas& canvas, const Point& from, const Point& to)
{
    moveOnSky(scene.moonAzimuth, scene.moonZenith, scene, canvas, from, to);
}

void zoom(SceneOptions& scene, double steps)
{
    scene.fieldOfView *= std::pow(0.9, steps);
    limitFieldOfView(scene);
}

void limitFieldOfView(SceneOptions& scene)
{
    const bool perspective = scene.projection == Projection::perspective;
    scene.fieldOfView = std::clamp(scene.fieldOfView, narrowest, perspective ? widestPerspective : widest);
}

void putMoonOnSun(SceneOptions& scene)
{
    scene.moonZenith = scene.sunZenith;
    scene.moonAzimuth = scene.sunAzimuth;
}

void addCity(SceneOptions& scene) { scene.cities.push_back({30e3, scene.yaw, 8e3, 1, {}}); }

void Pointer::press(const ButtonPressed& event)
{
    if (drag_ != Drag::none)
        return;
    button_ = event.button;
    start_ = last_ = event.at;
    if (event.modifiers.control)
        drag_ = event.button == Button::right ? Drag::moon : Drag::sun;
    else if (event.modifiers.shift || event.button == Button::right)
        drag_ = Drag::camera;
    else if (event.button == Button::left)
        drag_ = Drag::click;
}

void Pointer::move(const PointerMoved& event, SceneOptions& scene, const Canvas& canvas)
{
    const Point from = std::exchange(last_, event.to);
    if (drag_ == Drag::camera)
        turnCamera(scene, canvas, last_.x - from.x, last_.y - from.y);
    else if (drag_ == Drag::sun)
        moveSun(scene, canvas, from, last_);
    else if (drag_ == Drag::moon)
        moveMoon(scene, canvas, from, last_);
}

Wishes Pointer::handle(const Event& event, SceneOptions& scene, const Canvas& canvas, bool captured)
{
    Wishes wishes;
    if (const auto* moved = std::get_if<PointerMoved>(&event)) {
        move(*moved, scene, canvas);
    } else if (const auto* pressed = std::get_if<ButtonPressed>(&event)) {
        if (!captured)
            press(*pressed);
    } else if (const auto* released = std::get_if<ButtonReleased>(&event)) {
        if (drag_ == Drag::none || released->button != button_)
            return wishes;
        move({released->at}, scene, canvas);
        if (drag_ == Drag::click && std::hypot(released->at.x - start_.x, released->at.y - start_.y) <= clickReach)
            wishes.pick = released->at;
        drag_ = Drag::none;
    } else if (const auto* wheel = std::get_if<WheelTurned>(&event)) {
        if (!captured)
            zoom(scene, wheel->steps);
    } else if (const auto* key = std::get_if<KeyPressed>(&event)) {
        if (captured)
            return wishes;
        wishes.toggleChrome = key->key == Key::tab;
        wishes.closePick = key->key == Key::escape;
        wishes.reload = key->key == Key::r;
        wishes.save = key->key == Key::s && key->modifiers.control;
        wishes.quit = key->key == Key::q && key->modifiers.control;
    } else if (const auto* dropped = std::get_if<Dropped>(&event)) {
        wishes.open = dropped->paths;
    }
    return wishes;
}

} // namespace showmysky::app::preview
