#include "solver/layered_light.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace sky::solver {

namespace {

using base::pi;

/// Harmonics that last in deep air: means, fluxes, and what of sharp peaks lasts longest.
constexpr int lasting = 2;

/// Corrections are told from what sweeps in single precision differ by, some 1e-7, and may amplify that by no more than the inverse. Light
/// that nothing absorbs lasts over (depth / pi)^2 / 0.3 events, 3e5 where it is 1000 deep: allowed less, most of it would never be added.
constexpr double rounding = 1e-6;

/// Largest quotient of the shape at four levels for which it is gentle.
constexpr double gentle = 3;

/// L and U of a matrix in its place, rows exchanged for the largest pivot.
void factoriseRows(std::vector<double>& matrix, std::vector<int>& pivots)
{
    const auto n = pivots.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t best = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(matrix[i * n + k]) > std::abs(matrix[best * n + k]))
                best = i;
        pivots[k] = static_cast<int>(best);
        if (best != k)
            std::swap_ranges(&matrix[k * n], &matrix[k * n] + n, &matrix[best * n]);
        if (matrix[k * n + k] == 0)
            continue;
        const double* const row = &matrix[k * n];
        for (std::size_t i = k + 1; i < n; ++i) {
            double* const other = &matrix[i * n];
            const double factor = other[k] /= row[k];
            if (factor != 0)
                for (std::size_t j = k + 1; j < n; ++j)
                    other[j] -= factor * row[j];
        }
    }
}

} // namespace

LayeredLight::LayeredLight(std::vector<double> shape, const int wavelengths, const int degree, const bool straight)
    : shape_(std::move(shape)), straight_(straight), levels_(static_cast<int>(shape_.size()) / wavelengths), wavelengths_(wavelengths),
      degree_(std::min(degree, lasting)), matrices_(wavelengths), pivots_(wavelengths)
{
    const std::size_t n = valueCount();
    for (auto& matrix : matrices_) {
        matrix.assign(n * n, 0.);
        for (std::size_t i = 0; i < n; ++i)
            matrix[i * n + i] = straight ? 1 : 1 + rounding;
    }
}

double LayeredLight::bytes(const int levels, const int wavelengths, const int degree)
{
    const double rows = valueCount(levels, std::min(degree, lasting));
    return wavelengths * rows * rows * sizeof(double);
}

/// Of the four levels of a stencil. Cubics, as the field is interpolated, where the shape is gentle; else straight between two, so that no
/// weight is negative and light can't become so.
std::array<double, 4> LayeredLight::weightsAt(const ScatteredRays::FoldNode& node, const int w) const
{
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const int level : node.level) {
        least = std::min(least, shape_[std::size_t(level) * wavelengths_ + w]);
        most = std::max(most, shape_[std::size_t(level) * wavelengths_ + w]);
    }
    if (!straight_ && most < gentle * least)
        return {double(node.weight[0]), double(node.weight[1]), double(node.weight[2]), double(node.weight[3])};
    return {0, 1 - double(node.between), double(node.between), 0};
}

void LayeredLight::add(const ScatteredRays& rays, const std::vector<physics::Directions>& directions, const int firstLevel, const int count)
{
    const int terms = degree_ + 1, fieldTerms = rays.degree + 1, harmonics = physics::harmonicCount(rays.degree);
    const int stride = (wavelengths_ + 3) / 4 * 4, ground = valueCount() - 1;
    const std::size_t n = valueCount();
    base::parallel([&](int thread, int threads) {
        std::vector<double> factors(harmonics), seen(n);
        for (int w = thread; w < wavelengths_; w += threads) {
            const auto shape = [&](int level) { return shape_[std::size_t(level) * wavelengths_ + w]; };
            std::size_t ray = 0;
            for (int a = firstLevel; a < firstLevel + count; ++a)
                for (std::size_t d = 0; d < directions[a].mu.size(); ++d, ++ray) {
                    // What of each value arrives along the ray, relative to the shape where it starts.
                    std::fill(seen.begin(), seen.end(), 0.);
                    for (int k = 0; k < rays.nodes; ++k) {
                        const std::size_t at = ray * rays.nodes + k;
                        const auto& node = rays.folds[at];
                        const auto weights = weightsAt(node, w);
                        double here = 0;
                        for (int i = 0; i < 4; ++i)
                            here += weights[i] * std::log(shape(node.level[i]));
                        here = std::exp(here) / shape(a);
                        for (int l = 0; l < terms; ++l) {
                            const double part = here * double(rays.coefficients[(at * fieldTerms + l) * stride + w]) *
                                                double(rays.factors[at * harmonics + physics::harmonicIndex(l, 0)]);
                            for (int i = 0; i < 4; ++i)
                                seen[node.level[i] * terms + l] += part * weights[i];
                        }
                    }
                    seen[ground] += double(rays.ground[ray * stride + w]) * shape(0) / shape(a);
                    physics::harmonicFactors(rays.degree, directions[a].mu[d], factors.data());
                    const auto subtract = [&](int row, double weight) {
                        double* const to = &matrices_[w][row * n];
                        for (std::size_t i = 0; i < n; ++i)
                            to[i] -= weight * seen[i];
                    };
                    const double weight = 2 * pi * directions[a].weight[d];
                    for (int l = 0; l < terms; ++l)
                        subtract(a * terms + l, weight * factors[physics::harmonicIndex(l, 0)]);
                    if (a == 0 && directions[a].mu[d] > 0)
                        subtract(ground, weight * directions[a].mu[d]);
                }
        }
    });
}

void LayeredLight::factorise()
{
    base::parallel([&](int thread, int threads) {
        for (int w = thread; w < wavelengths_; w += threads) {
            pivots_[w].resize(valueCount());
            factoriseRows(matrices_[w], pivots_[w]);
        }
    });
}

void LayeredLight::addFollowing(const int w, double* const values) const
{
    const int n = valueCount(), terms = degree_ + 1;
    const auto shape = [&](int i) { return shape_[std::size_t(i < n - 1 ? i / terms : 0) * wavelengths_ + w]; };
    const auto& matrix = matrices_[w];
    for (int i = 0; i < n; ++i)
        values[i] /= shape(i);
    for (int i = 0; i < n; ++i)
        std::swap(values[i], values[pivots_[w][i]]);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j)
            values[i] -= matrix[std::size_t(i) * n + j] * values[j];
    for (int i = n - 1; i >= 0; --i) {
        for (int j = i + 1; j < n; ++j)
            values[i] -= matrix[std::size_t(i) * n + j] * values[j];
        const double pivot = matrix[std::size_t(i) * n + i];
        values[i] = pivot != 0 ? values[i] / pivot : 0;
    }
    for (int i = 0; i < n; ++i)
        values[i] *= shape(i);
}

} // namespace sky::solver
