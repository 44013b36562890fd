#pragma once
// Numbers of the sky without OpenGL: radiance, luminance, transmittance, sunlight and irradiance from a model's moments.
// The same in plain C: photometry.h. docs/photometry.md has examples, speed and errors.
//
// Everything throws showmysky::Error and nothing else. Spectra are arrays of wavelengthsNm().size() values; a function that gives
// one fills the caller's array.

#include "showmysky/error.hpp"
#include "showmysky/export.h"
#include "showmysky/settings.hpp"
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace showmysky {

/// Answers photometric questions about one model. Const functions may be called from many threads at once.
class SHOWMYSKY_API Photometer
{
public:
    /// Parts of the light in a view, to be added with |.
    enum Layer : unsigned {
        zeroOrder = 1,          ///< the ground in direct view, lit by the Sun and the sky; the Sun's disc is in no layer
        singleScattering = 2,   ///< one scattering in the air
        multipleScattering = 4, ///< all others: more scatterings, reflections by the ground
        lightPollution = 8,     ///< of a ground that glows evenly with 1 cd m^-2, the ground itself included; in no other layer
        wholeSky = zeroOrder | singleScattering | multipleScattering
    };

    enum class Method {
        fast,     ///< single precision, few steps along a ray: tens of microseconds
        reference ///< double precision and many steps: the twin by which the fast method and the shaders are judged
    };

    /// Where one stands, where the Sun is, where one looks. Angles in rad.
    struct View {
        double altitude = 0;        ///< m above the ground, >= 0; above the atmosphere is allowed
        double sunZenithAngle = 0;  ///< 0..pi, of the disc's centre
        double sunAzimuth = 0;      ///< only the difference of the two azimuths matters
        double viewZenithAngle = 0; ///< 0 (up) .. pi (down)
        double viewAzimuth = 0;
    };

    /// CIE 1931 X, Y, Z and scotopic luminance: cd m^-2 of a radiance, lx of an irradiance.
    struct Colour {
        double X = 0, Y = 0, Z = 0, scotopic = 0;
    };

    /// Reads the medium and, if it has them, the moments of a model.   throws  model
    explicit Photometer(const std::string& modelDirectory, Method method = Method::fast);
    ~Photometer();
    Photometer(Photometer&&) noexcept;
    Photometer& operator=(Photometer&&) noexcept;

    const std::vector<double>& wavelengthsNm() const;
    const std::vector<double>& solarIrradiance() const; ///< W m^-2 nm^-1, above the atmosphere
    double planetRadius() const;                        ///< m
    double topOfAtmosphere() const;                     ///< m, altitude
    double sunAngularRadius() const;                    ///< rad

    /// Spectral radiance, W m^-2 sr^-1 nm^-1.
    ///   layers  sum of Layer
    ///   throws  settings: a value out of range; unsupported: a layer that the model doesn't have
    void radiance(const View& view, unsigned layers, double* spectrum) const;

    /// The same for many views: [count][wavelengths]. Views in a row with the same altitude and view zenith angle share
    /// the larger part of the work.
    void radianceMany(const View* views, std::size_t count, unsigned layers, double* spectra) const;

    /// Spectral radiance in an eclipse, [count][wavelengths]: moons[i] stands for views[i], its azimuth counted as theirs. Both methods
    /// answer alike, with 400 nodes along a ray; a new place of camera, Sun or Moon costs some tenths of a second, if more than
    /// single scattering is asked for.
    ///   throws  settings: also where the Moon can't be there
    void eclipsedRadiance(const View* views, const Moon* moons, std::size_t count, unsigned layers, double* spectra) const;

    /// Share of the Sun's disc that the Moon hides at the camera, 0..1; the view's direction and the horizon play no part.
    double obscuration(const View& view, const Moon& moon) const;

    /// Light of cities alone, the discs in direct view included: [count][wavelengths]. The first question about a radius takes a second
    /// or two. Cities are counted from the point below each view's camera, their azimuths as the views'.
    ///   throws  settings
    void cityRadiance(const View* views, std::size_t count, const std::vector<City>& cities, double* spectra) const;

    /// Colour and brightness of a view, cd m^-2.
    Colour luminance(const View& view, unsigned layers = wholeSky) const;

    /// Colour and brightness of any spectrum on this model's wavelengths.
    Colour colourOf(const double* spectrum) const;

    /// Transmittance of the path to space, 0..1; zero where the ground is in the way. What a star's light is multiplied by.
    void transmittance(double altitude, double viewZenithAngle, double* spectrum) const;

    /// The Sun: irradiance of a plane that faces it, by what is visible of the disc, W m^-2 nm^-1.
    void sunIrradiance(double altitude, double sunZenithAngle, double* spectrum) const;

    /// Downward irradiance of a horizontal surface, W m^-2 nm^-1: by the Sun alone, and by the sky. Either may be null.
    void horizontalIrradiance(double altitude, double sunZenithAngle, double* direct, double* diffuse) const;

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

} // namespace showmysky
