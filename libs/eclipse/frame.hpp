#pragma once
// Coordinates around an observer that keep the symmetry of an eclipse.
//
// The centres of planet, Sun and Moon span a plane, and all light is mirror-symmetric about it. Points of the air are given by
// x along that plane and y away from it, arcs on the ground, and by altitude: longitude and latitude on the sphere whose equator is
// the mirror plane, stretched so that x is a length at the observer's latitude. The observer stands at x = 0, y = observer() >= 0.

#include "physics/eclipse.hpp"
#include <array>
#include <vector>

namespace sky::eclipse {

using Vector = std::array<double, 3>;

/// Local directions at a point of the sphere; azimuths count from `along` towards `across`.
struct LocalAxes {
    Vector along, across, up;
};

class Frame
{
public:
    explicit Frame(const physics::EclipseBodies& bodies);

    /// The observer's distance from the mirror plane along the ground, m, >= 0.
    double observer() const { return observer_; }
    /// Of the observer, m.
    double cameraAltitude() const { return cameraRadius_ - planet_.radius; }
    /// Along the plane, from the observer to where the shadow's axis enters the air (or passes nearest to the planet), m.
    double shadow() const { return shadow_; }
    /// Sine of the Sun's elevation there, 0 .. 1.
    double shadowSunSine() const { return shadowSunSine_; }

    LocalAxes axesAt(double x, double y) const;
    /// A point in the camera's frame (x North, y West, z zenith, origin at the camera), m.
    Vector position(const LocalAxes& axes, double altitude) const;
    /// The Sun seen from a point: components along, across and up of the unit vector.
    Vector sunAt(const LocalAxes& axes) const;
    /// The azimuth here of a direction at the observer that points `azimuth` from North over West, rad.
    double azimuthOf(double azimuth) const;

private:
    physics::Planet planet_;
    double cameraRadius_;
    Vector sun_;                    // from the planet's centre
    Vector ahead_, aside_, upward_; // right- or left-handed: aside points to the observer's side
    double observer_ = 0, stretch_ = 1, shadow_ = 0, shadowSunSine_ = 1;
};

/// Points on a line, increasing: evenly within `core` of each centre, then ever wider, out to `from` and `to`.
std::vector<double> clusteredNodes(double from, double to, const std::array<double, 2>& centres, const std::array<double, 2>& cores,
                                   int count);

/// Distance along the ground at which a ray's node stands from its start, m.
///   sunScale, nuScale  as in physics::RayNodes::Node;  mu  of the ray at its start
double groundDistance(double planetRadius, double sunScale, double nuScale, double mu);

} // namespace sky::eclipse
