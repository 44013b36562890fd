#pragma once
// Sunlight that truncated peaks have thrown aside.

#include "physics/ray.hpp"
#include "physics/sun.hpp"
#include <vector>

namespace sky::physics {

/// Truncation (delta-M scaling) takes light within a peak for light that went straight on. Where the Sun is low that is far off: what a peak
/// takes a degree aside leaves a shell along which it would have gone on for hundreds of kilometres, or goes down into it. So here the first of those
/// events counts, and only what follows goes straight on: sunlight at a point is what no peak has met, and what one has thrown into its directions,
///
///   T(e) + mean over the peak's angles of the integral of f sigma_sca n(s) T(s, e) exp(-tau(s)) ds  along the ray towards e + theta sin psi,
///
/// with the true transmittance T of sunlight, the scaled optical depth tau, scattering angles theta of equal shares of the peak and position angles psi.
/// Under a high Sun, where all those rays are as deep, it is exp(-scaled depth), as without this. Peaks of little of the light stay straight: what is
/// left of the series makes up for that (hazy, cloudy and dusty sunsets were the worse for this, docs/sharp-peaks.md).
class PeakSunlight
{
public:
    /// Elevation up to which the Sun is low, rad.
    static constexpr double highest = 0.3;

    /// Optics with the true extinction of peaks that throw light aside: what sunlight meets on its way.
    static Optics unscaled(Optics optics);
    /// Whether peaks throw aside a part of horizontal sunlight that counts.
    static bool matters(const Profile& profile, const Optics& optics);
    /// Which of a table's altitudes are followed, increasing: these depths are smoother than those of sunlight that goes straight on, and some of a large
    /// table tell the others.
    ///   altitudes  0 .. top
    static std::vector<std::size_t> followedAltitudes(const std::vector<double>& altitudes);

    /// Processor time of a row of the table, roughly.
    static double secondsOfRow(const Optics& optics, double shells);

    ///   unscaled  sunlight through the air's true extinction     sunRadius  angular, rad
    PeakSunlight(const Profile& profile, const Optics& optics, const SunTable& unscaled, double sunRadius);

    /// Follows the rays through a place; keeps them until the next.
    ///   levelGround  irradiance of it in units of horizontalSunCosine(), as in SunTable::groundRow()
    void place(double altitude, bool levelGround);
    /// Transmitted share of sunlight there, [wavelength], >= 0: slightly above 1 where light that comes flat is gathered. The table of sunlight holds
    /// no more than the disc that shows.
    ///   elevation  of the Sun's centre, rad
    void transmittance(double elevation, double* result);

private:
    /// Light that each ray through the place sends there, by the scaled scattering of those who throw; their peaks follow by their share.
    void scatterAlongRays(double elevation);
    /// Adds the mean of the rays over the peaks' angles.
    void addPeaks(double elevation, double* result);
    std::size_t perRay() const { return throwers_.size() * std::size_t(optics_.wavelengths); }
    double* lightOf(std::size_t ray) { return &scattered_[ray * perRay()]; }

    const Profile& profile_;
    const Optics& optics_;
    const SunTable& unscaled_;
    double sunRadius_;
    RayTracer tracer_;
    double widest_ = 0;                 ///< of the peaks' scattering angles, rad
    std::vector<std::size_t> throwers_; ///< among the scatterers, those whose peaks throw light aside
    std::vector<double> elevations_;    ///< of the rays through a place
    std::vector<RayNodes> rays_;
    double altitude_ = 0;
    bool levelGround_ = false;
    std::vector<double> lit_;       ///< [wavelength]
    std::vector<double> scattered_; ///< [ray][thrower][wavelength]
};

} // namespace sky::physics
