#pragma once
// The built-in projections in double precision: twins of shaders/render/projections.glsl.

#include "showmysky/sky.hpp"

namespace showmysky {

using Vector = std::array<double, 3>;

/// The camera's axes in the frame of the sky: right, up, forward.
std::array<Vector, 3> cameraAxes(const Camera& camera);

/// Half width and half height of the picture: rad, or tangents where the projection is perspective.
///   throws  Error where the field of view is outside its range
std::array<double, 2> projectionScale(const Camera& camera, double width, double height);

/// Unit vector of a place in the picture, in pixels from its lower left corner; 0, 0, 0 outside the projection.
Vector builtInDirection(const Camera& camera, double width, double height, double x, double y);

} // namespace showmysky
