#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace sky::physics {

/// Four neighbours and their weights on one axis of a table: what an interpolation is, once the place is known.
struct Stencil {
    std::array<int, 4> index;
    std::array<double, 4> weight;
    double between; ///< place between the two in the middle, 0..1: what is straight goes by this alone
};

/// Catmull-Rom at `position` 0 .. n-1 of a uniform axis with n >= 2 nodes; beyond the ends the curve goes on straight.
inline Stencil uniformStencil(double position, int n)
{
    const int k = std::clamp(static_cast<int>(position), 0, n - 2);
    const double t = std::clamp(position - k, 0., 1.);
    Stencil s{{std::max(k - 1, 0), k, k + 1, std::min(k + 2, n - 1)},
              {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)},
              t};
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

/// Catmull-Rom on the uniform axis of the Sun's elevation, which ends at the zenith: what is beyond is the last node but one seen from
/// the other side, its relative azimuths phi those of pi - phi.
struct SunStencil {
    Stencil stencil;
    bool beyondZenith; ///< the last of the four is that node
};
inline SunStencil sunStencil(double position, int n)
{
    Stencil s = uniformStencil(position, n);
    if (s.index[1] != n - 2)
        return {s, false};
    const double t = s.between, outer = t * t * (-0.5 + 0.5 * t);
    s.index[3] = n - 2;
    s.weight[3] = outer;
    s.weight[2] -= 2 * outer;
    s.weight[1] += outer;
    return {s, true};
}

/// Catmull-Rom on an axis whose values are mirrored at both ends, as azimuths 0 .. pi are.
inline Stencil mirroredStencil(double position, int n)
{
    const int k = std::clamp(static_cast<int>(position), 0, n - 2);
    const double t = std::clamp(position - k, 0., 1.);
    return {{k == 0 ? 1 : k - 1, k, k + 1, k + 2 >= n ? n - 2 : k + 2},
            {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)},
            t};
}

/// The logarithm of light between the two levels in the middle of four, from those at the levels: the cubic of a stencil, but for an outer level
/// that lies decades deeper than the inner two differ. It would make the curve swing up on the other side, and a sweep would find light there
/// that nobody sent, more with each event. So it counts as one that lies two e-foldings deeper and three times their difference, did it stand
/// as far away as they from each other.
template<typename Weight>
class LogarithmBetween
{
public:
    /// \param weight     [4] of the stencil
    /// \param between    of the stencil
    /// \param lowest     whether there is no level below the two: then the last one tells both slopes
    /// \param eFolding   one, in the unit of the logarithms
    LogarithmBetween(const Weight* weight, Weight between, bool lowest, Weight eFolding)
        : before_(weight[0]), step_(weight[2] + weight[3]), after_(weight[3]), mostBefore_(between * (1 - between) * (1 - between)),
          mostAfter_(between * (1 - between) * (lowest ? 1 : between)), eFolding_(eFolding)
    {
    }

    /// \tparam T  a number, or a vector of them
    template<typename T>
    [[gnu::always_inline]] inline T operator()(T a, T b, T c, T d) const
    {
        const T step = c - b, room = eFolding_ + Weight(1.5) * (step < 0 ? -step : step);
        const T before = before_ * (a - b), after = after_ * (d - c), mostBefore = mostBefore_ * room, mostAfter = mostAfter_ * room;
        return b + step_ * step + (mostBefore < before ? mostBefore : before) + (mostAfter < after ? mostAfter : after);
    }

private:
    Weight before_, step_, after_, mostBefore_, mostAfter_, eFolding_;
};

/// Of natural logarithms, by a stencil of levels.
inline LogarithmBetween<double> logarithmBetween(const Stencil& levels)
{
    return {levels.weight.data(), levels.between, levels.index[0] == levels.index[1], 1};
}

/// Interpolates positive quantities that span decades, such as light along the axis of the Sun: the stencil of a uniform axis,
/// applied to logarithms. A zero is an edge of darkness somewhere in the cells beside it, and nothing is known of its logarithm: an
/// outer neighbour that is dark is replaced by what the parabola through the others foretells, or less; between a lit and a dark node
/// the light goes on falling as it did, times a straight line to zero.
///   values  the four neighbours, >= 0; what is not finite among them makes the result so
double interpolateLog(const Stencil& s, const std::array<double, 4>& values);

} // namespace sky::physics
