#pragma once
// The fold of docs/method 5: one node of a ray under one Sun, harmonics summed over l.

#include "physics/harmonics.hpp"
#include "physics/stencil.hpp"
#include <algorithm>

namespace sky::physics {

/// g_m = sum_l c_lm sum_i w_i I_lm,i, for 0 <= m <= azimuthal, and the level that they are relative to. Inlined, so that it becomes vector code of
/// whatever its caller is compiled for.
///   levels        the field at the four altitudes of a stencil, [lm][stride] each; of lm = 0 log2 of the mean
///   weights       of the four
///   between       place between the two in the middle, 0..1: what is above `bentDegree` is straight there
///   coefficients  [lm][stride], of the node
///   azimuthal     0..degree
///   out           [1 + term][stride]: interpolated level, then g_m; c_00 is in g_0
[[gnu::always_inline]] inline void foldNode(const float* const levels[4], const float weights[4], float between,
                                            const float* __restrict coefficients, int degree, int bentDegree, int azimuthal, int stride,
                                            float* __restrict out)
{
    const float* __restrict a = levels[0], * __restrict b = levels[1], * __restrict c = levels[2], * __restrict d = levels[3];
    constexpr float eFolding = 1.44269504F;
    const LogarithmBetween<float> logarithm(weights, between, levels[0] == levels[1], eFolding);
    for (int w = 0; w < stride; ++w) {
        out[w] = logarithm(a[w], b[w], c[w], d[w]);
        out[stride + w] = coefficients[w];
    }
    for (int i = 2 * stride; i < (azimuthal + 2) * stride; ++i)
        out[i] = 0;
    for (int l = 1; l <= bentDegree; ++l)
        for (int m = 0; m <= std::min(l, azimuthal); ++m) {
            const int at = harmonicIndex(l, m) * stride;
            float* __restrict term = out + (m + 1) * stride;
            for (int w = 0; w < stride; ++w)
                term[w] += coefficients[at + w] *
                           (weights[0] * a[at + w] + weights[1] * b[at + w] + weights[2] * c[at + w] + weights[3] * d[at + w]);
        }
    for (int l = bentDegree + 1; l <= degree; ++l)
        for (int m = 0; m <= std::min(l, azimuthal); ++m) {
            const int at = harmonicIndex(l, m) * stride;
            float* __restrict term = out + (m + 1) * stride;
            for (int w = 0; w < stride; ++w)
                term[w] += coefficients[at + w] * (b[at + w] + between * (c[at + w] - b[at + w]));
        }
}

} // namespace sky::physics
