#pragma once
#include "physics/cells.hpp"
#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include <limits>
#include <vector>

namespace sky::physics {

/// Where along a ray the radiation field is sampled, and with what weight: a product integration.
///
/// The field (sunlight, moments) is smooth along the ray; density and transmittance need not be. So the field is taken as
/// piecewise linear between few nodes, while the weights integrate density times transmittance times the hat function of
/// each node over many fine cells that end at the shells of the medium:
///     L = sum_k sum_i w_ki field_i(node k),   w_ki = integral beta_sca,i(s) T(s) hat_k(s) ds
/// A thin cloud or a steep foot of a profile therefore costs cells (here, in double), not nodes (on the GPU).
struct RayNodes {
    struct Node {
        double altitude; ///< m
        double sunScale; ///< r / r_k: muSun_k = sunScale muSun + nuScale nu
        double nuScale;  ///< s_k / r_k
        double mu;       ///< cosine of the ray's zenith angle at the node
    };
    std::vector<Node> nodes;
    std::vector<double> weights; ///< [node][scatterer][wavelength], dimensionless: scattering optical depth seen
    bool hitsGround = false;
    Node ground{};                           ///< where the ray meets the ground, if it does
    std::vector<double> groundTransmittance; ///< [wavelength], 0 if the ray misses the ground
};

/// What air up to each point of a ray scatters towards its start: the integrals behind RayNodes' weights, for fields that choose
/// their own nodes.
struct SeenColumns {
    std::vector<double> distances;           ///< [cells + 1], m, from 0 to the ground or to space
    std::vector<double> seen;                ///< [cells + 1][scatterer][wavelength]: integral of beta_sca T from the start
    std::vector<double> transmittance;       ///< [cells + 1][wavelength], from the start
    std::vector<double> groundTransmittance; ///< [wavelength], 0 if the ray misses the ground
};

/// A ray in the fine cells that its integrals run over, for fields that are known everywhere.
struct RayCells {
    double altitude = 0, mu = 1; ///< m, where it starts, and the cosine of its zenith angle there
    bool hitsGround = false;
    std::vector<double> bounds;    ///< [cells + 1], m, from 0 to the ground or to space
    std::vector<double> altitudes; ///< [cells + 1], m, there
    std::vector<double> columns;   ///< [cells][species], m^-2
    std::vector<double> centres;   ///< [cells][species]: centre of mass along the cell, 0..1
};

/// Follows rays through a profile. Keeps scratch memory: one tracer a thread.
class RayTracer
{
public:
    /// \param cellScale fine cells: relative size, 1 is accurate to about 1e-5; larger is coarser and cheaper
    RayTracer(const Profile& profile, const Optics& optics, double cellScale = 1);

    /// Nodes and weights of the ray from `altitude` (0..top, m) in direction `mu`.
    ///   count       nodes, >= 2
    ///   hitsGround  whether the ray counts as hitting the ground: decided by the caller's half of a table, not by rounding
    RayNodes trace(double altitude, double mu, int count, bool hitsGround, NodesFor nodesFor = NodesFor::Sunlight);

    /// The same integrals, cumulated along the ray.
    SeenColumns seen(double altitude, double mu, bool hitsGround);

    /// The cells of the ray themselves, up to where all wavelengths have passed an optical depth of `deepest`.
    RayCells cells(double altitude, double mu, bool hitsGround, double deepest);

    /// Column of each species from `altitude` to space, [species], m^-2; the ray must miss the ground. Less where all wavelengths have passed an
    /// optical depth of `deepest` before.
    void columns(double altitude, double mu, double* result, double deepest = std::numeric_limits<double>::infinity());

private:
    void walk(const Profile& profile, double altitude, double mu, bool hitsGround, const CellLimits& limits,
              double deepest = std::numeric_limits<double>::infinity());
    /// Light that passes a cell of the ray that was walked, all [wavelength].
    ///   tau            optical depth of the cell
    ///   transmittance  up to the cell, then up to its end
    ///   mean           transmittance to the viewer, the exact mean over the cell
    ///   shift          of the centre from which its light comes, in lengths of the cell
    void pass(int cell, double* tau, double* transmittance, double* mean, double* shift) const;

    const Profile& profile_;
    const Profile underEdges_; // the same, with shells there
    const Optics& optics_;
    CellLimits limits_;
    std::vector<double> bounds_;  // [cells + 1], distances
    std::vector<double> columns_; // [cells][species]
    std::vector<double> centres_; // [cells][species], centre of mass along the cell, 0..1
    std::vector<CellPart> parts_;
    std::vector<double> altitudes_;                     // [cells + 1]
    std::vector<double> halvings_;                      // [cells], of the way to an upper edge of the air
    std::vector<double> maxExtinction_, minExtinction_; // [species]
};

} // namespace sky::physics
