#pragma once
// Light gathered along a ray in single precision: the fast twin of physics::SkyEvaluator.

#include "photometry_ray.hpp"
#include "physics/aureole.hpp"
#include "physics/moments.hpp"
#include "physics/sun.hpp"
#include <optional>

namespace showmysky {

/// Memory of one question at a time.
struct FastScratch {
    /// Where in the table of sunlight a node is; depends on its altitude alone.
    struct SunRow {
        int row;
        float share; ///< of the row above
    };
    FastRay ray;
    unsigned prepared = 0; ///< version of the ray that these belong to
    std::vector<SunRow> sunRows;
    std::vector<float> horizons;      ///< [node], elevation, rad
    std::vector<float> axisScales;    ///< [node], 1 / log2 of the whole axis of elevations
    std::vector<float> above, places; ///< [node], of the Sun over the horizon, rad; on the axis, 0..1
    std::vector<sky::physics::Stencil> fieldRows;
    std::vector<float> factors;                    ///< [lm][node]
    std::vector<float> elevations, cosines;        ///< [node], of the Sun, rad; of the relative azimuth there
    std::vector<float> multiples, beforeThem;      ///< [node], cos(m phi), cos((m-1) phi)
    std::vector<float> harmonics;                  ///< [lm][node], towards the eye
    lanes::Blocks lit;                             ///< [scatterer][block]
    lanes::Blocks phase, byDegree;                 ///< [scatterer][block], [l][block]
    lanes::Blocks sum;                             ///< [block]
    std::optional<sky::physics::RayTracer> tracer; ///< towards the Sun, for its aureole; made where it is needed first
    std::vector<double> columns, peakDepths;       ///< physics::Aureole::depths
    std::vector<double> aureole;                   ///< [wavelength], factors
};

/// Radiance per unit solar irradiance, sr^-1. Const functions are thread-safe, each with a scratch of its own.
class FastGather
{
public:
    struct Parts {
        bool single, multiple;
        bool exactPhase; ///< of single scattering; false: cut at the degree, which is smooth enough for hemispheres
    };
    /// \param moments  may be null: single scattering alone
    /// \param aureole  see physics::SkyEvaluator
    FastGather(const sky::physics::Medium& medium, const sky::physics::Optics& optics, const sky::physics::SunTable& sun,
               const sky::physics::Moments* moments, const Effort& effort = {}, const sky::physics::Aureole* aureole = nullptr);

    /// Leaves the traced ray in the scratch.
    ///   altitude  0..top       nu  cosine of the angle between view and Sun
    ///   result    [wavelength]
    void radiance(FastScratch& scratch, double altitude, double mu, double muSun, double nu, const Parts& parts, double* result) const;

    void trace(FastScratch& scratch, double altitude, double mu) const { folder_.trace(altitude, mu, scratch.ray); }

private:
    void prepare(FastScratch& scratch) const;
    void gatherSingle(FastScratch& scratch, double altitude, double muSun, double nu, bool exactPhase) const;
    void gatherMultiple(FastScratch& scratch, double muSun, double nu) const;
    void exactPhase(double nu, FastScratch& scratch) const;
    void addAureole(double altitude, double muSun, double nu, FastScratch& scratch) const;
    void truncatedPhase(double nu, FastScratch& scratch) const;

    const sky::physics::Optics& optics_;
    const sky::physics::SunTable& sun_;
    const sky::physics::Moments* moments_;
    const sky::physics::Aureole* aureole_;
    sky::physics::Planet planet_;
    sky::physics::Profile profile_;
    RayFolder folder_;
    int wavelengths_, blocks_, scatterers_, degree_, bentDegree_;
    double sunRadius_;
    lanes::Blocks depth_;           ///< [altitude][elevation][block], optical depth towards the Sun
    lanes::Blocks field_;           ///< [altitude][sun][lm][block], as physics::Moments::values
    lanes::Blocks lambda_;          ///< [scatterer][l][block]
    std::vector<double> angles_;    ///< rad
    lanes::Blocks phase_;           ///< [angle][scatterer][block]: ln p, or p itself where that is not finite somewhere
    std::vector<bool> logarithmic_; ///< [scatterer]
};

} // namespace showmysky
