#pragma once
// Pictures on disk.

#include "showmysky/sky.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace showmysky::app {

/// Luminance as drawn: bottom row first.
struct Picture {
    int width = 0, height = 0;
    std::vector<Luminance> pixels;
};

/// What a screen shows: red, green, blue from 0 to 255, bottom row first.
struct Levels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Exposure that brings the mean of the logarithms of luminance to a middle tone, without burning the brightest parts
/// out.
double automaticExposure(const Picture& picture);

/// throws sky::FileError
void writePng(const std::string& path, const Levels& levels);

/// 32-bit floats: linear R, G, B (Rec. 709 primaries), and X, Y, Z, scotopic, all in cd m^-2.   throws sky::FileError
void writeExr(const std::string& path, const Picture& picture);

} // namespace showmysky::app
