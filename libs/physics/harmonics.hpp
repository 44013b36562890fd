#pragma once
// Real spherical harmonics with cos(m phi) terms only: the field is symmetric about the Sun's vertical plane.

#include "physics/medium.hpp"
#include <vector>

namespace sky::physics {

/// Number of (l, m) pairs, 0 <= m <= l <= degree.
constexpr int harmonicCount(int degree) { return (degree + 1) * (degree + 2) / 2; }
/// Position of (l, m): l (l + 1) / 2 + m.
constexpr int harmonicIndex(int l, int m) { return l * (l + 1) / 2 + m; }

/// Zenith-angle factors of the orthonormal real harmonics: Y_lm = factor_lm(mu) cos(m phi), with
/// the integral of Y_lm^2 over the sphere 1. Includes sqrt(2) for m > 0; no Condon-Shortley sign.
///   mu       cosine of the zenith angle, -1..1
///   returns  [harmonicCount(degree)]
///   source   recurrences of the normalised associated Legendre functions (Press et al. 6.7)
void harmonicFactors(int degree, double mu, double* factors);

/// Legendre polynomials P_0..P_degree at x.
void legendre(int degree, double x, double* values);

/// lambda_l = 2 pi integral p(c) P_l(c) dc of a tabulated phase function, for l = 0..degree and one wavelength.
/// lambda_0 is the integral of the phase function over the sphere.
std::vector<double> phaseMoments(const Medium& medium, const Species& species, int wavelength, int degree);

/// Phase function interpolated at scattering angle `theta` (rad), all wavelengths; see Medium for the rule.
void phaseFunctionAt(const Medium& medium, const Species& species, double theta, double* values);

} // namespace sky::physics
