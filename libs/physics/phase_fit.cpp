#include "physics/phase_fit.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

constexpr int firstFitted = 5; // degree: those below carry diffusion and the width of the peak
constexpr int anglesPerDegree = 8;
constexpr double darkest = 1e-3; // of isotropic scattering: relative errors of less say nothing

/// Solves A x = b for a symmetric positive definite A [n][n] by Cholesky's method; overwrites A, and b by x.
void solve(std::vector<double>& matrix, std::vector<double>& b)
{
    const std::size_t n = b.size();
    const auto at = [&](std::size_t i, std::size_t j) -> double& { return matrix[i * n + j]; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = at(i, j);
            for (std::size_t k = 0; k < j; ++k)
                sum -= at(i, k) * at(j, k);
            at(i, j) = i == j ? std::sqrt(sum) : sum / at(j, j);
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            b[i] -= at(i, k) * b[k];
        b[i] /= at(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k)
            b[i] -= at(k, i) * b[k];
        b[i] /= at(i, i);
    }
}

} // namespace

void fitBeyondPeak(std::vector<double>& moments, const std::function<double(double)>& phaseFunction, const bool backward)
{
    const int degree = static_cast<int>(moments.size()) - 1;
    if (degree < firstFitted)
        return;
    const auto unknowns = static_cast<std::size_t>(degree + 1 - firstFitted);
    std::vector<double> normal(unknowns * unknowns), change(unknowns), row(unknowns), polynomials(moments.size());
    const int angles = anglesPerDegree * (degree + 1);
    for (int i = 0; i < angles; ++i) {
        const double fromPeak = (i + 0.5) * base::pi / angles;
        if (fromPeak < base::pi / (degree + 1))
            continue;
        const double theta = backward ? base::pi - fromPeak : fromPeak;
        const double wanted = phaseFunction(theta), unit = 1 / std::max(wanted, darkest);
        legendre(degree, std::cos(theta), polynomials.data());
        double missing = wanted;
        for (int l = 0; l <= degree; ++l)
            missing -= (2 * l + 1) * moments[l] * polynomials[l];
        for (std::size_t k = 0; k < unknowns; ++k)
            row[k] = (2 * static_cast<double>(k + firstFitted) + 1) * polynomials[k + firstFitted] * unit;
        for (std::size_t k = 0; k < unknowns; ++k) {
            change[k] += row[k] * missing * unit;
            for (std::size_t j = 0; j <= k; ++j)
                normal[k * unknowns + j] += row[k] * row[j];
        }
    }
    double largest = 0;
    for (std::size_t k = 0; k < unknowns; ++k)
        largest = std::max(largest, normal[k * unknowns + k]);
    for (std::size_t k = 0; k < unknowns; ++k)
        normal[k * unknowns + k] += 1e-10 * largest; // what hardly shows beyond the peak stays as it is
    solve(normal, change);
    for (std::size_t k = 0; k < unknowns; ++k)
        moments[k + firstFitted] += change[k];
}

} // namespace sky::physics
