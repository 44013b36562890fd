#include "physics/straighten.hpp"
#include "base/not_negative.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace sky::physics {

std::vector<double> evenly(const std::size_t points)
{
    std::vector<double> result(points);
    std::iota(result.begin(), result.end(), 0.);
    return result;
}

void straighten(const std::vector<double>& positions, double* const values, const std::size_t stride, const int count)
{
    const int points = static_cast<int>(positions.size());
    std::vector<double> curvature(points), shift(points);
    for (int w = 0; w < count; ++w) {
        const auto at = [&](int i) -> double& { return values[i * stride + w]; };
        for (int i = 1; i + 1 < points; ++i) {
            const double before = positions[i] - positions[i - 1], after = positions[i + 1] - positions[i];
            if (before > 0 && after > 0) // two altitudes can round to one measure
                curvature[i] = 2 * ((at(i + 1) - at(i)) / after - (at(i) - at(i - 1)) / before) / (before + after);
        }
        for (int i = 1; i + 1 < points; ++i) {
            double least = curvature[i];
            for (const int j : {std::max(i - 1, 1), std::min(i + 1, points - 2)})
                least = curvature[j] * least <= 0 ? 0 : std::abs(curvature[j]) < std::abs(least) ? curvature[j] : least;
            if (least == 0) {
                shift[i] = 0;
                continue;
            }
            // The harmonic mean of both squared steps makes it exact where steps are even or grow by a factor.
            const double before = std::pow(positions[i] - positions[i - 1], 2), after = std::pow(positions[i + 1] - positions[i], 2);
            shift[i] = least / 6 * before * after / (before + after);
        }
        for (int i = 1; i + 1 < points; ++i)
            at(i) = base::notNegative(at(i) - shift[i]);
    }
}

void drawLines(const std::vector<std::size_t>& known, const std::vector<double>& positions, double* const values, const std::size_t stride,
               const int count)
{
    for (std::size_t k = 0; k + 1 < known.size(); ++k) {
        const std::size_t a = known[k], b = known[k + 1];
        const double length = positions[b] - positions[a];
        for (std::size_t i = a + 1; i < b; ++i) {
            const double x = length > 0 ? (positions[i] - positions[a]) / length : 0.5;
            for (int w = 0; w < count; ++w)
                values[i * stride + w] = (1 - x) * values[a * stride + w] + x * values[b * stride + w];
        }
    }
}

} // namespace sky::physics
