#pragma once
// Where the nodes of aerial perspective stand along a line of sight; twin on the GPU: shaders/lib/aerial.glsl.

#include <cmath>

namespace showmysky {

enum class AerialSpacing {
    fromCamera, ///< fine at the camera
    bothEnds,   ///< and at the ground, where the line ends there
    even        ///< across the limb of the air, seen from above it
};

constexpr double aerialScale = 300; ///< m: below, distances count linearly, beyond by their logarithm

/// Distance of a node, m.
///   x       0 at the camera (or where the line enters the air) to 1 at the end of the line
///   length  of the line in the air, m
inline double aerialDistance(double x, double length, AerialSpacing spacing)
{
    if (spacing == AerialSpacing::even || length < 1e-3)
        return x * length;
    const double range = std::log1p(length / aerialScale);
    if (spacing == AerialSpacing::fromCamera)
        return aerialScale * std::expm1(x * range);
    const double quotient = std::exp((2 * x - 1) * range);
    return (quotient * (length + aerialScale) - aerialScale) / (1 + quotient);
}

} // namespace showmysky
