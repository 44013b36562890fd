#pragma once
// Cameras above the air: a ray is followed from where it enters.

#include "physics/geometry.hpp"
#include "physics/ray.hpp"
#include <algorithm>
#include <optional>

namespace sky::physics {

/// A ray inside the air, and how the Sun's height along it follows from the Sun's height at the camera.
struct AirEntry {
    double altitude, mu;           ///< where the ray enters, or the camera itself
    double outerScale, outerShift; ///< cos(Sun's zenith angle) there = outerScale muSun + outerShift nu

    /// A node of the ray from the entry, seen from the camera.
    RayNodes::Node node(RayNodes::Node own) const
    {
        own.nuScale += own.sunScale * outerShift;
        own.sunScale *= outerScale;
        return own;
    }
};

/// Nothing if the ray misses the air.
inline std::optional<AirEntry> enterAir(const Planet& planet, double altitude, double mu)
{
    if (altitude <= planet.topOfAtmosphere)
        return AirEntry{altitude, mu, 1, 0};
    const double entry = mu < 0 ? distanceToShell(planet, altitude, mu, planet.topOfAtmosphere, true) : -1;
    if (entry < 0)
        return std::nullopt;
    const double r = planet.radius + altitude, top = planet.radius + planet.topOfAtmosphere;
    return AirEntry{planet.topOfAtmosphere, std::clamp((r * mu + entry) / top, -1., 1.), r / top, entry / top};
}

} // namespace sky::physics
