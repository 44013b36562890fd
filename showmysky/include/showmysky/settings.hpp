#pragma once
// What a scene is: everything that decides the radiance of a direction, and nothing about the screen.
//
// Frame at the camera: x North, y West, z zenith. Azimuths are counted from North over East, clockwise seen from above.
// Metres and radians.

#include <optional>
#include <string>
#include <vector>

namespace showmysky {

/// Parts of the light, each on or off.
struct Layers {
    bool zeroOrder = true;  ///< the ground by day; with `solarDisc` the Sun itself
    bool solarDisc = false; ///< the attenuated disc: far too bright for most pictures, so it is asked for
    bool singleScattering = true;
    bool multipleScattering = true;
    bool lightPollution = false;               ///< the glowing ground, cities, and the air above; an even glow needs a model that has it
    std::vector<std::string> hiddenScatterers; ///< whose single scattering is left out, by the names in the model
};

enum class EclipseMode { off, on };

/// Which tables of a model the light comes from.
enum class Source {
    moments, ///< the radiance moments, gathered into small tables of this sky
    textures ///< 4D scattering tables, interpolated
};

struct Sun {
    double azimuth = 0;                    ///< rad
    double zenithAngle = 0.7853981634;     ///< rad, 0 .. pi
    std::optional<double> angularRadius{}; ///< rad; empty: as the model says
};

struct Moon {
    double azimuth = 0;                ///< rad
    double zenithAngle = 3.1415926536; ///< rad, 0 .. pi
    double distance = 384400e3;        ///< m, from the planet's centre
};

/// A disc on the ground that glows evenly, and lights the air far around.
struct City {
    double distance = 0;  ///< of its centre from the point below the camera, along the ground, m
    double azimuth = 0;   ///< rad
    double radius = 10e3; ///< along the ground, m, above 0, at most a tenth of the planet's
    double luminance = 1; ///< of its ground, cd m^-2
    /// Shape of its spectral radiance, one value per wavelength; empty: that of the model's light pollution.
    std::vector<double> spectrum{};

    bool operator==(const City& other) const
    {
        return distance == other.distance && azimuth == other.azimuth && radius == other.radius && luminance == other.luminance &&
               spectrum == other.spectrum;
    }
};

struct SceneSettings {
    double altitude = 0; ///< of the camera, m, >= 0; may be above the atmosphere
    Sun sun{};
    Moon moon{};
    Layers layers{};
    Source source = Source::moments;
    EclipseMode eclipse = EclipseMode::off; ///< on: the Moon hides what it hides, from each point of the air
    int eclipseOrders = 0;                  ///< scatterings followed through the shadow, >= 1; 0: as many as the model has
    /// Of the textures source: where Sun and Moon stand as in the model's eclipse table, light of higher orders is looked up there; else,
    /// or where this is false, it is followed on the fly.
    bool precomputedEclipse = false;
    bool eclipseFine = false;              ///< tables of an eclipse four times as fine both ways: for stills
    bool limbDarkening = false;            ///< in an eclipse the Sun is darker towards its limb
    bool onTheFlySingleScattering = false; ///< of the textures source: single scattering gathered, not looked up
    double lightPollutionLuminance = 0;    ///< of the ground, cd m^-2
    std::vector<City> cities{};            ///< any number; part of the layer lightPollution
    bool pseudoMirror = false;             ///< below the horizon a mirror image of the sky instead of the ground
    bool textureFiltering = true;          ///< false shows the texels of the sky tables
    /// Factors on the model's solar spectrum, one per wavelength; empty: as the model says.
    std::vector<double> solarSpectrumFactors{};
};

} // namespace showmysky
