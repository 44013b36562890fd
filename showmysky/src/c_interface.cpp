// The C face: every exception becomes a sentence of this thread.

#include "showmysky/sky.h"

#include "c_cities.hpp"
#include "showmysky/sky.hpp"
#include <algorithm>
#include <cstring>

using namespace showmysky;

static_assert(SHOWMYSKY_ABI == SHOWMYSKY_ABI_VERSION, "the library's SONAME and sky.h disagree");

struct showmysky_sky {
    Sky sky;
    std::string shaderFunctions{};
};

namespace {

thread_local std::string lastError; // the one place for it: C has no other way to hand a sentence back

template<class Action>
int guarded(Action&& action) noexcept
{
    try {
        action();
        return 1;
    } catch (const std::exception& error) {
        try {
            lastError = error.what();
        } catch (...) { // no memory for the sentence: the result says that it failed
            lastError.clear();
        }
    } catch (...) {
        lastError.clear();
    }
    return 0;
}

void report(const Progress& progress, int* done, double* fraction)
{
    if (done)
        *done = progress.done ? 1 : 0;
    if (fraction)
        *fraction = progress.fraction;
}

SceneSettings settingsOf(const showmysky_scene& given)
{
    showmysky_scene scene;
    showmysky_default_scene(&scene);
    std::memcpy(&scene, &given, std::min(given.size, sizeof scene));
    SceneSettings settings;
    settings.altitude = scene.altitude;
    settings.sun.azimuth = scene.sun_azimuth;
    settings.sun.zenithAngle = scene.sun_zenith_angle;
    if (scene.sun_angular_radius != 0)
        settings.sun.angularRadius = scene.sun_angular_radius;
    settings.moon = {scene.moon_azimuth, scene.moon_zenith_angle, scene.moon_distance};
    settings.layers.zeroOrder = scene.zero_order != 0;
    settings.layers.solarDisc = scene.solar_disc != 0;
    settings.layers.singleScattering = scene.single_scattering != 0;
    settings.layers.multipleScattering = scene.multiple_scattering != 0;
    settings.layers.lightPollution = scene.light_pollution != 0;
    for (const char* const* name = scene.hidden_scatterers; name && *name; ++name)
        settings.layers.hiddenScatterers.emplace_back(*name);
    settings.lightPollutionLuminance = scene.light_pollution_luminance;
    settings.source = scene.source == SHOWMYSKY_TEXTURES ? Source::textures : Source::moments;
    settings.eclipse = scene.eclipse ? EclipseMode::on : EclipseMode::off;
    settings.onTheFlySingleScattering = scene.on_the_fly_single_scattering != 0;
    settings.pseudoMirror = scene.pseudo_mirror != 0;
    settings.textureFiltering = scene.texture_filtering != 0;
    settings.eclipseOrders = scene.eclipse_orders;
    settings.eclipseFine = scene.eclipse_fine != 0;
    settings.limbDarkening = scene.limb_darkening != 0;
    settings.precomputedEclipse = scene.precomputed_eclipse != 0;
    if (scene.cities)
        settings.cities = citiesOf(scene.cities, scene.city_count);
    if (scene.solar_spectrum_factors)
        settings.solarSpectrumFactors.assign(scene.solar_spectrum_factors,
                                             scene.solar_spectrum_factors + scene.solar_spectrum_factor_count);
    return settings;
}

Camera cameraOf(const showmysky_camera& camera)
{
    if (camera.projection < SHOWMYSKY_EQUIRECTANGULAR || camera.projection > SHOWMYSKY_FISHEYE)
        throw Error(ErrorKind::settings, "There is no projection of number " + std::to_string(camera.projection) + ".");
    return {static_cast<Projection>(camera.projection), camera.field_of_view, camera.yaw, camera.pitch, camera.direction_texture};
}

} // namespace

int showmysky_abi_version(void) { return SHOWMYSKY_ABI_VERSION; }

const char* showmysky_error(void) { return lastError.c_str(); }

showmysky_sky* showmysky_open(const char* model_directory, showmysky_gl_loader loader, void* user, const char* function)
{
    showmysky_sky* result = nullptr;
    guarded([&] {
        if (!model_directory || !loader)
            throw Error(ErrorKind::settings, "A model directory and a loader of OpenGL functions are needed.");
        Options options;
        options.viewDirectionFunction = function ? function : "";
        result = new showmysky_sky{Sky(
            model_directory, [=](const char* name) { return loader(name, user); }, options)};
    });
    return result;
}

void showmysky_close(showmysky_sky* sky) { delete sky; }

void showmysky_abandon_context(showmysky_sky* sky)
{
    guarded([&] { sky->sky.abandonContext(); });
}

int showmysky_load_step(showmysky_sky* sky, int* done, double* fraction)
{
    return guarded([&] { report(sky->sky.loadStep(), done, fraction); });
}

int showmysky_load_all(showmysky_sky* sky)
{
    return guarded([&] { sky->sky.loadAll(); });
}

int showmysky_prepare_step(showmysky_sky* sky, int* done, double* fraction)
{
    return guarded([&] { report(sky->sky.prepareStep(), done, fraction); });
}

void showmysky_default_scene(showmysky_scene* scene)
{
    const SceneSettings settings;
    *scene = {};
    scene->size = sizeof *scene;
    scene->sun_zenith_angle = settings.sun.zenithAngle;
    scene->moon_zenith_angle = settings.moon.zenithAngle;
    scene->moon_distance = settings.moon.distance;
    scene->zero_order = scene->single_scattering = scene->multiple_scattering = scene->texture_filtering = 1;
}

int showmysky_set_scene(showmysky_sky* sky, const showmysky_scene* scene)
{
    return guarded([&] { sky->sky.setSettings(settingsOf(*scene)); });
}

int showmysky_eclipse_state(const showmysky_sky* sky, const showmysky_scene* scene, showmysky_eclipse* result)
{
    return guarded([&] {
        const EclipseState state = sky->sky.eclipseState(settingsOf(*scene));
        *result = {static_cast<int>(state.phase), state.obscuration,      state.magnitude, state.separation,
                   state.sunAngularRadius,        state.moonAngularRadius};
    });
}

int showmysky_uses_eclipse_table(const showmysky_sky* sky, const showmysky_scene* scene)
{
    bool used = false;
    guarded([&] { used = sky->sky.usesEclipseTable(settingsOf(*scene)); });
    return used ? 1 : 0;
}

int showmysky_draw(showmysky_sky* sky, const showmysky_camera* camera, int width, int height, int reduction)
{
    return guarded([&] { sky->sky.draw(cameraOf(*camera), width, height, reduction); });
}

int showmysky_draw_prepared(showmysky_sky* sky, const showmysky_camera* camera, int width, int height, int reduction)
{
    return guarded([&] { sky->sky.drawPrepared(cameraOf(*camera), width, height, reduction); });
}

unsigned showmysky_luminance_texture(const showmysky_sky* sky) { return sky->sky.luminanceTexture(); }
unsigned showmysky_program(const showmysky_sky* sky) { return sky->sky.program(); }

int showmysky_pixel_luminance(const showmysky_sky* sky, int x, int y, showmysky_luminance* result)
{
    return guarded([&] {
        const Luminance value = sky->sky.pixelLuminance(x, y);
        *result = {value.x, value.y, value.z, value.scotopic};
    });
}

int showmysky_view_direction(showmysky_sky* sky, int x, int y, double result[3])
{
    return guarded([&] {
        const auto direction = sky->sky.viewDirection(x, y);
        std::copy(direction.begin(), direction.end(), result);
    });
}

size_t showmysky_wavelengths(const showmysky_sky* sky, double* result, size_t capacity)
{
    size_t count = 0;
    guarded([&] {
        const auto& all = sky->sky.wavelengths();
        count = all.size();
        if (result)
            std::copy_n(all.begin(), std::min(capacity, count), result);
    });
    return count;
}

int showmysky_pixel_spectral_radiance(showmysky_sky* sky, int x, int y, double* result, size_t capacity)
{
    return guarded([&] {
        const auto values = sky->sky.pixelSpectralRadiance(x, y);
        std::copy_n(values.begin(), std::min(capacity, values.size()), result);
    });
}

const char* showmysky_shader_functions(showmysky_sky* sky)
{
    return guarded([&] { sky->shaderFunctions = sky->sky.shaderFunctions(); }) ? sky->shaderFunctions.c_str() : nullptr;
}

int showmysky_bind_shader_functions(showmysky_sky* sky, unsigned program, unsigned first_texture_unit)
{
    return guarded([&] { sky->sky.bindShaderFunctions(program, first_texture_unit); });
}
