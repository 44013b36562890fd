#pragma once
#include <numbers>

namespace sky::base {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180; ///< rad

} // namespace sky::base
