#pragma once
// The sky in an eclipse: an ordinary sky dimmed, each part by how much of its light the Moon takes.
//
// Single scattering is dimmed by the visible fraction of the disc at many nodes along each line of sight, weighted by
// where its light comes from (EclipseShares); higher orders by the quotient of eclipsed and uneclipsed light of a local
// field (sky::eclipse); the ground by both. Everything is a factor on the ordinary sky: where the Moon hides nothing it
// is exactly 1.

#include "eclipse/field.hpp"
#include "eclipse_shares.hpp"
#include "eclipse_view.hpp"
#include "phases.hpp"
#include "physics/sky.hpp"
#include "settings_used.hpp"
#include "shadow_light.hpp"
#include "sky_axes.hpp"

namespace showmysky {

/// A sky without Moon, its parts apart.
struct OrdinarySky {
    SkyView view;                          ///< `whole`: multiple scattering alone
    ViewTable groundDirect, groundDiffuse; ///< empty where the ground isn't shown
    ViewTable glow;                        ///< light that isn't the Sun's; may be empty
};

/// What an eclipse's light depends on, beside the altitude.
struct EclipseScene {
    sky::physics::EclipseBodies bodies;
    sky::eclipse::Orders orders;
    bool limbDarkening = false;
    bool field = true;          ///< false: pictures need no field of higher orders
    std::vector<Texel> weights; ///< [wavelength]
};

class EclipseSky
{
public:
    EclipseSky(const Atmosphere& atmosphere, const Phases& phases, const sky::physics::SunTable& sun);

    /// Begins anew what another scene changes.   throws sky::RangeError
    void set(const EclipseScene& scene);
    /// Does a part of the work; true once all is done.
    bool step();
    double fractionDone() const;

    /// \param eclipsed  light of higher orders that is dimmed already, in place of `sky`'s; null: that is dimmed by the local field
    SkyView dimmed(const OrdinarySky& sky, const ViewTable* eclipsed, int halfViews, int azimuths) const;

    /// What is left of the Sun's luminance at a node of a line of sight (unit vector). All work must be done.
    SunSeen sunAt(const std::array<double, 3>& direction, const sky::physics::RayNodes::Node& node) const;
    /// The share left, [wavelength], and where the middle of that light stands.
    sky::physics::MiddleOfLight visibleAt(const std::array<double, 3>& direction, const sky::physics::RayNodes::Node& node,
                                          double* result) const;
    /// Share left of the light of higher orders in a direction, and of the diffuse light of the ground there,
    /// [wavelength]. The first question computes the field where pictures did without.
    struct Ratios {
        std::vector<double> sky, ground;
    };
    Ratios ratios(const std::array<double, 3>& direction, bool ground);

    /// Does a part of the work on the field of higher orders, which pictures may do without; true once it is there.
    bool followField();
    /// Share left of the light of higher orders that comes from each node of lines of sight, [node of all lines][azimuth][wavelength].
    /// The field must be there.
    ///   lines, sines  nodes as seen from the camera, sines of the elevations
    ///   relative      azimuths from the Sun's, counted from x to y
    std::vector<float> nodeRatios(const std::vector<sky::physics::RayNodes>& lines, const std::vector<double>& sines,
                                  const std::vector<double>& relative) const;

private:
    std::vector<sky::eclipse::ViewRay> viewRays() const;
    void tabulateRatios();
    Texel ratioAt(const std::vector<Texel>& table, double coordinate, int half, double relative) const;

    const Atmosphere& atmosphere_;
    const Phases& phases_;
    const sky::physics::SunTable& sun_;
    sky::physics::LimbDarkening law_;
    std::shared_ptr<const sky::eclipse::AirRays> air_;
    EclipseShares shares_;
    std::optional<EclipseScene> scene_;
    sky::physics::Shadow shadow_;
    std::optional<ShadowLight> light_;
    std::optional<sky::eclipse::ScatteredField> field_;
    std::vector<Texel> skyRatios_, groundRatios_; ///< [ray][azimuth, whole turn from the Sun's]
    double sunAzimuth_ = 0;                       ///< in the frame, from x to y
    bool ready_ = false;
};

} // namespace showmysky
