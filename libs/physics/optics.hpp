#pragma once
#include "physics/medium.hpp"
#include <vector>

namespace sky::physics {

/// Parts that a truncated peak is divided into by its scattering angles.
constexpr int peakParts = 8;

/// Truncated peaks of up to this share of a species' scattering always go straight on (physics/peak_sunlight).
constexpr double straightPeak = 0.5;

/// What radiative transfer needs of each species at each wavelength, with sharp forward peaks truncated (delta-M scaling) and all sharp
/// ones blurred.
///
/// With f the truncated share of the phase function, extinction and scattering cross sections lose f sigma_sca and the
/// Legendre moments become (lambda_l - f) / (1 - f). source: Wiscombe 1977, J. Atmos. Sci. 34, 1408.
/// Of thin species only sharp peaks are truncated, where horizontal rays are not deep. Of phase functions that are sharp a share b, what a peak
/// has left of the last moments, is blurred to what the degree resolves: lambda_l - b (1 - k_l), with a filter k that falls from one to next to
/// nothing at the degree; for a peak backward (-1)^l |b| in place of b.
struct Optics {
    int degree = 0;
    int species = 0;
    int wavelengths = 0;
    std::vector<double> extinction; ///< [species][wavelengths], m^2, scaled
    std::vector<double> scattering; ///< [species][wavelengths], m^2, scaled
    std::vector<double> truncation; ///< [species][wavelengths], f, 0..1
    std::vector<double> blurred;    ///< [species][wavelengths], b, 0..1, or of a peak backward -1..0
    std::vector<double> moments;    ///< [species][0..degree][wavelengths], lambda_l, scaled and blurred
    std::vector<double> peakAngles; ///< [species][wavelengths][peakParts], rad: of equal shares of a peak above straightPeak, or 0
    std::vector<int> scatterers;    ///< indices of the species that scatter at some wavelength

    double moment(int s, int l, int w) const { return moments[(s * (degree + 1) + l) * wavelengths + w]; }
};

/// Particles of a species above a square metre of the ground, m^-2: trapezoids between the medium's altitudes.
double verticalColumn(const Medium& medium, const Species& species);

/// The same along the horizontal ray from the ground to space.
double horizontalColumn(const Medium& medium, const Species& species);

/// Vertical optical depths of scattering by a species, [wavelength].
std::vector<double> scatteringDepths(const Medium& medium, const Species& species);

/// Optics of `medium` for harmonics up to `degree`.
///   truncate  scale and blur where peaks are sharp; false: the series is only cut
Optics makeOptics(const Medium& medium, int degree, bool truncate);

/// Largest extinction cross section of each species over wavelengths, m^2.
std::vector<double> largestExtinctions(const Optics& optics);

/// Whether any peak is truncated.
bool truncates(const Optics& optics);

/// Whether any sharp peak forward is blurred.
bool blurs(const Optics& optics);

/// Up to this degree tables of the radiance field are interpolated by cubics, above it straight between two neighbours: what is above is a
/// small part of the light, but for sharp peaks, and its curvature a small part of that (docs/method 5 has what it costs and saves).
int bentDegree(const Optics& optics);

/// Azimuthal orders 0..m that light still shows at event `event` (2: scattered twice), at most the degree. Each event multiplies a
/// harmonic by its lambda_l, and so does the next one, which shows it: order m counts while (2m + 1) lambda^(event + 1) > `negligible` for
/// the largest lambda_l from l = m on; the first `least` always, for the planet's shadow also makes azimuths differ.
int azimuthalDegree(const Optics& optics, int event, double negligible, int least);

} // namespace sky::physics
