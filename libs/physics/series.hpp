#pragma once
#include <algorithm>

namespace sky::physics {

/// What all later events will add to a value, from the last two: events die out as a geometric series once only their slowest
/// mode is left.
inline double geometricTail(double last, double before)
{
    const double ratio = before > 0 ? std::clamp(last / before, 0., 0.999) : 0.;
    return ratio / (1 - ratio) * last;
}

} // namespace sky::physics
