#pragma once
// How far apart two pictures look: CIE 1976 colour differences of what a screen shows.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace showmysky::testing {

/// sRGB levels, 0..255, top row first.
struct Shown {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

using Lab = std::array<double, 3>;

/// CIE L*a*b* of sRGB levels (IEC 61966-2-1), white D65.
inline Lab labOf(const std::uint8_t* rgb)
{
    std::array<double, 3> linear{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double v = rgb[i] / 255.;
        linear[i] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    const double x = (0.4124 * linear[0] + 0.3576 * linear[1] + 0.1805 * linear[2]) / 0.9505;
    const double y = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
    const double z = (0.0193 * linear[0] + 0.1192 * linear[1] + 0.9505 * linear[2]) / 1.089;
    const auto f = [](double t) { return t > 216. / 24389 ? std::cbrt(t) : (24389. / 27 * t + 16) / 116; };
    return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

/// Distances in L*a*b* of all pixels, sorted: about 2 can just be told side by side.   Both are of one size.
inline std::vector<double> colourDifferences(const Shown& a, const Shown& b)
{
    std::vector<double> result;
    for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3) {
        const Lab p = labOf(&a.rgb[i]), q = labOf(&b.rgb[i]);
        result.push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    }
    std::sort(result.begin(), result.end());
    return result;
}

} // namespace showmysky::testing
