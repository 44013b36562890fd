#pragma once
// The light of one pixel: its spectrum, and what eyes make of it.

#include "showmysky/sky.hpp"
#include <array>
#include <optional>
#include <vector>

namespace showmysky::app::preview {

struct Reading {
    double azimuth = 0, elevation = 0;         ///< degrees
    Luminance luminance;                       ///< as drawn
    std::optional<std::array<double, 2>> xy;   ///< CIE 1931 chromaticity; nothing for black
    std::optional<double> colourTemperature;   ///< correlated, K; nothing where it has no meaning
    std::vector<double> wavelengths, radiance; ///< nm; W m^-2 sr^-1 nm^-1, without the Sun's disc
    std::string problem;                       ///< why there is no spectrum; empty if there is one
};

/// Of a pixel of the last picture; nothing outside of what was drawn.
///   share  0..1 of width and height, from the lower left corner
std::optional<Reading> readLight(Sky& sky, const std::array<double, 2>& share);

} // namespace showmysky::app::preview
