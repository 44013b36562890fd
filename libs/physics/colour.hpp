#pragma once
// From spectra to what eyes and screens see: CIE 1931 XYZ, scotopic luminance, chromaticity, sRGB.

#include <array>
#include <optional>
#include <vector>

namespace sky::physics {

constexpr double photopicEfficacy = 683.002; ///< K_m, lm/W (BIPM 2019/05)
constexpr double scotopicEfficacy = 1700.13; ///< K'_m, lm/W (BIPM 2019/05)

using XYZ = std::array<double, 3>; ///< CIE 1931, 2 degrees; Y in cd m^-2

/// CIE 1931 colour matching functions x, y, z and the scotopic luminosity function V' at a wavelength, dimensionless.
/// Linear between the points of the 5 nm table; zero outside 360..830 nm.
std::array<double, 4> matchingFunctions(double wavelengthNm);

/// Weights that turn spectral radiance at the wavelengths of a grid into X, Y, Z and scotopic luminance:
/// the sum of weight times radiance.
///   wavelengthsNm  strictly increasing, at least one
///   returns        [wavelengths]{X, Y, Z, scotopic}, cd m^-2 per W m^-2 sr^-1 nm^-1, all >= 0
///   method         the radiance is taken as linear between the wavelengths and as zero outside of them, and is
///                  integrated exactly against the matching functions. A single wavelength is taken as 1 nm of light.
std::vector<std::array<double, 4>> luminanceWeights(const std::vector<double>& wavelengthsNm);

/// Chromaticity coordinates {x, y}; nothing for black.
std::optional<std::array<double, 2>> chromaticity(const XYZ& colour);

/// Correlated colour temperature, K: of the black body whose colour is nearest in the CIE 1960 (u, v) diagram.
///   returns  1000..1e6 K; nothing for black, beyond that range, or farther than 0.05 from the locus (CIE 15), where
///            the notion has no meaning
///   error    < 0.1 % for black bodies up to 20 000 K: tests/physics/colour.cpp
std::optional<double> correlatedColourTemperature(const XYZ& colour);

/// Linear sRGB (IEC 61966-2-1 primaries, white D65); out-of-gamut colours have negative components.
std::array<double, 3> linearSrgb(const XYZ& colour);

/// sRGB's transfer function, linear 0..1 to encoded 0..1, odd about zero; and back.
double encodeSrgb(double linear);
double decodeSrgb(double encoded);

} // namespace sky::physics
