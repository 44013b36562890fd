#include "physics/series.hpp"
#include <cmath>

namespace sky::physics {

std::vector<double> seriesFactors(const std::vector<double>& products, const int n)
{
    const int unknowns = n - 1;
    const auto product = [&](int i, int j) { return products[i * n + j]; };
    // Normal equations of |v_1 + sum a_k (v_{k+1} - v_k)|, by Cholesky's method; a difference that the earlier ones contain is left out.
    std::vector<double> lower(unknowns * unknowns), right(unknowns), a(unknowns);
    for (int i = 0; i < unknowns; ++i) {
        right[i] = product(0, i) - product(0, i + 1);
        for (int j = 0; j <= i; ++j)
            lower[i * unknowns + j] = product(i + 1, j + 1) - product(i + 1, j) - product(i, j + 1) + product(i, j);
    }
    for (int i = 0; i < unknowns; ++i) {
        const double whole = lower[i * unknowns + i];
        for (int j = 0; j <= i; ++j) {
            double sum = lower[i * unknowns + j];
            for (int k = 0; k < j; ++k)
                sum -= lower[i * unknowns + k] * lower[j * unknowns + k];
            const double pivot = lower[j * unknowns + j];
            lower[i * unknowns + j] = i == j ? (sum > 1e-11 * whole ? std::sqrt(sum) : 0.) : pivot > 0 ? sum / pivot : 0.;
        }
    }
    for (int i = 0; i < unknowns; ++i) {
        for (int k = 0; k < i; ++k)
            right[i] -= lower[i * unknowns + k] * right[k];
        const double pivot = lower[i * unknowns + i];
        right[i] = pivot > 0 ? right[i] / pivot : 0.;
    }
    for (int i = unknowns - 1; i >= 0; --i) {
        a[i] = right[i];
        for (int k = i + 1; k < unknowns; ++k)
            a[i] -= lower[k * unknowns + i] * a[k];
        const double pivot = lower[i * unknowns + i];
        a[i] = pivot > 0 ? a[i] / pivot : 0.;
    }
    std::vector<double> factors(n, 1.);
    for (int k = 0; k < unknowns; ++k)
        factors[k + 1] = a[k];
    return factors;
}

} // namespace sky::physics
