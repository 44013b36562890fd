#pragma once
#include "physics/geometry.hpp"
#include "physics/ray.hpp"
#include "physics/sun.hpp"

namespace sky::physics {

/// Fraction of the Sun's disc that shows over the horizon to a node of a ray, which stands for its surroundings: for light that falls off linearly
/// to both neighbours. Their mean sees the Sun as high as said here, and how its height spreads makes the disc larger. Where the node alone counted,
/// the light of a ray would go out in steps, node by node, on a planet with a small Sun. Twin: shaders/lib/sun.glsl.
///   before, here, after  elevation of the Sun's centre above the horizon at the neighbours and at the node, rad; at an end of the ray the only
///                        neighbour stands for both
inline double visibleAlong(double before, double here, double after, double sunRadius)
{
    // Light that falls off to a neighbour at b has the mean b / 3 and the mean square b^2 / 6, a disc of radius R the mean square R^2 / 4.
    const double b = before - here, a = after - here;
    return visibleDiscFraction(here + (b + a) / 6, std::sqrt(sunRadius * sunRadius + (b * b - b * a + a * a) * (2. / 9)));
}

/// The same for all nodes of a ray.
///   above    [node]: elevation of the Sun's centre above the horizon, rad
///   returns  [node]
inline std::vector<double> visibleAlong(const std::vector<double>& above, double sunRadius)
{
    const std::size_t nodes = above.size();
    std::vector<double> visible(nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
        const double next = above[k + 1 < nodes ? k + 1 : k > 0 ? k - 1 : k];
        visible[k] = visibleAlong(k > 0 ? above[k - 1] : next, above[k], next, sunRadius);
    }
    return visible;
}

inline std::vector<double> visibleAlong(const SunTable& sun, const RayNodes& ray, double muSun, double nu, double sunRadius)
{
    std::vector<double> above;
    for (const auto& node : ray.nodes)
        above.push_back(std::asin(std::clamp(node.sunScale * muSun + node.nuScale * nu, -1., 1.)) - sun.horizon(node.altitude));
    return visibleAlong(above, sunRadius);
}

} // namespace sky::physics
