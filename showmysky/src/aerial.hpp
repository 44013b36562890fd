#pragma once
// Aerial perspective: how the light of a line of sight grows with distance, and what its air lets through.
//
// Light is tabulated as shares of the light of the whole line, one for each of the sky's tables, so that a point at infinity has
// exactly the sky behind it. Computed from the moments and the medium along fewer lines than the sky's, only for hosts that ask.

#include "atmosphere.hpp"
#include "eclipse_view.hpp"
#include "phases.hpp"
#include "physics/air_entry.hpp"
#include "physics/ray.hpp"
#include "settings_used.hpp"
#include "sky_view.hpp"
#include <functional>
#include <optional>

namespace showmysky {

/// What the tables depend on.
struct AerialScene {
    double altitude = 0, muSun = 0;
    LayersUsed layers;
    std::vector<Texel> weights; ///< X, Y, Z, scotopic of unit radiance per unit solar irradiance, [wavelength]
    /// SkyView::whole at the nodes of these tables (Aerial::halfViews, `columns`): what light before the ground is a share of.
    ViewTable whole;
    bool glow = false; ///< some of `whole` isn't the Sun's light
    /// Of `whole` what air scatters of higher orders, without the ground: needed where there are no moments that tell it.
    ViewTable multiple{};
    struct Eclipse {
        double sunAzimuth = 0; ///< in the frame, from x to y
        /// What is left of the Sun's luminance at a node of a line of sight: EclipseSky::sunAt.
        std::function<SunSeen(const std::array<double, 3>& direction, const sky::physics::RayNodes::Node& node)> sun;
        /// That of the light of higher orders from the nodes of lines of sight: EclipseSky::nodeRatios.
        std::function<std::vector<float>(const std::vector<sky::physics::RayNodes>& lines, const std::vector<double>& sines,
                                         const std::vector<double>& relative)>
            higherOrders;
    };
    std::optional<Eclipse> eclipse{};
};

class Aerial
{
public:
    static constexpr int halfViews = 16, azimuths = 9, distances = 32;

    /// \param moments may be null: then light of higher orders grows as its air scatters and what an eclipse leaves there
    Aerial(const Atmosphere& atmosphere, const Phases& phases, const sky::physics::Moments* moments, const sky::physics::SunTable& sun);

    void set(AerialScene scene);
    /// Follows some more lines; true once all are done.
    bool step(int lines);

    /// `azimuths` of the half turn from the Sun's; in an eclipse of the whole turn, from -pi to pi.
    static int columns(bool eclipse) { return eclipse ? 2 * azimuths - 1 : azimuths; }
    int columns() const { return columns(scene_.eclipse.has_value()); }
    /// [table][distance][view][column]. Tables: shares of SkyView::whole and of each scatterer, 0..1; last the optical depth of
    /// light with the Sun's spectrum.
    const std::vector<Texel>& texels() const { return texels_; }
    static int tables(int scatterers) { return scatterers + 2; }

private:
    /// A line of sight: intervals between its distances, seen from the camera, each a node with the scattering seen there.
    struct Line {
        sky::physics::RayNodes single, multiple;
        std::vector<Texel> columnShares; ///< [distance]: of what all its air scatters towards the camera
    };
    sky::physics::RayNodes nodes(const sky::physics::SeenColumns& seen, const sky::physics::AirEntry& entry, bool ground, int parts) const;
    Line trace(int view, sky::physics::RayTracer& tracer);
    /// \param shares  of light of higher orders left in an eclipse, [interval][column][wavelength]; null without one
    void growLight(int view, const Line& line, const float* shares);
    double relativeAzimuth(int column) const;
    Texel luminance(const std::vector<double>& radiance) const;
    Texel& at(int table, int distance, int view, int column);

    const Atmosphere& atmosphere_;
    const Phases& phases_;
    const sky::physics::Moments* moments_;
    const sky::physics::SunTable& sun_;
    AerialScene scene_;
    std::vector<double> sines_;
    std::vector<Texel> texels_;
    int done_ = 0;
};

} // namespace showmysky
