#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace sky::physics {

/// Four neighbours and their weights on one axis of a table: what an interpolation is, once the place is known.
struct Stencil {
    std::array<int, 4> index;
    std::array<double, 4> weight;
};

/// Catmull-Rom at `position` 0 .. n-1 of a uniform axis with n >= 2 nodes; beyond the ends the curve goes on straight.
inline Stencil uniformStencil(double position, int n)
{
    const int k = std::clamp(static_cast<int>(position), 0, n - 2);
    const double t = std::clamp(position - k, 0., 1.);
    Stencil s{{std::max(k - 1, 0), k, k + 1, std::min(k + 2, n - 1)},
              {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)}};
    if (k == 0) {
        s.weight[1] += 2 * s.weight[0];
        s.weight[2] -= s.weight[0];
        s.weight[0] = 0;
    }
    if (k + 2 >= n) {
        s.weight[2] += 2 * s.weight[3];
        s.weight[1] -= s.weight[3];
        s.weight[3] = 0;
    }
    return s;
}

/// Catmull-Rom on an axis whose values are mirrored at both ends, as azimuths 0 .. pi are.
inline Stencil mirroredStencil(double position, int n)
{
    const int k = std::clamp(static_cast<int>(position), 0, n - 2);
    const double t = std::clamp(position - k, 0., 1.);
    return {{k == 0 ? 1 : k - 1, k, k + 1, k + 2 >= n ? n - 2 : k + 2},
            {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)}};
}

/// Interpolates positive quantities that span decades: the stencil applied to logarithms. Where a neighbour is zero, or nothing
/// is known of its logarithm, linearly between the middle two.
///   values  the four neighbours, >= 0
inline double interpolateLog(const Stencil& s, const std::array<double, 4>& values)
{
    bool positive = true;
    for (int i = 0; i < 4; ++i)
        positive = positive && (s.weight[i] == 0 || values[i] > 0);
    if (positive) {
        double sum = 0;
        for (int i = 0; i < 4; ++i)
            if (s.weight[i] != 0)
                sum += s.weight[i] * std::log(values[i]);
        return std::exp(sum);
    }
    // On a uniform axis the stencil's first moment is the place between the middle nodes.
    double t = 0;
    for (int i = 0; i < 4; ++i)
        t += s.weight[i] * (i - 1);
    t = std::clamp(t, 0., 1.);
    return (1 - t) * values[1] + t * values[2];
}

} // namespace sky::physics
