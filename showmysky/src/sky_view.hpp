#pragma once
// The whole sky of one altitude and one Sun as small tables, whatever source it came from: what the painter draws.

#include "physics/geometry.hpp"
#include <array>
#include <vector>

namespace showmysky {

using Texel = std::array<float, 4>; ///< X, Y, Z, scotopic; cd m^-2

/// One table over [view][azimuth]. Views are two halves split at the horizon, each counted from it: the first half up
/// to the zenith, the second down to the nadir. Within a half they stand as physics::horizonAngleNodes, azimuths as
/// azimuthNodes.
struct ViewTable {
    int halfViews = 0;
    int azimuths = 0;
    std::vector<Texel> texels;

    ViewTable() = default;
    ViewTable(int halfViews_, int azimuths_)
        : halfViews(halfViews_), azimuths(azimuths_), texels(static_cast<std::size_t>(2 * halfViews_ * azimuths_))
    {
    }
    bool empty() const { return texels.empty(); }
    Texel& at(int view, int azimuth) { return texels[static_cast<std::size_t>(view * azimuths + azimuth)]; }
    const Texel& at(int view, int azimuth) const { return texels[static_cast<std::size_t>(view * azimuths + azimuth)]; }
};

struct SkyView {
    ViewTable whole;                  ///< multiple scattering and the ground: as it is seen
    std::vector<ViewTable> scattered; ///< [scatterer]: to be multiplied by its phase function; empty if hidden
    bool eclipse = false;             ///< tables stand as SkyAxes has them in an eclipse and are drawn as they are
};

/// Size of the tables on the GPU: fine enough for linear interpolation.
constexpr int drawnHalfViews = 64, drawnAzimuths = 64;
/// In an eclipse, around the whole turn: at least.
constexpr int eclipseHalfViews = 64, eclipseAzimuths = 129;

/// A finer or coarser table by cubic interpolation: of logarithms where all four neighbours are positive, otherwise
/// linear.
ViewTable resampled(const ViewTable& table, int halfViews, int azimuths);

/// Bilinear, as the painter's textures are filtered.
///   view     0 at the horizon to 1 at the end of the half         azimuth  0 .. 1 over the columns
Texel sampled(const ViewTable& table, double view, int half, double azimuth);

/// Sum of two tables of the same size; an empty one counts as nothing.
ViewTable sum(const ViewTable& a, const ViewTable& b);

/// A table in the order of the model files ([view], increasing elevation, from nadir to zenith).
ViewTable fromIncreasingElevation(const std::vector<Texel>& texels, int views, int azimuths);

/// Sines of the elevations of a table's views at an altitude.
std::vector<double> viewSines(const sky::physics::Planet& planet, double altitude, int halfViews);

} // namespace showmysky
