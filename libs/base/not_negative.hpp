#pragma once

namespace sky::base {

/// A number that rounding may have made less than 0. What is not a number stays so, where std::max(0., x) makes darkness of it.
template<typename Real>
constexpr Real notNegative(Real x)
{
    return x <= 0 ? Real(0) : x;
}

} // namespace sky::base
