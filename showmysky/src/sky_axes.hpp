#pragma once
// Where the rows and columns of a drawn table stand. The twin on the GPU is shaders/lib/sky_view.glsl.
//
// Rows count from the horizon, fine there. In an eclipse the sky varies fastest around the Sun, so half of the rows of
// its half and half of the columns gather there, and columns go all the way around, for a Moon that stands beside the
// Sun's vertical.

#include <array>

namespace showmysky {

struct SkyAxes {
    /// Width of the region around the Sun in which rows and columns gather, rad, and their share.
    static constexpr double focusWidth = 0.04, focusShare = 0.5;

    double horizon = 0;      ///< elevation, rad, <= 0
    bool eclipse = false;    ///< false: azimuths 0 .. pi from the Sun's, no gathering
    double sunElevation = 0; ///< rad; matters in an eclipse

    /// 0 at the horizon to 1 at the zenith (half 0) or nadir (half 1).
    double viewCoordinate(double elevation, int half) const;
    /// Its inverse.
    double elevationAt(double coordinate, int half) const;

    /// 0 .. 1. `relative`: from the Sun's azimuth, counted from x to y in the frame of settings.hpp, -pi .. pi.
    double azimuthCoordinate(double relative) const;
    double azimuthAt(double coordinate) const;

    /// What the mapping of views adds to that of an ordinary sky, as the shader wants it: share, angle of the Sun from
    /// the horizon, offset and scale of the row's position, all zero where the half has no Sun.
    struct Focus {
        double share = 0, sun = 0, offset = 0, scale = 0;
    };
    Focus focus(int half) const;
    /// Share, 1 / width and scale of the columns' gathering.
    std::array<double, 3> azimuthFocus() const;
    /// From the horizon to the end of a half, rad.
    double range(int half) const;
};

} // namespace showmysky
