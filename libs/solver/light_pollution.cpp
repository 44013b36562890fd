#include "solver/light_pollution.hpp"
#include "base/parallel.hpp"
#include "model/glow_tables.hpp"
#include "physics/colour.hpp"
#include "physics/glow_light.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace sky::solver {

namespace {

physics::GlowSettings settingsFor(const std::string& quality)
{
    physics::GlowSettings s;
    if (quality == "fine" || quality == "reference") {
        s.altitudes = 64;
        s.degree = 16;
        s.groundDirections = s.skyDirections = 20;
        s.limbDirections = 10;
        s.cells = 1;
    }
    return s;
}

using RadianceAlong = std::function<void(const physics::RayCells&, double*)>;

/// One table over altitude and view of what `radiance` says of the ray, times the spectrum.
void writeTable(const atmo::Description& description, const Options& options, const physics::Medium& medium,
                const physics::Profile& profile, const physics::Optics& optics, const std::vector<double>& spectrum, double cells,
                const std::string& name, const std::string& quantity, const RadianceAlong& radiance, model::ModelWriter& writer)
{
    const auto& planet = profile.planet();
    const int layers = description.lightPollutionSize.altitude, wavelengths = medium.wavelengthCount();
    const int views = std::max(4, (description.lightPollutionSize.zenithAngle + 1) / 2 * 2); // two halves of two or more
    const auto altitudes = physics::altitudeNodes(planet, layers);
    model::TableSpec spec;
    spec.name = name;
    spec.quantity = quantity;
    spec.unit = options.radiance ? "W m^-2 sr^-1 nm^-1 per cd m^-2 of the ground" : "cd m^-2 per cd m^-2 of the ground";
    spec.channels = options.radiance ? model::Channels::SpectralRadiance : model::Channels::Luminance;
    if (options.radiance)
        spec.wavelengthsNm = medium.wavelengthsNm;
    model::Axis view{"viewZenithAngle", "1", {}, {"horizon-halves", {{"scale", physics::horizonAngleScale}}}};
    for (int k = 0; k < views; ++k)
        view.nodes.push_back(k);
    spec.axes = {{"altitude", "m", altitudes, {"horizon-distance", {}}}, view};

    const auto weights = physics::luminanceWeights(medium.wavelengthsNm);
    const int channels = spec.channelCount();
    std::vector<float> values(std::size_t(layers) * views * channels, 0.F);
    base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(profile, optics, cells);
        std::vector<double> light(wavelengths);
        for (int a = thread; a < layers; a += threads) {
            const auto mu = physics::viewMuNodes(planet, altitudes[a], views);
            for (int k = 0; k < views; ++k) {
                radiance(tracer.cells(altitudes[a], mu[k], k < views / 2, physics::GlowLight::deepest), light.data());
                float* texel = &values[(std::size_t(a) * views + k) * channels];
                for (int w = 0; w < wavelengths; ++w)
                    if (options.radiance)
                        texel[w] = static_cast<float>(light[w] * spectrum[w]);
                    else
                        for (int c = 0; c < 4; ++c)
                            texel[c] += static_cast<float>(light[w] * spectrum[w] * weights[w][c]);
            }
        }
    });
    writer.table(spec, values);
}

} // namespace

std::vector<double> glowSpectrum(const atmo::Description& description, std::vector<std::string>& warnings)
{
    std::vector<double> spectrum = description.lightPollutionRadiance;
    const auto weights = physics::luminanceWeights(description.wavelengths.values());
    double luminance = 0;
    for (std::size_t w = 0; w < spectrum.size(); ++w)
        luminance += spectrum[w] * weights[w][1];
    if (!(luminance > 0))
        return {};
    if (std::abs(luminance - 1) > 0.05) {
        std::ostringstream text;
        text << "The `light pollution relative radiance` has a luminance of " << luminance << " cd/m^2; it was scaled to 1.";
        warnings.push_back(text.str());
    }
    for (double& value : spectrum)
        value /= luminance;
    return spectrum;
}

void bakeLightPollution(const atmo::Description& description, const Options& options, const physics::Medium& medium,
                        const std::vector<double>& spectrum, model::ModelWriter& writer, model::Manifest& manifest,
                        const std::function<void(double)>& breath)
{
    const auto settings = settingsFor(options.quality);
    const physics::Profile profile = physics::glowProfile(medium);
    const physics::Optics optics = physics::glowOptics(medium, settings.degree);
    const auto field = physics::solveGroundGlow(medium, profile, optics, settings, options.saveLightPollution,
                                                [&](int event) { breath(0.5 * (1 - std::pow(0.7, event))); });
    manifest.settings["light-pollution.events"] = std::to_string(field.eventCount);
    manifest.estimatedError["light pollution orders left out"] = field.remainder;
    model::writeGlow(writer, field.total);
    const auto table = [&](const std::string& name, const std::string& quantity, const RadianceAlong& radiance) {
        breath(0.5);
        writeTable(description, options, medium, profile, optics, spectrum, settings.cells, name, quantity, radiance, writer);
    };
    const auto lightOf = [&](const physics::GlowMoments& moments) { return physics::GlowLight(medium, optics, moments); };
    table(model::lightPollutionTable, "light of a ground that glows evenly, and what is scattered of it",
          [light = lightOf(field.total)](const physics::RayCells& ray, double* result) { light.seen(ray, result); });
    for (std::size_t order = 0; !field.perEvent.empty() && order <= field.perEvent.size(); ++order) // the field is scattered once more
        table(std::string(model::lightPollutionTable) + "/order-" + std::to_string(order),
              "light pollution of order " + std::to_string(order),
              [order, light = lightOf(field.perEvent[order > 0 ? order - 1 : 0])](const physics::RayCells& ray, double* result) {
                  if (order == 0)
                      light.direct(ray, result);
                  else
                      light.scattered(ray, result);
              });
    breath(1);
}

} // namespace sky::solver
