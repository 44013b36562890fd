#pragma once
// How luminance becomes what a screen shows; the formulas are in shaders/lib/display.glsl.

namespace showmysky::app {

enum class ToneCurve {
    exponential, ///< 1 - exp(-x) by channel: bright light turns white as on film
    reinhard,    ///< x / (1 + x) of the luminance, hue kept
    linear       ///< cut off at white
};

/// What of the light is shown.
enum class ColourMode {
    srgb,                   ///< as a camera would
    photopic,               ///< luminance as grey
    scotopic,               ///< scotopic luminance as grey: what rods see
    xyzChromaticitySmooth,  ///< X, Y, Z over their sum
    xyzChromaticityBright,  ///< X, Y, Z over the largest of them
    srgbChromaticitySmooth, ///< R, G, B over their sum
    srgbChromaticityBright, ///< R, G, B over the largest of them
    hue,                    ///< of R, G, B at full saturation
    x,
    z,
    red,
    green,
    blue ///< one channel as grey
};

enum class Dithering {
    none,
    ordered,  ///< 8 x 8 thresholds (Bayer 1973)
    blueNoise ///< 64 x 64 thresholds without low frequencies (Ulichney 1993)
};

/// Bits of red, green and blue.
enum class Depth { bits565, bits666, bits888, bits101010 };

struct Development {
    ToneCurve curve = ToneCurve::exponential;
    bool automatic = true; ///< exposure from the picture itself
    double exposure = -4;  ///< log10 of the factor from cd m^-2 to the curve's argument
    ColourMode colours = ColourMode::srgb;
    bool gradualClipping = true; ///< too bright colours fade to white instead of being cut off by channel
    double glare = 0;            ///< light scattered in the eye, in units of a healthy one's (Stiles and Holladay)
    Dithering dithering = Dithering::ordered;
    Depth depth = Depth::bits888;

    bool operator==(const Development&) const = default;
};

} // namespace showmysky::app
