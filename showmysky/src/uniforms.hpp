#pragma once
// Values of uniforms that several programs share: the painter's, and those of hosts, who know them by longer names.

#include "sky_view.hpp"
#include <array>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace showmysky {

using UniformValue = std::variant<int, float, std::array<float, 2>, std::array<float, 3>, std::array<float, 4>, std::vector<Texel>>;
using Uniforms = std::map<std::string, UniformValue>; ///< by name

} // namespace showmysky
