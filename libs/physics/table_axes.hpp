#pragma once
// Axes of the tables that other programs read: where their nodes stand. Readers need only the nodes (docs/format.md).

#include "physics/geometry.hpp"
#include <vector>

namespace sky::physics {

/// Altitudes 0 .. top, m, evenly spread in the distance to the horizon: fine near the ground.
std::vector<double> altitudeNodes(const Planet& planet, int count);

/// Angle from the geometric horizon, rad, 0 .. range: x = scale sinh(t asinh(range / scale)), t uniform, scale 0.05: fine at
/// the horizon, where the sky varies most.
std::vector<double> horizonAngleNodes(double range, int count);
constexpr double horizonAngleScale = 0.05;

/// Directions of view of a table with `count` zenith angles (even): the lower half looks at the ground, from nadir up to the
/// horizon, the upper half at the sky, from the horizon to the zenith. Node k of either half is the same share of the way at all
/// altitudes; both halves have a node on the horizon, one on each side of the jump.
///   returns  sine of the elevation (cosine of the view zenith angle), [count], increasing
std::vector<double> viewMuNodes(const Planet& planet, double altitude, int count);

/// Place of a view on that axis of `count` zenith angles: which half, and 0 .. count / 2 - 1 with a fraction, from the horizon on.
struct ViewPlace {
    bool ground;
    double position;
};
ViewPlace viewPlace(const Planet& planet, double altitude, int count, double elevation);

/// Elevations of the Sun of a table, rad, [count], increasing from the horizon's less `depth` to the zenith, counted from the
/// geometric horizon of the altitude, because there the direct light goes out:
///     e - e_horizon = range sinh(a v) / sinh(a),  range = pi/2 - e_horizon,  a = scale,  v uniform from vDark to 1
/// Node k is the same share of the way at all altitudes.
struct SunTableAxis {
    double scale;
    double vDark;
};
std::vector<double> sunElevationNodes(const Planet& planet, double altitude, const SunTableAxis& axis, int count);

/// Index 0 .. count-1, with a fraction, of a Sun on that axis; negative below its end, where it is dark.
double sunElevationPosition(const Planet& planet, double altitude, const SunTableAxis& axis, int count, double elevation);

/// The axis of a planet on which no air is lit once the Sun stands `depth` (rad, > 0) below the horizon of the ground.
///   sunset  of the angle over which the Sun goes out, the part of the Earth's: sunsetShare()
SunTableAxis sunTableAxis(double depth, double sunset = 1);

/// Relative azimuths 0 .. pi, rad, uniform.
std::vector<double> azimuthNodes(int count);

} // namespace sky::physics
