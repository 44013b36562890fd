#include "model/eclipse_table.hpp"
#include <cmath>

namespace sky::model {

bool eclipseTableFits(const Manifest& manifest, const physics::EclipseBodies& bodies)
{
    const std::array<double, 3> camera{0, 0, 0};
    physics::EclipseBodies centred = bodies;
    centred.moonDirection = bodies.sunDirection;
    centred.moonDistance = manifest.moonDistance;
    centred.sunAngularRadius = manifest.sunAngularRadius;
    const auto stored = physics::makeShadow(centred).discs(camera), asked = physics::makeShadow(bodies).discs(camera);
    const double apart = asked.separation + std::abs(asked.sunRadius - stored.sunRadius) + std::abs(asked.moonRadius - stored.moonRadius);
    return apart <= eclipseTableMargin * std::abs(stored.moonRadius - stored.sunRadius);
}

} // namespace sky::model
