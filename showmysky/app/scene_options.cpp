#include "scene_options.hpp"

#include "base/angles.hpp"
#include "base/error.hpp"
#include "scene_fields.hpp"
#include "scene_file.hpp"
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>

namespace showmysky::app {

namespace {

using sky::base::degree;

/// A mistake in a value, as the command line's parser reports it.
template<class Action>
void complainingFor(const std::string& option, Action&& action)
{
    try {
        action();
    } catch (const sky::Error& error) {
        throw CLI::ValidationError(option, error.what());
    }
}

} // namespace

void SceneOptions::addTo(CLI::App& app)
{
    // Values are taken in the order in which options were added: the file's come first.
    app.add_option_function<std::string>(
           "--scene", [this](const std::string& path) { complainingFor("--scene", [&] { loadScene(*this, path); }); },
           "file with a scene; other options go before it")
        ->type_name("FILE")
        ->group("Scene");
    for (const auto& field : sceneFields()) {
        const std::string option = "--" + field.name;
        if (field.kind == SceneField::Kind::flag) {
            app.add_flag_function(
                   option + ",!--no-" + field.name, [this, &field](std::int64_t count) { field.read(*this, count > 0 ? "yes" : "no"); },
                   field.help)
                ->group(field.group);
            continue;
        }
        auto* added = app.add_option_function<std::string>(
            option, [this, option, &field](const std::string& text) { complainingFor(option, [&] { field.read(*this, text); }); },
            field.help);
        added->default_str(field.write(*this))->type_name("")->group(field.group);
        if (field.kind == SceneField::Kind::repeated)
            added->delimiter(';')->multi_option_policy(CLI::MultiOptionPolicy::Join);
        if (field.kind == SceneField::Kind::list)
            added->delimiter(',')->multi_option_policy(CLI::MultiOptionPolicy::Join);
    }
}

SceneSettings SceneOptions::settings(const Sky& sky) const
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
    settings.layers.lightPollution = lightPollution > 0 || !cities.empty();
    for (const auto& city : cities)
        settings.cities.push_back(city.city());
    settings.layers.hiddenScatterers = hiddenScatterers;
    settings.lightPollutionLuminance = lightPollution;
    settings.source = source;
    settings.eclipse = eclipse ? EclipseMode::on : EclipseMode::off;
    settings.eclipseOrders = static_cast<int>(std::lround(eclipseOrders));
    settings.precomputedEclipse = precomputedEclipse;
    settings.eclipseFine = eclipseFine;
    settings.limbDarkening = limbDarkening;
    settings.onTheFlySingleScattering = onTheFly;
    settings.pseudoMirror = mirror;
    settings.textureFiltering = !unfiltered;
    settings.solarSpectrumFactors = solarFactors(solarSpectrum, sky.wavelengths(), sky.solarIrradiance());
    return settings;
}

Camera SceneOptions::camera() const { return {projection, fieldOfView * degree, yaw * degree, pitch * degree, 0}; }

double& SceneOptions::number(const std::string& name)
{
    std::string known;
    for (const auto& field : sceneFields())
        if (field.number) {
            if (name == field.name)
                return field.number(*this);
            known += (known.empty() ? "`" : ", `") + field.name + "`";
        }
    throw sky::UsageError("There is no number `" + name + "` to animate; there are " + known + ".");
}

} // namespace showmysky::app
