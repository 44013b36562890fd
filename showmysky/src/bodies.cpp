#include "bodies.hpp"
#include <algorithm>

namespace showmysky {

namespace physics = sky::physics;

physics::EclipseBodies bodiesOf(const sky::model::Manifest& manifest, const double altitude, const Sun& sun, const Moon& moon,
                                const double sunAngularRadius)
{
    physics::EclipseBodies bodies;
    bodies.planet = {manifest.planetRadius, manifest.topOfAtmosphere};
    bodies.cameraAltitude = altitude;
    bodies.sunDirection = directionOf(sun.azimuth, sun.zenithAngle);
    bodies.moonDirection = directionOf(moon.azimuth, moon.zenithAngle);
    bodies.sunDistance = manifest.sunDistance;
    bodies.moonDistance = moon.distance;
    bodies.sunAngularRadius = sunAngularRadius;
    bodies.moonRadius = manifest.moonRadius;
    return bodies;
}

EclipseState stateOf(const physics::EclipseBodies& bodies)
{
    const auto discs = physics::makeShadow(bodies).discs({0, 0, 0});
    EclipseState state;
    state.obscuration = physics::coveredFraction(discs);
    state.separation = discs.separation;
    state.sunAngularRadius = discs.sunRadius;
    state.moonAngularRadius = discs.moonRadius;
    const double overlap = discs.sunRadius + discs.moonRadius - discs.separation;
    const bool central = discs.separation <= std::abs(discs.moonRadius - discs.sunRadius);
    state.magnitude = central ? discs.moonRadius / discs.sunRadius : std::max(0., overlap / (2 * discs.sunRadius));
    if (central)
        state.phase = discs.moonRadius >= discs.sunRadius ? EclipseState::Phase::total : EclipseState::Phase::annular;
    else if (overlap > 0)
        state.phase = EclipseState::Phase::partial;
    return state;
}

} // namespace showmysky
