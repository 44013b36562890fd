#pragma once
#include "physics/ray.hpp"
#include <vector>

namespace sky::solver {

/// Where along a ray scattered.comp looks at the Sun.
///
/// Nodes follow what changes with altitude: density, transmittance, the field. The Sun's place in the sky of a node changes more slowly, by
/// the angle between the verticals of the node and of the start, and inside a cloud hardly at all. So the folded light of the nodes is
/// shared out among few of them, the stations: that of a node between two goes to both, linearly in that angle. How far apart they may stand
/// follows from the error of linear interpolation, (x - a) (b - x) / 2 of the second derivative, weighted by the share of
/// the light.
struct Stations {
    /// What becomes of a node.
    struct Share {
        int station;   ///< nearer one of the two, counted along the ray; the other is the next
        float nearer;  ///< part of the light that counts there
        float farther; ///< and at the next
        float seen;    ///< part of the ray's light that comes from the node, roughly: mean over wavelengths; 0: none
        bool alone;    ///< all of it counts at `station`, where no other node's does
    };
    std::vector<physics::RayNodes::Node> places;
    std::vector<Share> shares; ///< [node + ground]

    /// \param groundAlbedo  [wavelength]
    /// \param fromGround    false: what the ground throws into the ray does not count
    ///   bend       angle of the Sun over which its field bends by as much as the field itself, rad
    ///   tolerance  relative error that one gap between stations may cost; 0: every node is a station
    Stations(const physics::RayNodes& ray, const std::vector<double>& groundAlbedo, bool fromGround, double bend, double tolerance);
};

} // namespace sky::solver
