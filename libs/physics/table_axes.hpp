#pragma once
// Axes of the tables that other programs read: where their nodes stand. Readers need only the nodes (docs/format.md).

#include "physics/geometry.hpp"
#include <vector>

namespace sky::physics {

/// Altitudes 0 .. top, m, evenly spread in sqrt(r^2 - R^2), the distance to the horizon: fine near the ground.
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

/// Relative azimuths 0 .. pi, rad, uniform.
std::vector<double> azimuthNodes(int count);

} // namespace sky::physics
