#pragma once
// Light of a ground that glows evenly all over the planet. Symmetric about the vertical: of the moments only m = 0 is left, and they
// depend on the altitude alone.

#include "physics/moments.hpp"
#include "physics/optics.hpp"
#include <functional>
#include <vector>

namespace sky::physics {

/// How finely the glow is computed; see docs/light-pollution.md for what fewer or more cost.
struct GlowSettings {
    int altitudes = 40;        ///< levels before the medium asks for more
    int degree = 8;            ///< of the harmonics: the horizon is the edge of the source
    int groundDirections = 10; ///< zenith angles from nadir to the horizon
    int limbDirections = 5;    ///< from the horizon to the horizontal
    int skyDirections = 10;    ///< from the horizontal to the zenith
    double cells = 2;          ///< relative size of the cells along a ray, see RayTracer
    int mostEvents = 100;      ///< of the field: beyond, the rest of the series is an estimate
    double tolerance = 3e-4;   ///< relative change of the closed series at which events end
};

/// Moments I_l(h) = integral of L Y_l0 over the sphere of the radiance L that a ground of radiance 1 makes: its own light, and what
/// the air and the ground have scattered of it.
struct GlowMoments {
    MomentGrid grid; ///< only its altitudes count
    int degree = 0;
    int wavelengths = 0;
    std::vector<double> values;           ///< [altitude][l][wavelength]; l = 0: ln I_0, others: I_l / I_0
    std::vector<double> groundIrradiance; ///< [wavelength], sr: downward, per radiance of the ground

    /// Moments at an altitude, [l][wavelength], as I_l.
    void interpolate(double altitude, double* result) const;
};

/// The field and how it was reached.
struct GlowField {
    GlowMoments total;
    std::vector<GlowMoments> perEvent; ///< kept on request: [0] is the light straight from the ground
    int eventCount = 0;                ///< scatterings and reflections of the last event that was computed
    double remainder = 0;              ///< largest relative change of the closed series by that event
};

/// Grid of the glow's altitudes for a medium.
MomentGrid glowGrid(const Profile& profile, const Optics& optics, const GlowSettings& settings);

/// Source iteration: each event's field is what the last one's scatters into the rays of every level. The series is followed until it
/// is geometric, then closed: all orders.
///   breath  called with the number of events done
GlowField solveGroundGlow(const Medium& medium, const Profile& profile, const Optics& optics, const GlowSettings& settings,
                          bool keepEvents = false, const std::function<void(int)>& breath = {});

/// The medium in shells for the glow: as few as the air allows, yet so many that light of a ground so near is followed where it bends.
Profile glowProfile(const Medium& medium);

/// Optics of the glow: peaks beyond the degree truncated, which a field as even as this one hardly feels.
Optics glowOptics(const Medium& medium, int degree);

} // namespace sky::physics
