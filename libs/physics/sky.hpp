#pragma once
#include "physics/aureole.hpp"
#include "physics/moments.hpp"
#include "physics/ray.hpp"
#include "physics/sun.hpp"
#include <vector>

namespace sky::physics {

/// Where the middle of the Sun's light stands for a node, less where the disc's does.
struct MiddleOfLight {
    double rise; ///< sine of the elevation: SunTable::transmittance
    double nu;   ///< cosine of the angle between view and Sun
};

/// Radiance of the sky from moments, on the CPU in double precision: answers photometric questions without a GPU, and is
/// the twin by which the shaders are checked. All results per unit solar irradiance (sr^-1).
class SkyEvaluator
{
public:
    struct Parts {
        bool single = true, multiple = true;
        int singleNodes = 96; ///< along the ray, for the direct light; more where shadows have edges: Profile::forShadows
        int multipleNodes = 24;
        bool exactPhase = true; ///< false: phase functions truncated at the degree, as inside the iteration
    };
    ///   aureole  for exact phase functions of truncated peaks; null: as if they scattered once at most
    SkyEvaluator(const Medium& medium, const Profile& profile, const Optics& optics, const SunTable& sun, const Aureole* aureole = nullptr);

    /// Light scattered into a ray.
    ///   moments   of the field that is scattered on; may be null where only single scattering is asked for
    ///   nu        cosine of the angle between view and Sun
    ///   result    [wavelength], sr^-1, single plus multiple as asked
    void radiance(RayTracer& tracer, const Moments* moments, double altitude, double mu, double muSun, double nu, const Parts& parts,
                  double* result) const;

    const SunTable& sun() const { return sun_; }

    /// Light scattered along given nodes of a ray: from direct sunlight, from the moments.
    ///   middles     [node], where an eclipse leaves light; empty: everywhere in the middle of the disc
    ///   peakDepths  of the camera's aureole (Aureole::depths), for exact phase functions
    void singleAlong(const RayNodes& ray, double muSun, double nu, bool exactPhase, double* result,
                     const std::vector<MiddleOfLight>& middles = {}, const std::vector<double>& peakDepths = {}) const;
    void multipleAlong(const RayNodes& ray, const Moments& moments, double muSun, double nu, double* result) const;

private:
    const Medium& medium_;
    const Profile& profile_;
    const Optics& optics_;
    const SunTable& sun_;
    const Aureole* const aureole_;
};

} // namespace sky::physics
