#pragma once
// Sun and Moon of a scene as the physics wants them.

#include "model/manifest.hpp"
#include "physics/eclipse.hpp"
#include "showmysky/sky.hpp"

namespace showmysky {

/// \param sunAngularRadius  rad, at the camera
sky::physics::EclipseBodies bodiesOf(const sky::model::Manifest& manifest, double altitude, const Sun& sun, const Moon& moon,
                                     double sunAngularRadius);

/// throws sky::RangeError where the Moon can't be there
EclipseState stateOf(const sky::physics::EclipseBodies& bodies);

/// Nodes of a ray through the shadow, for single directions.
constexpr int nodesInShadow = 400;

} // namespace showmysky
