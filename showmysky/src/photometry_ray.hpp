#pragma once
// Rays for photometric questions: the product integration of physics/ray.hpp, in single precision and without allocations.

#include "photometry_lanes.hpp"
#include "physics/cells.hpp"
#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include <vector>

namespace showmysky {

/// How much work a question may cost. The default holds 0.1 % by day, also in haze (tests/showmysky/photometry.cpp, photometry_haze.cpp).
struct Effort {
    int singleNodes = 80;   ///< along a ray, for the direct light; more where shadows have edges
    int multipleNodes = 20; ///< for the field
    sky::physics::CellLimits cell{1, 0.12, 0.5};
    double profileTolerance = 1e-3; ///< relative, of densities
};

/// Nodes along a ray, as physics::RayNodes::Node, and what each is worth.
struct NodeSet {
    std::vector<double> altitudes;              ///< [node], m
    std::vector<float> sunScales, nuScales, mu; ///< [node]
    lanes::Blocks weights;                      ///< [node][scatterer][block], scattering optical depth seen

    int count() const { return static_cast<int>(altitudes.size()); }
};

/// Light that one scatterer of a cell sends to the eye.
struct CellLight {
    lanes::Block amount, slope, excess; ///< per cross section; sky::physics::LightAlong
};

/// One traced ray, and the memory to trace the next.
struct FastRay {
    double altitude = -1, mu = 0; ///< where it starts; altitude -1: nothing is traced yet
    bool hitsGround = false;
    lanes::Blocks transmittance; ///< [block], to the ray's end
    NodeSet single, multiple;
    unsigned version = 0; ///< counts the rays traced

    int cells = 0;
    std::vector<double> bounds, heights;             ///< [cells + 1], distance and altitude
    std::vector<int> intervals;                      ///< [cells], of the profile
    lanes::Blocks arguments, logarithmic, densities; ///< [cells][2 points][species] in a row
    std::vector<float> columns;                      ///< [cells][species], in units of RayFolder's scales
    std::vector<float> centres;                      ///< [cells][species], of the density, 0..1 of the cell
    std::vector<float> light, depth;                 ///< [cells], scattered there, and optical depth; sums over the wavelengths
    std::vector<CellLight> lit;                      ///< [cells][scatterer][block]
    std::vector<sky::physics::NodeShares> shares;    ///< [cells]
    std::vector<double> measured, position;
    std::vector<sky::physics::CellPart> parts;
};

/// Traces rays through one medium. Const functions are thread-safe.
class RayFolder
{
public:
    RayFolder(const sky::physics::Profile& profile, const sky::physics::Optics& optics, const Effort& effort);

    /// Follows the ray from `altitude` (0..top) in direction `mu`; does nothing where that was the last one.
    void trace(double altitude, double mu, FastRay& ray) const;

    int blocks() const { return blocks_; }
    int scatterers() const { return static_cast<int>(scatterers_.size()); }

private:
    void walk(FastRay& ray) const;
    void findColumns(FastRay& ray) const;
    void placeNodes(FastRay& ray, int count, const sky::physics::NodeMeasure& measure, NodeSet& set) const;

    struct Segment {
        double start, slope; ///< of the density, or of its logarithm, in the interval
        float logarithmic;   ///< 1 or 0
    };
    const sky::physics::Profile& profile_;
    Effort effort_;
    int species_, wavelengths_, blocks_;
    std::vector<int> scatterers_;
    std::vector<Segment> segments_; ///< [interval][species], densities in units of their largest
    /// Of an interval, the largest of the wavelengths: exponential between its ends, as if the air were one species; where one end has none,
    /// that of the other.
    struct Extinction {
        double low, slope; ///< m^-1
    };
    std::vector<Extinction> extinction_; ///< [interval]
    lanes::Blocks extinctions_;          ///< [species][block], cross section times largest density
    lanes::Blocks scatterings_;          ///< [scatterer][block]
};

} // namespace showmysky
