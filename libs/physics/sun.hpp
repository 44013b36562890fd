#pragma once
#include "base/stop.hpp"
#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include <vector>

namespace sky::physics {

/// Attenuation of direct sunlight: optical depth towards the visible part of the solar disc, by altitude and by the
/// elevation of the Sun's centre above the horizon *of that altitude*, horizon().
///
/// Sunlight at a point, on a plane facing the Sun, per unit irradiance outside the atmosphere:
///     visibleDiscFraction(elevation - horizon, radius) exp(-opticalDepth)
/// Kept apart because the first factor is sharp and known exactly, the second smooth and tabulated.
class SunTable
{
public:
    /// Axis in the elevation x above the lowest Sun that still shows: u = asinh(x / scale) / asinh(range / scale).
    ///   elevations  on a planet with the Earth's sunset (sunsetShare() of 1); where the Sun goes out over a smaller angle the scale
    ///               is smaller in proportion, and there are so many more elevations that steps elsewhere stay as long; more also where
    ///               shadows have edges (Profile::forShadows)
    ///   stop        asked for every Sun of every altitude; throws base::Stopped
    SunTable(const Profile& profile, const Optics& optics, double sunAngularRadius, int altitudes = usualAltitudes,
             int elevations = usualElevations, const base::StopRequest& stop = {});
    static constexpr int usualAltitudes = 56, usualElevations = 112;

    /// What a table takes, known before it is made.
    struct Cost {
        double bytes;     ///< of the table
        double peakBytes; ///< while it is made, the table included
        double seconds;   ///< of processor time, roughly
    };
    static Cost costOf(const Profile& profile, const Optics& optics, double sunAngularRadius, int altitudes = usualAltitudes,
                       int elevations = usualElevations);

    const std::vector<double>& altitudes() const { return altitudes_; }
    int elevationCount() const { return elevations_; }
    /// Up to this altitude no light passes through the air horizontally: to sunlight it is the ground. m; 0 where the air is not so opaque.
    double sunlessAltitude() const { return sunless_; }
    /// Elevation of the horizon over the ground, or over the sunless altitude, rad; 0 below the latter.
    double horizon(double altitude) const;
    /// Scale of the axis, rad.
    double elevationScale() const { return scale_; }
    /// [altitude, then groundRow()][elevation][wavelength]
    const std::vector<double>& opticalDepths() const { return depth_; }

    /// Transmitted share of sunlight, [wavelength], 0..1, disc averaged, horizon included.
    ///   rise  by how much the middle of its light stands higher than the disc's, as the sine of the elevation: what an eclipse does
    void transmittance(double altitude, double muSun, double* result, double rise = 0) const;
    /// Optical depth towards the visible part of the disc, [wavelength]; below the horizon that of the last limb to be seen.
    void opticalDepth(double altitude, double muSun, double* result, double rise = 0) const;
    /// Irradiance of the level ground by the direct Sun per unit irradiance outside, [wavelength].
    ///   error  < 3e-3 against 400 strips of the disc, through sunset: tests/physics/sun.cpp
    void groundIrradiance(double muSun, double* result, double rise = 0) const;

    /// Table row below an altitude, and the fraction of the way to the next: linear in sqrt(r^2 - R^2), with which the optical depth
    /// towards a Sun at a given height above the horizon varies evenly even at the ground.
    struct Row {
        int index;
        double fraction;
    };
    Row row(double altitude) const;
    /// The row of the ground's irradiance, at its fraction: means over the disc weigh with the sine of the elevation there. Times
    /// the part of the disc that shows and horizontalSunCosine() they give groundIrradiance().
    Row groundRow() const { return {static_cast<int>(altitudes_.size()) - 1, 1}; }
    /// Position on the elevation axis, 0..1, for a Sun at `elevation` over a horizon at `horizon` (rad).
    double axis(double elevation, double horizon) const;

private:
    /// Optical depth behind which nothing is followed: what is left could not be told from darkness in single precision.
    static constexpr double opaque = 200;

    /// How much higher than the lowest Sun that still shows node k of the elevation axis stands, rad.
    double aboveLowest(double horizon, std::size_t k) const;
    /// Makes the depths those of PeakSunlight where the Sun is low: peak_sunlight.cpp.
    void throwAside(const Profile& profile, const Optics& optics, int altitudes, int elevations, const base::StopRequest& stop);
    void opticalDepth(const Row& row, double horizon, double elevation, double* result) const;
    void transmittance(const Row& row, double horizon, double muSun, double rise, double* result) const;

    Planet planet_;
    double sunRadius_;
    double sunless_;
    double scale_;
    int elevations_;
    int wavelengths_;
    std::vector<double> altitudes_, measures_; // sqrt(r^2 - R^2) there
    std::vector<double> depth_;
};

/// Mean cosine of the part of an evenly bright disc that stands above a level plane: the centroid of a circular segment, to first order
/// in its radius. Twin: shaders/lib/sun.glsl.
double horizontalSunCosine(double muSun, double sunAngularRadius);

/// Irradiance of a horizontal surface by the direct Sun per unit irradiance outside, [wavelength]: a quadrature over the disc's part above the
/// plane. Near the horizon both the transmittance and the cosine grow from the lower limb to the upper, so the mean of their product is more
/// than the product of their means.
///   altitude   m, 0 .. top           elevation  of the Sun's centre, rad
///   error      < 2e-3 against 2000 strips of the disc, through sunset: tests/physics/sun.cpp
void sunOnSurface(const Profile& profile, const Optics& optics, double sunAngularRadius, double altitude, double elevation, double* result);

} // namespace sky::physics
