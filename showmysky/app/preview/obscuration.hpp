#pragma once

#include "showmysky/settings.hpp"

namespace showmysky::app::preview {

/// What the Moon does to the Sun, seen from the camera.
struct Obscuration {
    double hidden = 0;                                    ///< share of the disc's area, 0..1
    double sunRadius = 0, moonRadius = 0, separation = 0; ///< degrees
};

/// The horizon isn't counted.
///   planetRadius, topOfAtmosphere  m
///   sunAngularRadius               rad, where the settings don't say
///   throws  sky::RangeError where the Moon would touch the air
Obscuration obscuration(const SceneSettings& settings, double planetRadius, double topOfAtmosphere,
                        double sunAngularRadius);

} // namespace showmysky::app::preview
