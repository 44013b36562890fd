#pragma once
// Real spherical harmonics with cos(m phi) terms only: the field is symmetric about the Sun's vertical plane.

#include "base/angles.hpp"
#include "physics/medium.hpp"
#include <cmath>
#include <vector>

namespace sky::physics {

/// Number of (l, m) pairs, 0 <= m <= l <= degree.
constexpr int harmonicCount(int degree) { return (degree + 1) * (degree + 2) / 2; }
/// Position of (l, m): l (l + 1) / 2 + m.
constexpr int harmonicIndex(int l, int m) { return l * (l + 1) / 2 + m; }

/// Zenith-angle factors of the orthonormal real harmonics: Y_lm = factor_lm(mu) cos(m phi), with
/// the integral of Y_lm^2 over the sphere 1. Includes sqrt(2) for m > 0; no Condon-Shortley sign.
///   mu       [count], cosines of zenith angles, -1..1
///   factors  [harmonicCount(degree)][count]
///   source   recurrences of the normalised associated Legendre functions (Press et al. 6.7)
template<class Real>
void harmonicFactors(const int degree, const Real* const mu, const int count, Real* const factors)
{
    const auto at = [&](int l, int m) { return factors + static_cast<std::size_t>(harmonicIndex(l, m)) * static_cast<std::size_t>(count); };
    for (int m = 0; m <= degree; ++m) {
        Real* const diagonal = at(m, m);
        if (m == 0) {
            for (int k = 0; k < count; ++k)
                diagonal[k] = static_cast<Real>(std::sqrt(1 / (4 * base::pi)));
        } else {
            const auto step = static_cast<Real>(std::sqrt((m == 1 ? 2 : 1) * (2 * m + 1) / (2. * m)));
            const Real* const last = at(m - 1, m - 1);
            for (int k = 0; k < count; ++k) {
                const Real square = 1 - mu[k] * mu[k];
                diagonal[k] = step * std::sqrt(square > 0 ? square : 0) * last[k];
            }
        }
        for (int l = m + 1; l <= degree; ++l) {
            const auto a = static_cast<Real>(std::sqrt((4. * l * l - 1) / (double(l) * l - double(m) * m)));
            const auto b = static_cast<Real>(std::sqrt(((l - 1.) * (l - 1.) - double(m) * m) / (4. * (l - 1.) * (l - 1.) - 1)));
            const Real *const current = at(l - 1, m), *const previous = l - 1 > m ? at(l - 2, m) : current;
            Real* const next = at(l, m);
            const Real part = l - 1 > m ? b : 0;
            for (int k = 0; k < count; ++k)
                next[k] = a * (mu[k] * current[k] - part * previous[k]);
        }
    }
}

/// At one place, [harmonicCount(degree)].
void harmonicFactors(int degree, double mu, double* factors);

/// Legendre polynomials P_0..P_degree at x.
void legendre(int degree, double x, double* values);

/// lambda_l = 2 pi integral p(c) P_l(c) dc of a tabulated phase function, for l = 0..degree and one wavelength.
/// lambda_0 is the integral of the phase function over the sphere.
std::vector<double> phaseMoments(const Medium& medium, const Species& species, int wavelength, int degree);

/// Phase function interpolated at scattering angle `theta` (rad), one wavelength or all; see Medium for the rule.
double phaseFunctionAt(const Medium& medium, const Species& species, double theta, int wavelength);
void phaseFunctionAt(const Medium& medium, const Species& species, double theta, double* values);

} // namespace sky::physics
