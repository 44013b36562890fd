#pragma once
// Light that comes from the ground: all of it, or a disc. Random paths backwards from the camera.

#include "montecarlo/random.hpp"
#include "montecarlo/single.hpp"

#include <optional>

namespace sky::montecarlo {

/// A glowing disc on the ground, seen from the point below the camera. Metres along the ground, radians.
struct GroundDisc {
    double distance = 0; ///< of its centre
    double azimuth = 0;  ///< as Query::relativeAzimuth counts it
    double radius = 0;
};

/// Radiance from a ground whose own radiance is 1 (inside the disc, if there is one): light that has been scattered or reflected at
/// least once, 1.
class GroundLightTracer
{
public:
    ///   orders  events counted; 0: all
    GroundLightTracer(const Air& air, const Scene& scene, std::optional<GroundDisc> disc, int orders);

    /// Mean of a batch of paths.
    double batchMean(Random& random, int paths);
    /// The ground itself in direct view, dimmed by the air in between.
    double direct() const;

private:
    double path(Random& random);
    bool glows(Vec up) const;
    double towardsDisc(const Place& place, Vec direction, const Local& local, Random& random);
    double discDensity(double distance, double cosine) const;

    const Air& air_;
    Scene scene_;
    int orders_;
    bool everywhere_;
    Vec centre_{0, 0, 1};
    double halfChord_ = 0, area_ = 0; // of the disc: sine of half its angular radius; m^2
    Ray firstRay_;
    Leg firstLeg_, leg_, discLeg_;
    Local local_;
};

} // namespace sky::montecarlo
