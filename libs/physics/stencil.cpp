#include "physics/stencil.hpp"

namespace sky::physics {

namespace {

/// The logarithm beyond `near`, on the other side of which `far` and perhaps `farther` follow: falling at least as a straight line.
double foretold(double near, double far, const double* farther)
{
    const double straight = 2 * near - far;
    return farther ? std::min(straight, 3 * near - 3 * far + *farther) : straight;
}

/// At a share `x` of the way from a dark node to a lit one, behind which `next` stands.
double intoDarkness(double x, double lit, double next)
{
    const double fall = next > 0 ? std::max(0., std::log(next / lit)) : 0;
    return x * lit * std::exp(-(1 - x) * fall);
}

} // namespace

double interpolateLog(const Stencil& s, const std::array<double, 4>& values)
{
    double straight = 0;
    for (int i = 0; i < 4; ++i)
        straight += s.weight[i] * values[i];
    if (!std::isfinite(straight)) // below, what is not positive is dark
        return straight;
    const auto counts = [&](int i) { return s.weight[i] != 0 && values[i] > 0; };
    const double t = s.between;
    if (!(values[1] > 0) || !(values[2] > 0))
        return values[2] > 0 ? intoDarkness(t, values[2], values[3]) : values[1] > 0 ? intoDarkness(1 - t, values[1], values[0]) : 0;
    const double l1 = std::log(values[1]), l2 = std::log(values[2]);
    double l0 = counts(0) ? std::log(values[0]) : 0, l3 = counts(3) ? std::log(values[3]) : 0;
    if (!counts(0))
        l0 = foretold(l1, l2, counts(3) ? &l3 : nullptr);
    if (!counts(3))
        l3 = foretold(l2, l1, counts(0) ? &l0 : nullptr);
    return std::exp(LogarithmBetween<double>(s.weight.data(), t, false, 1)(l0, l1, l2, l3));
}

} // namespace sky::physics
