#pragma once
#include "physics/geometry.hpp"
#include <algorithm>
#include <vector>

namespace sky::physics {

/// How finely the moments are computed. Chosen from the measured front of time against error (docs/accuracy).
struct MomentSettings {
    int altitudes = 16;        ///< levels before the medium asks for more
    int suns = 32;             ///< elevations of the Sun
    int degree = 4;            ///< of the harmonics
    int groundDirections = 5;  ///< zenith angles from nadir to the horizon
    int limbDirections = 4;    ///< from the horizon to the horizontal
    int skyDirections = 8;     ///< from the horizontal to the zenith
    int azimuths = 6;          ///< over half a turn
    int directNodes = 48;      ///< along a ray, for the first event: sunlight varies fast near the shadow's edge
    int nodes = 12;            ///< along a ray, for later events: the scattered field is smoother
    bool truncatePeaks = true; ///< delta-M scaling
    double tolerance = 2.5e-3; ///< share of the light, rms: all orders are there when an event changes their closed series by less
    int leastAzimuthal = 4;    ///< azimuthal order that all events go up to
    /// Azimuths for sunlight before it meets phase functions, which vary faster; 0, or more than `azimuths`: as many as those.
    int lightAzimuths = 0;
    /// Relative error that later events may take on in each gap between the stations of a ray (solver/stations.hpp); 0: none.
    double stationTolerance = 0;

    /// Share of an event's light for which an azimuthal order is worth its time. The sky holds less of it, and loses only what later events
    /// would make of it.
    double negligibleOrder() const { return 20 * tolerance; }
    /// Azimuths for light of azimuthal orders 0..m.
    int azimuthsFor(int m) const { return std::min(azimuths, m + 2); }
};

/// Zenith angles at which the field of one level is gathered, with the weights of their quadrature over mu.
/// Three panels: the radiance jumps at the horizon, and just above it, seen from high up, lies the thin bright limb.
struct Directions {
    std::vector<double> mu;
    std::vector<double> weight;
    std::vector<bool> hitsGround;
};

Directions directionsAt(const Planet& planet, double altitude, const MomentSettings& settings);

} // namespace sky::physics
