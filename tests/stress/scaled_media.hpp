#pragma once
#include "physics/medium.hpp"

namespace sky::test {

/// All lengths of a medium, in other units.
inline physics::Medium scaled(physics::Medium medium, double factor)
{
    medium.planetRadius *= factor;
    medium.topOfAtmosphere *= factor;
    for (double& altitude : medium.altitudes)
        altitude *= factor;
    for (auto& species : medium.species)
        for (double& sigma : species.extinctionCrossSection)
            sigma /= factor;
    return medium;
}

} // namespace sky::test
