#include "obscuration.hpp"

#include "physics/eclipse.hpp"
#include "showmysky/sky.hpp"

namespace showmysky::app::preview {

Obscuration obscuration(const SceneSettings& settings, double planetRadius, double topOfAtmosphere,
                        double sunAngularRadius)
{
    constexpr double degree = 3.14159265358979323846 / 180;
    sky::physics::EclipseBodies bodies;
    bodies.planet = {planetRadius, topOfAtmosphere};
    bodies.cameraAltitude = settings.altitude;
    bodies.sunDirection = directionOf(settings.sun.azimuth, settings.sun.zenithAngle);
    bodies.moonDirection = directionOf(settings.moon.azimuth, settings.moon.zenithAngle);
    bodies.moonDistance = settings.moon.distance;
    bodies.sunAngularRadius = settings.sun.angularRadius.value_or(sunAngularRadius);
    const auto discs = sky::physics::makeShadow(bodies).discs({0, 0, 0});
    return {sky::physics::coveredFraction(discs), discs.sunRadius / degree, discs.moonRadius / degree,
            discs.separation / degree};
}

} // namespace showmysky::app::preview
