#pragma once
// Aerial perspective: how the light of a line of sight grows with distance, and what its air lets through.
//
// Light is tabulated as shares of the light of the whole line, one for each of the sky's tables, so that a point at infinity has
// exactly the sky behind it. Computed from the moments and the medium along fewer lines than the sky's, only for hosts that ask.

#include "air_entry.hpp"
#include "atmosphere.hpp"
#include "phases.hpp"
#include "physics/ray.hpp"
#include "settings_used.hpp"
#include "sky_view.hpp"
#include <functional>

namespace showmysky {

/// What the tables depend on.
struct AerialScene {
    double altitude = 0, muSun = 0;
    LayersUsed layers;
    std::vector<Texel> weights; ///< X, Y, Z, scotopic of unit radiance per unit solar irradiance, [wavelength]
    ViewTable whole;            ///< SkyView::whole without any Moon: what light before the ground is a share of
    bool glow = false;          ///< some of `whole` isn't the Sun's light
    /// In an eclipse: the share of the Sun's light that is left at a point in the camera's frame, m; empty without one.
    std::function<float(const std::array<float, 3>&)> sunlight{};
    double sunAzimuth = 0; ///< in the frame, from x to y; matters in an eclipse
};

class Aerial
{
public:
    static constexpr int halfViews = 16, azimuths = 9, distances = 32;

    /// \param moments may be null: then light of higher orders grows as its air scatters
    Aerial(const Atmosphere& atmosphere, const Phases& phases, const sky::physics::Moments* moments, const sky::physics::SunTable& sun);

    void set(AerialScene scene);
    /// Follows some more lines; true once all are done.
    bool step(int lines);

    /// `azimuths` of the half turn from the Sun's; in an eclipse of the whole turn, from -pi to pi.
    int columns() const { return scene_.sunlight ? 2 * azimuths - 1 : azimuths; }
    /// [table][distance][view][column]. Tables: shares of SkyView::whole and of each scatterer, 0..1; last the optical depth of
    /// light with the Sun's spectrum.
    const std::vector<Texel>& texels() const { return texels_; }
    static int tables(int scatterers) { return scatterers + 2; }

private:
    /// What a line's nodes have to do with the Sun's place only.
    struct Line {
        std::vector<sky::physics::RayNodes::Node> nodes; ///< [interval], seen from the camera
        std::vector<double> columns;                     ///< [interval][scatterer][wavelength]: scattering seen
    };
    Line line(const sky::physics::SeenColumns& seen, const AirEntry& entry, bool ground, int parts) const;
    void trace(int view, sky::physics::RayTracer& tracer);
    void growLight(int view, double mu, const Line& single, const Line& multiple, const std::vector<Texel>& columnShares);
    Texel luminance(const std::vector<double>& radiance) const;
    Texel& at(int table, int distance, int view, int column);

    const Atmosphere& atmosphere_;
    const Phases& phases_;
    const sky::physics::Moments* moments_;
    const sky::physics::SunTable& sun_;
    AerialScene scene_;
    ViewTable whole_; ///< at the nodes of these tables
    std::vector<double> sines_;
    std::vector<Texel> texels_;
    int done_ = 0;
};

} // namespace showmysky
