#pragma once
// Rays as the sweeps over the grid read them: where their nodes stand, and what light from there counts.

#include "eclipse/field.hpp"
#include "eclipse/lane.hpp"
#include "eclipse/stations.hpp"
#include "physics/ray.hpp"

namespace sky::eclipse {

struct GridRay {
    float mu, weight; ///< cosine of the zenith angle; weight of the quadrature over mu
    bool hitsGround;
    Stations direct, scattered; ///< in levels of sunlight; of the grid
    Lanes directWeights;        ///< [group][entry of direct][scatterer]: weight over 4 pi
    Lanes coefficients;         ///< [group][entry of scattered][lm]: sum over scatterers of weight lambda_l, times the harmonic factor
    float groundDistance = 0;
    Lanes ground;               ///< [group]: transmittance times albedo / pi
    std::vector<float> factors; ///< [lm]: the harmonic factors at mu
};

/// Levels in altitude with linear interpolation in sqrt(r^2 - R^2).
class Levels
{
public:
    Levels(const physics::Planet& planet, std::vector<double> altitudes);
    int count() const { return static_cast<int>(altitudes_.size()); }
    double altitude(int level) const { return altitudes_[static_cast<std::size_t>(level)]; }
    Place place(double altitude, double distance) const;

private:
    physics::Planet planet_;
    std::vector<double> altitudes_, measure_;
};

class AirRays
{
public:
    AirRays(const physics::Medium& medium, const physics::Profile& profile, const physics::Optics& optics, const FieldSettings& settings);

    const physics::Medium& medium;
    const physics::Profile& profile;
    const physics::Optics& optics;
    const FieldSettings settings;
    const int degree, wavelengths, groups, scatterers;
    Levels levels, sunlightLevels;
    std::vector<std::vector<GridRay>> rays; ///< [level][direction]
    Lanes phase;                            ///< [group][scatterer][degree + 1]: (2 l + 1) lambda_l

    /// Coefficients of scattered light along a ray, as in GridRay.
    Lanes coefficientsOf(const physics::RayNodes& ray) const;

private:
    GridRay trace(physics::RayTracer& tracer, double altitude, double mu, double weight, bool hitsGround) const;
};

} // namespace sky::eclipse
