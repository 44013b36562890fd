#include "physics/table_axes.hpp"
#include "base/angles.hpp"
#include <algorithm>

namespace sky::physics {

using base::pi;

std::vector<double> altitudeNodes(const Planet& planet, const int count)
{
    std::vector<double> nodes;
    const double whole = horizonDistance(planet, planet.topOfAtmosphere);
    for (int i = 0; i < count; ++i)
        nodes.push_back(altitudeOfHorizon(planet, count > 1 ? whole * i / (count - 1) : 0));
    if (count > 1)
        nodes.back() = planet.topOfAtmosphere;
    return nodes;
}

std::vector<double> horizonAngleNodes(const double range, const int count)
{
    std::vector<double> nodes;
    const double whole = std::asinh(range / horizonAngleScale);
    for (int i = 0; i < count; ++i)
        nodes.push_back(horizonAngleScale * std::sinh(whole * i / std::max(1, count - 1)));
    nodes.back() = range;
    return nodes;
}

std::vector<double> viewMuNodes(const Planet& planet, const double altitude, const int count)
{
    const double horizon = horizonElevation(planet, altitude);
    const auto below = horizonAngleNodes(pi / 2 + horizon, count / 2), above = horizonAngleNodes(pi / 2 - horizon, count / 2);
    std::vector<double> mu;
    for (int k = count / 2 - 1; k >= 0; --k)
        mu.push_back(std::max(-1., std::sin(horizon - below[k])));
    for (int k = 0; k < count / 2; ++k)
        mu.push_back(std::min(1., std::sin(horizon + above[k])));
    return mu;
}

ViewPlace viewPlace(const Planet& planet, const double altitude, const int count, const double elevation)
{
    const double horizon = horizonElevation(planet, altitude), angle = elevation - horizon;
    const bool ground = angle < 0;
    const double range = ground ? pi / 2 + horizon : pi / 2 - horizon;
    const double t = std::asinh(std::min(range, std::abs(angle)) / horizonAngleScale) / std::asinh(range / horizonAngleScale);
    return {ground, t * (count / 2 - 1)};
}

std::vector<double> sunElevationNodes(const Planet& planet, const double altitude, const SunTableAxis& axis, const int count)
{
    const double horizon = horizonElevation(planet, altitude), range = pi / 2 - horizon;
    std::vector<double> nodes;
    for (int k = 0; k < count; ++k) {
        const double v = axis.vDark + (1 - axis.vDark) * k / std::max(1, count - 1);
        nodes.push_back(std::clamp(horizon + range * std::sinh(axis.scale * v) / std::sinh(axis.scale), -pi / 2, pi / 2));
    }
    return nodes;
}

double sunElevationPosition(const Planet& planet, const double altitude, const SunTableAxis& axis, const int count, const double elevation)
{
    const double horizon = horizonElevation(planet, altitude), range = pi / 2 - horizon;
    const double v = std::asinh((elevation - horizon) / range * std::sinh(axis.scale)) / axis.scale;
    return (v - axis.vDark) / (1 - axis.vDark) * (count - 1);
}

SunTableAxis sunTableAxis(const double depth, const double sunset)
{
    constexpr double usualScale = 4.5;
    const double scale = std::asinh(std::sinh(usualScale) / sunset);
    return {scale, std::asinh(-depth / (pi / 2) * std::sinh(scale)) / scale};
}

std::vector<double> azimuthNodes(const int count)
{
    std::vector<double> nodes;
    for (int k = 0; k < count; ++k)
        nodes.push_back(count > 1 ? pi * k / (count - 1) : 0);
    return nodes;
}

} // namespace sky::physics
