#include "solver/field.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include <cmath>

namespace sky::solver {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double toLog2 = 1.44269504088896340736;

// The inner loop in the widest vectors that the machine has; elsewhere the compiler's default.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SKY_WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2,fma", "default")))
#else
#define SKY_WIDEST_VECTORS
#endif

/// One node: `levels` are the field at the four altitudes of its stencil, [sun][lm][stride] each.
SKY_WIDEST_VECTORS
void foldNode(const float* const levels[4], const float weights[4], const float* __restrict coefficients, int suns, int degree,
              int stride, float* __restrict target)
{
    const int harmonics = (degree + 1) * (degree + 2) / 2, rows = degree + 2;
    for (int sun = 0; sun < suns; ++sun) {
        const float* __restrict a = levels[0] + sun * harmonics * stride;
        const float* __restrict b = levels[1] + sun * harmonics * stride;
        const float* __restrict c = levels[2] + sun * harmonics * stride;
        const float* __restrict d = levels[3] + sun * harmonics * stride;
        float* __restrict out = target + sun * rows * stride;
        for (int w = 0; w < stride; ++w) {
            out[w] = weights[0] * a[w] + weights[1] * b[w] + weights[2] * c[w] + weights[3] * d[w];
            out[stride + w] = coefficients[w];
        }
        for (int i = 2 * stride; i < rows * stride; ++i)
            out[i] = 0;
        for (int l = 1, lm = 1; l <= degree; ++l)
            for (int m = 0; m <= l; ++m, ++lm) {
                const int at = lm * stride;
                float* __restrict term = out + (m + 1) * stride;
                for (int w = 0; w < stride; ++w)
                    term[w] += coefficients[at + w] *
                               (weights[0] * a[at + w] + weights[1] * b[at + w] + weights[2] * c[at + w] + weights[3] * d[at + w]);
            }
    }
}

} // namespace

FineField::FineField(const physics::Moments& m, const int refinement)
{
    const auto& grid = m.grid;
    suns = (grid.sunCount() - 1) * refinement + 1;
    harmonics = physics::harmonicCount(m.degree);
    stride = (m.wavelengths + 3) / 4 * 4;
    const double scale = std::sinh(physics::MomentGrid::sinhScale);
    vLowest = std::asinh(grid.lowestElevation() / (pi / 2) * scale) / physics::MomentGrid::sinhScale;
    moments.assign(std::size_t(grid.altitudeCount()) * suns * harmonics * stride, 0.F);
    ground.assign(std::size_t(suns) * stride, 0.F);
    base::parallel([&](int thread, int threads) {
        for (int a = thread; a < grid.altitudeCount(); a += threads)
            for (int f = 0; f < suns; ++f) {
                const auto stencil = grid.sunStencil(double(f) / refinement);
                float* to = &moments[(std::size_t(a) * suns + f) * harmonics * stride];
                for (int lm = 0; lm < harmonics; ++lm)
                    for (int w = 0; w < m.wavelengths; ++w) {
                        double value = 0;
                        for (int j = 0; j < 4; ++j)
                            value += stencil.weight[j] * m.at(a, stencil.index[j])[lm * m.wavelengths + w];
                        to[lm * stride + w] = static_cast<float>(lm == 0 ? value * toLog2 : value);
                    }
            }
    });
    for (int f = 0; f < suns; ++f) {
        const auto stencil = grid.sunStencil(double(f) / refinement);
        for (int w = 0; w < m.wavelengths; ++w) {
            double value = 0;
            for (int j = 0; j < 4; ++j)
                value += stencil.weight[j] *
                         std::log2(std::max(m.groundIrradiance[stencil.index[j] * m.wavelengths + w], physics::darkness));
            ground[std::size_t(f) * stride + w] = static_cast<float>(value);
        }
    }
}

void fold(const FineField& field, const ScatteredRays& rays, const int first, const int count, float* const source)
{
    const int degree = rays.degree, stride = field.stride, rows = degree + 2;
    const std::size_t perNode = std::size_t(field.suns) * rows * stride;
    base::parallel([&](int thread, int threads) {
        std::vector<float> coefficients(field.harmonics * stride);
        for (int r = thread; r < count; r += threads) {
            float* to = source + std::size_t(r) * (rays.nodes + 1) * perNode;
            for (int k = 0; k < rays.nodes; ++k, to += perNode) {
                const auto& node = rays.folds[std::size_t(first + r) * rays.nodes + k];
                const float* c = &rays.coefficients[(std::size_t(first + r) * rays.nodes + k) * (degree + 1) * stride];
                const float* p = &rays.factors[(std::size_t(first + r) * rays.nodes + k) * field.harmonics];
                for (int l = 0, lm = 0; l <= degree; ++l)
                    for (int m = 0; m <= l; ++m, ++lm)
                        for (int w = 0; w < stride; ++w)
                            coefficients[lm * stride + w] = c[l * stride + w] * p[lm];
                const float* levels[4];
                for (int i = 0; i < 4; ++i)
                    levels[i] = &field.moments[std::size_t(node.level[i]) * field.suns * field.harmonics * stride];
                foldNode(levels, node.weight, coefficients.data(), field.suns, degree, stride, to);
            }
            const float* ground = &rays.ground[std::size_t(first + r) * stride];
            for (int sun = 0; sun < field.suns; ++sun)
                for (int w = 0; w < stride; ++w) {
                    float* out = to + sun * rows * stride;
                    out[w] = field.ground[sun * stride + w];
                    out[stride + w] = ground[w];
                    for (int m = 1; m <= degree; ++m)
                        out[(m + 1) * stride + w] = 0;
                }
        }
    });
}

} // namespace sky::solver
