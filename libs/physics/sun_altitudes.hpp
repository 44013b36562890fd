#pragma once
// Where the table of sunlight has altitudes.

#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include <vector>

namespace sky::physics {

/// Altitudes for a table of sunlight, m, increasing, 0 .. top: evenly spread for a gentle atmosphere, both sides of every jump of the profile, and
/// more where the air is dense or ends: between two of them optical depths are taken as linear in sqrt(r^2 - R^2), which they are not in haze or a cloud.
///   count  of the evenly spread ones
std::vector<double> sunAltitudes(const Profile& profile, const Optics& optics, int count);

} // namespace sky::physics
