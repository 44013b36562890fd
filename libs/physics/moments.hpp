#pragma once
#include "physics/geometry.hpp"
#include "physics/profile.hpp"
#include "physics/stencil.hpp"
#include <vector>

namespace sky::physics {

/// Grid of the radiance moments: altitude x elevation of the Sun.
///
/// The elevation axis is e = (pi/2) sinh(a v) / sinh(a), v uniform: fine in twilight, and the finer the less the horizon dips. It begins
/// below the Sun that lights any air.
class MomentGrid
{
public:
    MomentGrid() = default;
    /// Grid that follows the medium: `altitudeCount` levels and more, see fieldLevels.
    ///   largestExtinction  cross sections, [species], m^2
    ///   sunCount    on a planet with the Earth's sunset (sunsetShare() of 1); more where the Sun goes out over a smaller angle
    ///   sunRadius   of the disc, rad
    MomentGrid(const Profile& profile, const std::vector<double>& largestExtinction, int altitudeCount, int sunCount, double sunRadius = 0);
    /// Grid as it was stored.
    ///   sunScale    a, > 0
    MomentGrid(Planet planet, std::vector<double> altitudes, double lowestElevation, int sunCount, double sunScale = leastSunScale);

    const std::vector<double>& altitudes() const { return altitudes_; }
    int altitudeCount() const { return static_cast<int>(altitudes_.size()); }
    int sunCount() const { return sunCount_; }
    double lowestElevation() const { return lowest_; }
    /// How far below the horizon the Sun must stand for all air that is seen from the ground to be dark, rad: two horizon dips
    /// of the air's upper end, of the three that make the lowest elevation.
    double darkDepth() const { return -2.2 / 3.2 * lowest_; }
    /// Elevation of the Sun at position v in 0..sunCount-1, rad.
    double sunElevation(double position) const;
    /// Position 0..sunCount-1 of a Sun's elevation, clamped to the grid.
    double sunPosition(double elevation) const;
    /// a of the axis, 3.5 for most planets.
    double sunScale() const { return sunScale_; }
    /// v of the lowest Sun.
    double vLowest() const { return vLowest_; }
    static constexpr double leastSunScale = 3.5;

    /// Cubic Hermite with slopes of parabolas through three levels, in the measure sqrt(r^2 - R^2).
    Stencil altitudeStencil(double altitude) const;
    /// Catmull-Rom on the uniform axis v. The last of the four may be sunCount(): a Sun beyond the zenith, see
    /// Moments::withSunBeyondZenith.
    Stencil sunStencil(double position) const;
    /// The same curve taken as `chords` straight lines between two Suns: how the GPU's sweeps read it. 0: the curve itself.
    Stencil sunStencil(double position, int chords) const;
    /// The Sun of the grid that stands as high as one of a stencil.
    int sunAsHigh(int index) const { return index < sunCount_ ? index : sunCount_ - 2; }

private:
    Planet planet_;
    std::vector<double> altitudes_;
    std::vector<double> measure_;
    double lowest_ = 0;
    double sunScale_ = leastSunScale;
    double vLowest_ = 0;
    int sunCount_ = 0;
};

/// Moments I_lm(h, muSun) = integral of L Y_lm over the sphere, per unit solar irradiance (sr^-1 sr = 1), of the radiance
/// that has had at least one event; with the irradiance of the ground that goes with it.
///
/// Stored as ln I_00 and the ratios I_lm / I_00: these interpolate well through the six decades of twilight.
struct Moments {
    MomentGrid grid;
    int degree = 0;
    int wavelengths = 0;
    std::vector<double> values;           ///< [altitude][sun][lm][wavelength]; lm = 0: ln I_00, others: I_lm / I_00
    std::vector<double> groundIrradiance; ///< [sun][wavelength], diffuse, per unit solar irradiance
    int sunChords = 0;                    ///< for interpolation, see MomentGrid::sunStencil
    int bentDegree = -1;                  ///< for interpolation: what is above is straight between two levels; -1: nothing is

    const double* at(int altitude, int sun) const;
    double* at(int altitude, int sun);
    /// The values with one more Sun, [altitude][sun, the last beyond the zenith][lm][wavelength]: the last but one of the grid, seen from
    /// the other side. So orders m are even or odd in the Sun's way over the zenith, as cos m phi is in phi - pi/2, and no interpolation
    /// has a kink there.
    std::vector<double> withSunBeyondZenith() const;
    /// Moments at a place, [lm][wavelength], as I_lm.
    void interpolate(double altitude, double muSun, double* result) const;
    /// Diffuse irradiance of the ground, [wavelength].
    void interpolateGround(double muSun, double* result) const;
};

/// Smallest I_00 that is told from darkness.
constexpr double darkness = 1e-30;

} // namespace sky::physics
