#pragma once
// What every user of an eclipse's field asks: its lines of sight, and whether it is still the right one.

#include "eclipse/field.hpp"
#include "eclipse/frame.hpp"
#include "physics/air_entry.hpp"
#include "physics/sky.hpp"

namespace showmysky {

/// A line of sight of a camera, which may stand above the air. Where it misses the air there is no light, and any ray
/// will do.
inline sky::eclipse::ViewRay eclipseViewRay(const sky::physics::Planet& planet, double altitude, double mu, bool ground)
{
    const auto entry = enterAir(planet, altitude, mu);
    if (!entry)
        return {planet.topOfAtmosphere, 1, false, 0};
    const double before = entry->outerShift > 0 ? sky::eclipse::groundDistance(planet.radius, entry->outerScale, entry->outerShift, mu) : 0;
    return {entry->altitude, entry->mu, ground, before};
}

/// What a point of the air sees of the Sun.
struct SunSeen {
    double share; ///< 0..1
    sky::physics::MiddleOfLight middle;
};

/// At a node of a camera's line of sight; its scales are as seen from the camera.
inline SunSeen sunSeen(const sky::physics::Shadow& shadow, const sky::physics::Planet& planet, double altitude,
                       const std::array<double, 3>& direction, const sky::physics::RayNodes::Node& node)
{
    const double r = planet.radius + altitude, distance = r * node.nuScale / node.sunScale;
    const std::array<double, 3> place{distance * direction[0], distance * direction[1], distance * direction[2]};
    const auto sun = shadow.visibleSun(place);
    // Upwards there: the place seen from the planet's centre.
    const double rise = (sky::physics::Shadow::dot(sun.aside, place) + sun.aside[2] * r) * node.sunScale / r;
    return {sun.share, {rise, sky::physics::Shadow::dot(sun.aside, direction)}};
}

/// True if camera, Sun and Moon of one model stand the same.
inline bool samePlaces(const sky::physics::EclipseBodies& a, const sky::physics::EclipseBodies& b)
{
    return a.cameraAltitude == b.cameraAltitude && a.sunDirection == b.sunDirection && a.moonDirection == b.moonDirection &&
           a.moonDistance == b.moonDistance && a.sunAngularRadius == b.sunAngularRadius;
}

} // namespace showmysky
