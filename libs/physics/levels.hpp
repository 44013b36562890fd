#pragma once
#include "physics/profile.hpp"
#include <vector>

namespace sky::physics {

/// Altitudes at which a field of scattered light is known, m, increasing from 0 to the top: `count` evenly spread in sqrt(r^2 - R^2), and more
/// at jumps of a density and wherever the vertical optical depth between two exceeds a bound. That bound grows with the distance to the nearest
/// edge, and with all depths where there would be too many levels.
///   largestExtinction  cross sections, [species], m^2
std::vector<double> fieldLevels(const Profile& profile, const std::vector<double>& largestExtinction, int count);

/// Vertical optical depth as far as a field bends in it. Light is scattered around an edge (the top, the ground, a jump) until it has forgotten where
/// it came from; farther in it changes over as large a depth as lies between there and the nearest edge, as the diffusion equation has it.
class BendingDepth
{
public:
    /// \param edges  optical depths of the edges, increasing, two or more
    explicit BendingDepth(std::vector<double> edges);
    /// From the first edge to an optical depth that is not beyond the last.
    double operator()(double depth) const;

private:
    std::vector<double> edges_, bending_; // the latter at the edges
};

} // namespace sky::physics
