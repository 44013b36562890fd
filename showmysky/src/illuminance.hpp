#pragma once
// Illuminance at the camera, from what is drawn: the sky above the horizon and what shows of the Sun's disc.

#include "phases.hpp"
#include "physics/eclipse.hpp"
#include "sky_axes.hpp"
#include "sky_view.hpp"

namespace showmysky {

/// X, Y, Z, scotopic; lx.
struct Illuminance {
    Texel sunHorizontal{}; ///< of a horizontal surface
    Texel sunFacing{};     ///< of a surface that faces the Sun
    Texel skyHorizontal{}; ///< of a horizontal surface by all of the sky above it
};

/// Of a horizontal surface by the sky above it, in quadrature around the Sun: however sharp a phase function is, it is resolved.
Texel skyIlluminance(const SkyView& view, const SkyAxes& axes, const Phases& phases);

/// What of the Sun a Moon leaves, seen from the camera.
struct Crescent {
    sky::physics::Discs<double> discs;
    double up = 1;         ///< cosine of the angle between the way from the Moon to the Sun and upwards
    Texel limbExponents{}; ///< of the disc's darkening, as shaders/render/sun_disc.glsl draws it; 0 for a uniform disc
};

/// The light of what a Moon leaves of a disc.
///   colours, elevation, horizon  as for addSunIlluminance
///   error  1e-3: tests/showmysky/illuminance.cpp
void addCrescentIlluminance(const std::vector<Texel>& colours, double elevation, const Crescent& crescent, double horizon,
                            Illuminance& result);

/// A disc's light: what of it stands above the horizon.
///   colours    luminance from the lower to the upper edge, evenly spaced, cd m^-2
///   elevation  of the centre; all in rad
void addSunIlluminance(const std::vector<Texel>& colours, double elevation, double radius, double horizon, Illuminance& result);

} // namespace showmysky
