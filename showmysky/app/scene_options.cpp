#include "scene_options.hpp"

#include "base/error.hpp"
#include <algorithm>

namespace showmysky::app {

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

struct Number {
    const char* name;
    double SceneOptions::*value;
    const char* help;
};

constexpr Number numbers[] = {
    {"altitude", &SceneOptions::altitude, "of the camera, m"},
    {"sun-zenith", &SceneOptions::sunZenith, "zenith angle of the Sun, degrees"},
    {"sun-azimuth", &SceneOptions::sunAzimuth, "from North over East, degrees"},
    {"sun-radius", &SceneOptions::sunRadius, "angular radius, degrees; 0: as the model says"},
    {"moon-zenith", &SceneOptions::moonZenith, "zenith angle of the Moon, degrees"},
    {"moon-azimuth", &SceneOptions::moonAzimuth, "degrees"},
    {"moon-distance", &SceneOptions::moonDistance, "from the planet's centre, m"},
    {"fov", &SceneOptions::fieldOfView, "field of view over the width, degrees"},
    {"yaw", &SceneOptions::yaw, "azimuth of the picture's middle, degrees"},
    {"pitch", &SceneOptions::pitch, "elevation of the picture's middle, degrees"},
    {"light-pollution", &SceneOptions::lightPollution, "luminance of the ground, cd/m^2"},
};

} // namespace

void SceneOptions::addTo(CLI::App& app)
{
    for (const auto& [name, value, help] : numbers)
        app.add_option(std::string("--") + name, this->*value, help)->capture_default_str()->group("Scene");
    app.add_option("--exposure", development.exposure,
                   "log10 of the factor on luminance in cd/m^2; automatic without it")
        ->each([this](const std::string&) { development.automatic = false; })
        ->group("Picture");
    app.add_option("--projection", projection, "perspective, equirectangular or fisheye")
        ->transform(
            CLI::CheckedTransformer(std::map<std::string, Projection>{{"perspective", Projection::perspective},
                                                                      {"equirectangular", Projection::equirectangular},
                                                                      {"fisheye", Projection::fisheye}}))
        ->group("Picture");
    app.add_option("--tone-mapping", development.curve, "exponential, reinhard or linear")
        ->transform(CLI::CheckedTransformer(std::map<std::string, ToneCurve>{
            {"exponential", ToneCurve::exponential}, {"reinhard", ToneCurve::reinhard}, {"linear", ToneCurve::linear}}))
        ->group("Picture");
    app.add_option("--source", source, "moments or textures")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, Source>{{"moments", Source::moments}, {"textures", Source::textures}}))
        ->group("Scene");
    app.add_option("--layers", layers, "of zero (the ground), sun, single, multiple")
        ->delimiter(',')
        ->check(CLI::IsMember({"zero", "sun", "single", "multiple"}))
        ->group("Scene");
    app.add_option("--hide-scatterer", hiddenScatterers, "leave out a scatterer's single scattering")->group("Scene");
    app.add_option("--solar-spectrum", solarSpectrum, "factors on the model's, one per wavelength")
        ->delimiter(',')
        ->group("Scene");
    app.add_flag("--eclipse", eclipse, "let the Moon hide the Sun")->group("Scene");
    app.add_flag("--on-the-fly", onTheFly, "with textures: gather single scattering instead of looking it up")
        ->group("Scene");
    app.add_flag("--mirror", mirror, "mirror the sky below the horizon instead of showing the ground")->group("Scene");
    app.add_flag("--unfiltered", unfiltered, "show the texels of the sky tables")->group("Scene");
}

SceneSettings SceneOptions::settings() const
{
    const auto has = [&](const char* layer) { return std::find(layers.begin(), layers.end(), layer) != layers.end(); };
    SceneSettings settings;
    settings.altitude = altitude;
    settings.sun.azimuth = sunAzimuth * degree;
    settings.sun.zenithAngle = sunZenith * degree;
    if (sunRadius > 0)
        settings.sun.angularRadius = sunRadius * degree;
    settings.moon = {moonAzimuth * degree, moonZenith * degree, moonDistance};
    settings.layers.solarDisc = has("sun");
    settings.layers.zeroOrder = has("zero") || has("sun");
    settings.layers.singleScattering = has("single");
    settings.layers.multipleScattering = has("multiple");
    settings.layers.lightPollution = lightPollution > 0;
    settings.layers.hiddenScatterers = hiddenScatterers;
    settings.lightPollutionLuminance = lightPollution;
    settings.source = source;
    settings.eclipse = eclipse ? EclipseMode::on : EclipseMode::off;
    settings.onTheFlySingleScattering = onTheFly;
    settings.pseudoMirror = mirror;
    settings.textureFiltering = !unfiltered;
    settings.solarSpectrumFactors = solarSpectrum;
    return settings;
}

Camera SceneOptions::camera() const
{
    return {projection, fieldOfView * degree, yaw * degree, pitch * degree, 0};
}

double& SceneOptions::number(const std::string& name)
{
    std::string known;
    for (const auto& [other, value, help] : numbers) {
        if (name == other)
            return this->*value;
        known += std::string(known.empty() ? "`" : ", `") + other + "`";
    }
    if (name == "exposure") {
        development.automatic = false;
        return development.exposure;
    }
    throw sky::UsageError("There is no number `" + name + "` to animate; there are " + known + " and `exposure`.");
}

} // namespace showmysky::app
