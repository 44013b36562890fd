#pragma once
// Pictures on disk.

#include "showmysky/sky.hpp"
#include <string>
#include <vector>

namespace showmysky::app {

/// Luminance as drawn: bottom row first.
struct Picture {
    int width = 0, height = 0;
    std::vector<Luminance> pixels;
};

/// How luminance becomes colour.
enum class ToneCurve {
    exponential, ///< 1 - exp(-x) by channel: bright light turns white as on film
    reinhard,    ///< x / (1 + x) of the luminance, hue kept
    linear       ///< cut off at white
};

struct Development {
    ToneCurve curve = ToneCurve::exponential;
    bool automatic = true; ///< exposure from the picture itself
    double exposure = -4;  ///< log10 of the factor from cd m^-2 to the curve's argument
};

/// Exposure that brings the mean of the logarithms of luminance to a middle tone, without burning the brightest parts
/// out.
double automaticExposure(const Picture& picture);

/// 8-bit sRGB with ordered dither; colours outside sRGB lose saturation, not hue.   throws sky::FileError
void writePng(const std::string& path, const Picture& picture, const Development& development);

/// 32-bit floats: linear R, G, B (Rec. 709 primaries), and X, Y, Z, scotopic, all in cd m^-2.   throws sky::FileError
void writeExr(const std::string& path, const Picture& picture);

} // namespace showmysky::app
