/* The plain C interface of the render library: for dlopen and for other languages. See sky.hpp for what things mean.
 *
 * Functions that can fail return 0 where they did (a null pointer, from open); showmysky_error() then has the sentence.
 * No exception and no signal leaves them. Angles in rad, lengths in m, frame and azimuths as in settings.hpp. */
#ifndef SHOWMYSKY_SKY_H
#define SHOWMYSKY_SKY_H

#include "showmysky/city.h"
#include "showmysky/export.h"
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Raised with every incompatible change of this file. Compare it with showmysky_abi_version() after dlopen. */
#define SHOWMYSKY_ABI_VERSION 0

typedef struct showmysky_sky showmysky_sky;

/* Finds an OpenGL function by its name; null where there is none. */
typedef void* (*showmysky_gl_loader)(const char* name, void* user);

enum { SHOWMYSKY_MOMENTS = 0, SHOWMYSKY_TEXTURES = 1 };
enum { SHOWMYSKY_EQUIRECTANGULAR = 0, SHOWMYSKY_PERSPECTIVE = 1, SHOWMYSKY_FISHEYE = 2 };

/* Begin with showmysky_default_scene(). */
typedef struct showmysky_scene {
    size_t size; /* sizeof(showmysky_scene) as the caller knows it; later versions add fields at the end */
    double altitude;
    double sun_azimuth, sun_zenith_angle;
    double sun_angular_radius; /* 0: as the model says */
    double moon_azimuth, moon_zenith_angle, moon_distance;
    int zero_order, solar_disc, single_scattering, multiple_scattering, light_pollution; /* layers: 0 or 1 */
    const char* const* hidden_scatterers;                                                /* null, or names ended by a null */
    double light_pollution_luminance;
    int source;
    int eclipse, on_the_fly_single_scattering, pseudo_mirror, texture_filtering; /* 0 or 1 */
    const double* solar_spectrum_factors;                                        /* null, or one per wavelength */
    size_t solar_spectrum_factor_count;
    int eclipse_orders;               /* scatterings followed through the shadow; 0: as many as the model has */
    int eclipse_fine, limb_darkening; /* 0 or 1 */
    const showmysky_city* cities;     /* part of the layer light_pollution; null where there are none */
    size_t city_count;
    int precomputed_eclipse; /* 0 or 1 */
} showmysky_scene;

typedef struct showmysky_camera {
    int projection;
    double field_of_view, yaw, pitch;
    unsigned direction_texture; /* 0, or in place of the others: see sky.hpp */
} showmysky_camera;

typedef struct showmysky_luminance {
    float x, y, z, scotopic;
} showmysky_luminance;

SHOWMYSKY_API int showmysky_abi_version(void);
/* What went wrong last on this thread; never null, empty at first. */
SHOWMYSKY_API const char* showmysky_error(void);

/* The host's context is current now and in all calls below. view_direction_function may be null. */
SHOWMYSKY_API showmysky_sky* showmysky_open(const char* model_directory, showmysky_gl_loader loader, void* user,
                                            const char* view_direction_function);
SHOWMYSKY_API void showmysky_close(showmysky_sky* sky);
SHOWMYSKY_API void showmysky_abandon_context(showmysky_sky* sky);

/* One step of loading or of preparing the scene. `done` becomes 0 or 1, `fraction` 0..1; either may be null. */
SHOWMYSKY_API int showmysky_load_step(showmysky_sky* sky, int* done, double* fraction);
SHOWMYSKY_API int showmysky_load_all(showmysky_sky* sky);
SHOWMYSKY_API int showmysky_prepare_step(showmysky_sky* sky, int* done, double* fraction);

SHOWMYSKY_API void showmysky_default_scene(showmysky_scene* scene);
SHOWMYSKY_API int showmysky_set_scene(showmysky_sky* sky, const showmysky_scene* scene);
/* Sun and Moon of a scene, whether it asks for an eclipse or not: EclipseState in sky.hpp. */
enum { SHOWMYSKY_NO_ECLIPSE = 0, SHOWMYSKY_PARTIAL = 1, SHOWMYSKY_ANNULAR = 2, SHOWMYSKY_TOTAL = 3 };
typedef struct showmysky_eclipse {
    int phase;
    double obscuration, magnitude, separation, sun_angular_radius, moon_angular_radius;
} showmysky_eclipse;
SHOWMYSKY_API int showmysky_eclipse_state(const showmysky_sky* sky, const showmysky_scene* scene, showmysky_eclipse* result);
/* 1 if the scene is drawn from the model's eclipse table, 0 if not or where that can't be told. */
SHOWMYSKY_API int showmysky_uses_eclipse_table(const showmysky_sky* sky, const showmysky_scene* scene);
SHOWMYSKY_API int showmysky_draw(showmysky_sky* sky, const showmysky_camera* camera, int width, int height, int reduction);
/* The last scene that was prepared to the end, without waiting, while the next is prepared; nothing before the first. */
SHOWMYSKY_API int showmysky_draw_prepared(showmysky_sky* sky, const showmysky_camera* camera, int width, int height, int reduction);
SHOWMYSKY_API unsigned showmysky_luminance_texture(const showmysky_sky* sky);
SHOWMYSKY_API unsigned showmysky_program(const showmysky_sky* sky);

SHOWMYSKY_API int showmysky_pixel_luminance(const showmysky_sky* sky, int x, int y, showmysky_luminance* result);
SHOWMYSKY_API int showmysky_view_direction(showmysky_sky* sky, int x, int y, double result[3]);
/* Number of wavelengths, 0 where the model isn't loaded; the first `capacity` of them in nm, unless `result` is null.
 */
SHOWMYSKY_API size_t showmysky_wavelengths(const showmysky_sky* sky, double* result, size_t capacity);
/* W m^-2 sr^-1 nm^-1 at the first `capacity` wavelengths. */
SHOWMYSKY_API int showmysky_pixel_spectral_radiance(showmysky_sky* sky, int x, int y, double* result, size_t capacity);

/* GLSL functions for shaders of the host, and what a program with them needs of the scene: see sky.hpp. The text belongs to the
 * library and lives as long as the sky, until it is asked for again; null where it failed. */
SHOWMYSKY_API const char* showmysky_shader_functions(showmysky_sky* sky);
SHOWMYSKY_API int showmysky_bind_shader_functions(showmysky_sky* sky, unsigned program, unsigned first_texture_unit);

#ifdef __cplusplus
}
#endif

#endif
