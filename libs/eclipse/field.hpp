#pragma once
// Light of two orders and more in an eclipse, to any order, around one observer (docs/eclipses.md).
//
// A local grid of points, altitude x along x across the mirror plane, holds the radiance moments of light that has had one event
// or more. Every sweep gathers the light of the last event along rays from every point. Eclipsed and uneclipsed sunlight go
// through the same arithmetic side by side, and only their quotient is used: it multiplies the accurate sky of the model, so that what
// the local grid does wrong to both cancels, and no eclipse means a quotient of exactly 1.

#include "eclipse/settings.hpp"
#include "physics/eclipse.hpp"
#include "physics/medium.hpp"
#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include "physics/ray.hpp"
#include "physics/sun.hpp"
#include <functional>
#include <memory>
#include <vector>

namespace sky::eclipse {

/// What a model needs once: the rays of every level, whatever Sun and Moon do. Some tens of milliseconds.
class AirRays;
std::shared_ptr<const AirRays> traceAir(const physics::Medium& medium, const physics::Profile& profile, const physics::Optics& optics,
                                        const FieldSettings& settings);

/// What the Moon leaves of the Sun at a point in the camera's frame; called from several threads.
using SunlightLeft = std::function<physics::VisibleSun<float>(const std::array<float, 3>& point)>;

/// A ray that is seen, from where it begins inside the air.
struct ViewRay {
    double altitude = 0; ///< m, 0 .. top
    double mu = 1;       ///< cosine of its zenith angle there
    bool hitsGround = false;
    double groundDistance = 0; ///< m, from below the camera to below that place: 0 unless the camera is above the air
};

/// Rays that are seen, traced: what of a view does not depend on Sun, Moon and azimuth. Keep it while the camera's altitude stays.
class TracedViews;
std::shared_ptr<const TracedViews> traceViews(const AirRays& air, const std::vector<ViewRay>& views);
/// Every node of rays as a view of its own, [node of all rays]: light from there alone, as it adds up along a ray.
///   rays  scales of their nodes as seen from the camera, which may stand above the air
///   mu    [ray], cosines of their zenith angles at the camera
std::shared_ptr<const TracedViews> traceNodes(const AirRays& air, const std::vector<physics::RayNodes>& rays,
                                              const std::vector<double>& mu);

/// Light in directions of view, [ray][azimuth][wavelength], per unit solar irradiance.
struct ViewLight {
    int azimuths = 0, wavelengths = 0;
    std::vector<float> eclipsed, uneclipsed;             ///< radiance of the scattered light of orders 2 and up, sr^-1
    std::vector<float> groundEclipsed, groundUneclipsed; ///< diffuse irradiance of the ground where the ray meets it; else 0

    /// Eclipsed over uneclipsed, 0..1; 1 where there is no light at all.
    float skyRatio(int ray, int azimuth, int wavelength) const;
    float groundRatio(int ray, int azimuth, int wavelength) const;
};

/// The field of one place of Sun, Moon and observer.
class ScatteredField
{
public:
    /// \param left     empty: of a uniform disc, physics::Shadow::visibleSun
    /// \param sun      of the same medium and optics as the rays; must live as long as this
    /// throws RangeError as physics::makeShadow
    ScatteredField(std::shared_ptr<const AirRays> rays, const physics::SunTable& sun, const physics::EclipseBodies& bodies,
                   const Orders& orders, SunlightLeft left = {});
    ~ScatteredField();
    ScatteredField(ScatteredField&&) noexcept;
    ScatteredField& operator=(ScatteredField&&) noexcept;

    /// Does a part of the work on all cores, tens of milliseconds; true once all is done.
    bool step();
    double fractionDone() const;
    /// Events that were counted so far.
    int events() const;

    /// The sky of a finished field.
    ///   azimuths  rad, in the camera's frame: from North (x) over West (y)
    ViewLight view(const TracedViews& views, const std::vector<double>& azimuths) const;
    ViewLight view(const std::vector<ViewRay>& views, const std::vector<double>& azimuths) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sky::eclipse
