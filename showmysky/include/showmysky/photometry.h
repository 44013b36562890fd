/* Photometry of the sky in plain C: photometry.hpp for other languages. No OpenGL, no exceptions; safe to call from many threads.

   Every function that can fail returns SHOWMYSKY_PHOTOMETRY_OK or the kind of failure; showmysky_photometry_error() then has the sentence for
   people. Spectra are arrays of showmysky_photometer_wavelength_count() values. Metres and radians. */
#ifndef SHOWMYSKY_PHOTOMETRY_H
#define SHOWMYSKY_PHOTOMETRY_H

#include "showmysky/city.h"
#include "showmysky/export.h"
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Raised whenever something below changes incompatibly. Compare with showmysky_photometry_abi() after dlopen. */
#define SHOWMYSKY_PHOTOMETRY_ABI 1

enum showmysky_photometry_status {
    SHOWMYSKY_PHOTOMETRY_OK = 0,
    SHOWMYSKY_PHOTOMETRY_BAD_MODEL = 1,    /* missing, damaged, or not a model */
    SHOWMYSKY_PHOTOMETRY_BAD_ARGUMENT = 2, /* a null pointer, or a value out of range */
    SHOWMYSKY_PHOTOMETRY_UNSUPPORTED = 3,  /* the model or this version doesn't have what was asked for */
    SHOWMYSKY_PHOTOMETRY_FAILED = 4        /* anything else, memory for instance */
};

enum showmysky_photometry_layer {
    SHOWMYSKY_ZERO_ORDER = 1, /* the ground in direct view; the Sun's disc is in no layer */
    SHOWMYSKY_SINGLE_SCATTERING = 2,
    SHOWMYSKY_MULTIPLE_SCATTERING = 4,
    SHOWMYSKY_LIGHT_POLLUTION = 8, /* of a ground that glows evenly with 1 cd/m^2 */
    SHOWMYSKY_WHOLE_SKY = 7
};

typedef struct showmysky_photometer showmysky_photometer;

/* Laid out as five doubles without gaps, so that tables of views can be passed as they are. */
typedef struct showmysky_view {
    double altitude;          /* m, >= 0 */
    double sun_zenith_angle;  /* rad, 0 .. pi */
    double sun_azimuth;       /* rad */
    double view_zenith_angle; /* rad, 0 .. pi */
    double view_azimuth;      /* rad */
} showmysky_view;

SHOWMYSKY_API int showmysky_photometry_abi(void);
/* What went wrong last in this thread; "" if nothing has. Valid until this thread's next failure. */
SHOWMYSKY_API const char* showmysky_photometry_error(void);

/* Opens a model. `reference` not 0: double precision and many steps, ten times slower. */
SHOWMYSKY_API int showmysky_photometer_open(const char* model_directory, int reference, showmysky_photometer** result);
SHOWMYSKY_API void showmysky_photometer_close(showmysky_photometer* photometer); /* null is allowed */

SHOWMYSKY_API size_t showmysky_photometer_wavelength_count(const showmysky_photometer* photometer);
SHOWMYSKY_API int showmysky_photometer_wavelengths(const showmysky_photometer* photometer, double* nanometres);
SHOWMYSKY_API int showmysky_photometer_solar_irradiance(const showmysky_photometer* photometer, double* spectrum); /* W m^-2 nm^-1 */

/* [count][wavelengths], W m^-2 sr^-1 nm^-1. `layers` is a sum of showmysky_photometry_layer. */
SHOWMYSKY_API int showmysky_photometer_radiance(const showmysky_photometer* photometer, const showmysky_view* views, size_t count,
                                                unsigned layers, double* spectra);
/* The Moon of a view, laid out as three doubles: rad, rad, and m from the planet's centre. */
typedef struct showmysky_moon {
    double azimuth, zenith_angle, distance;
} showmysky_moon;
/* The same in an eclipse: moons[i] stands for views[i]. */
SHOWMYSKY_API int showmysky_photometer_eclipsed_radiance(const showmysky_photometer* photometer, const showmysky_view* views,
                                                         const showmysky_moon* moons, size_t count, unsigned layers, double* spectra);
/* Share of the Sun's disc that the Moon hides at the camera, 0..1. */
SHOWMYSKY_API int showmysky_photometer_obscuration(const showmysky_photometer* photometer, const showmysky_view* view,
                                                   const showmysky_moon* moon, double* share);
/* Light of cities alone: [count][wavelengths], W m^-2 sr^-1 nm^-1. */
SHOWMYSKY_API int showmysky_photometer_city_radiance(const showmysky_photometer* photometer, const showmysky_view* views, size_t count,
                                                     const showmysky_city* cities, size_t city_count, double* spectra);
/* [count][4]: X, Y, Z, scotopic, cd m^-2. */
SHOWMYSKY_API int showmysky_photometer_luminance(const showmysky_photometer* photometer, const showmysky_view* views, size_t count,
                                                 unsigned layers, double* xyz_scotopic);
/* X, Y, Z, scotopic of one spectrum. */
SHOWMYSKY_API int showmysky_photometer_colour(const showmysky_photometer* photometer, const double* spectrum, double* xyz_scotopic);
/* 0..1, to space; zero where the ground is in the way. */
SHOWMYSKY_API int showmysky_photometer_transmittance(const showmysky_photometer* photometer, double altitude, double view_zenith_angle,
                                                     double* spectrum);
/* Of a plane that faces the Sun, W m^-2 nm^-1. */
SHOWMYSKY_API int showmysky_photometer_sun_irradiance(const showmysky_photometer* photometer, double altitude, double sun_zenith_angle,
                                                      double* spectrum);
/* Of a horizontal surface, W m^-2 nm^-1, by the Sun and by the sky; either may be null. */
SHOWMYSKY_API int showmysky_photometer_horizontal_irradiance(const showmysky_photometer* photometer, double altitude,
                                                             double sun_zenith_angle, double* direct, double* diffuse);

#ifdef __cplusplus
}
#endif

#endif
