// The 4D tables: one gather per texel of what the description asks for, altitude by altitude.

#include "solver/bake.hpp"
#include "base/background.hpp"
#include "base/parallel.hpp"
#include "physics/colour.hpp"
#include "physics/table_axes.hpp"
#include "solver/lit_gather.hpp"
#include "solver/plan.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace sky::solver {

namespace {

model::Axis axisOfSuns(const BakeJob& job, int count)
{
    model::Axis axis{"sunZenithAngle", "1", {}, {"sun-from-horizon", {{"scale", job.sunAxis.scale}, {"vDark", job.sunAxis.vDark}}}};
    for (int k = 0; k < count; ++k) // the share of the way from the dark to the zenith
        axis.nodes.push_back(k);
    return axis;
}

/// Views first .. first + count - 1 of those from an altitude.
std::vector<RayStart> viewsFrom(const BakeJob& job, double altitude, int first, int count)
{
    const auto mu = physics::viewMuNodes(job.scene.profile.planet(), altitude, job.size.viewZenithAngle);
    std::vector<RayStart> starts;
    for (int k = first; k < first + count; ++k)
        starts.push_back({altitude, mu[k], k < static_cast<int>(mu.size()) / 2});
    return starts;
}

/// One layer of a table, gathered in as many groups of views as memory asks for.
struct Layer {
    int views, suns, azimuths, viewsAtOnce;
    Layer(const BakeJob& job, std::size_t bytesPerTexel)
        : views(job.size.viewZenithAngle), suns(job.size.sunZenithAngle), azimuths(job.size.dotViewSun), viewsAtOnce(views)
    {
        if (const std::size_t most = resultBytes(job.options))
            viewsAtOnce = static_cast<int>(std::clamp<std::size_t>(most / (std::size_t(suns) * azimuths * bytesPerTexel), 1, views));
    }
    std::size_t texels(int viewCount) const { return std::size_t(viewCount) * suns * azimuths; }
    Strides strides(int viewCount) const { return {azimuths, viewCount * azimuths, 1}; }
    /// Puts a group, [sun][view of the group][azimuth][floats] from float `at` of the results on, in its place.
    void place(const gl::Buffer& results, std::size_t at, int first, int count, std::size_t floats, std::vector<float>& layer) const
    {
        layer.resize(texels(views) * floats);
        const std::size_t run = std::size_t(count) * azimuths * floats;
        results.read(suns * run * sizeof(float), at * sizeof(float), [&](const void* group) {
            for (int sun = 0; sun < suns; ++sun)
                std::copy_n(static_cast<const float*>(group) + sun * run, run,
                            &layer[(std::size_t(sun) * views + first) * azimuths * floats]);
        });
    }
};

SunSamples samplesOf(const gl::Api& api, const BakeJob& job, double altitude)
{
    std::vector<float> suns, azimuths;
    for (const double e : physics::sunElevationNodes(job.scene.profile.planet(), altitude, job.sunAxis, job.size.sunZenithAngle))
        suns.push_back(static_cast<float>(std::sin(e)));
    for (const double phi : physics::azimuthNodes(job.size.dotViewSun))
        azimuths.push_back(static_cast<float>(std::cos(phi)));
    return {api, suns, azimuths};
}

/// [texel][sets * 4] as it came, without the padding of the last set, times the solar spectrum.
std::vector<float> spectra(const BakeJob& job, const float* values, std::size_t texels)
{
    const int wavelengths = job.scene.optics.wavelengths, stride = job.scene.sets() * 4;
    std::vector<float> result(texels * wavelengths);
    for (std::size_t t = 0; t < texels; ++t)
        for (int w = 0; w < wavelengths; ++w)
            result[t * wavelengths + w] = values[t * stride + w] * static_cast<float>(job.scene.medium.solarIrradiance[w]);
    return result;
}

void writeLayer(const BakeJob& job, model::TableWriter table, int layer, bool luminance, const float* values, int suns, std::size_t texels)
{
    if (luminance)
        table.writeRows(layer * suns, suns, values);
    else
        table.writeRows(layer * suns, suns, spectra(job, values, texels).data());
}

} // namespace

std::vector<std::array<double, 4>> luminanceOf(const physics::Medium& medium)
{
    auto weights = physics::luminanceWeights(medium.wavelengthsNm);
    for (std::size_t w = 0; w < weights.size(); ++w)
        for (double& component : weights[w])
            component *= medium.solarIrradiance[w];
    return weights;
}

std::string BakeJob::orderName(const std::size_t order, const bool last) const
{
    return "order " + std::to_string(order) + (last && description.allScatteringOrders ? " and all that follow" : "");
}

model::TableSpec BakeJob::spec(const std::string& name, const std::string& quantity, bool luminance) const
{
    model::TableSpec result;
    result.name = name;
    result.quantity = quantity;
    result.unit = luminance ? "cd m^-2" : "W m^-2 sr^-1 nm^-1";
    model::Axis view{"viewZenithAngle", "1", {}, {"horizon-halves", {{"scale", physics::horizonAngleScale}}}};
    for (int k = 0; k < size.viewZenithAngle; ++k) // the share of the way from nadir to horizon, then from horizon to zenith
        view.nodes.push_back(k);
    result.axes = {{"altitude", "m", altitudes(), {"horizon-distance", {}}},
                   axisOfSuns(*this, size.sunZenithAngle),
                   view,
                   {"relativeAzimuth", "rad", physics::azimuthNodes(size.dotViewSun), {"uniform", {}}}};
    result.rowAxes = 2;
    result.channels = luminance ? model::Channels::Luminance : model::Channels::SpectralRadiance;
    if (!luminance)
        result.wavelengthsNm = scene.medium.wavelengthsNm;
    result.significandBits = options.texturePrecisionBits;
    return result;
}

int BakeSettings::directNodesFor(const int suns) const
{
    return static_cast<int>(std::lround(directNodes * std::clamp(std::sqrt(suns / 128.), 0.5, 1.)));
}

std::vector<double> BakeJob::altitudes() const
{
    auto all = physics::altitudeNodes(scene.profile.planet(), size.altitude);
    if (options.altitudeLayers)
        all = {all.begin() + options.altitudeLayers->first, all.begin() + options.altitudeLayers->second + 1};
    return all;
}

void bakeSingleScattering(const gl::Api& api, const BakeJob& job, model::ModelWriter& writer, const std::function<void(double)>& breath)
{
    const auto& optics = job.scene.optics;
    const int scatterers = job.scene.scatterers();
    if (scatterers == 0)
        return;
    // Luminance loses nothing where the phase function is inside or the same at all wavelengths; in the latter case it is gathered
    // as such.
    enum class Way { spectra, luminanceOfSpectra, luminance };
    std::vector<bool> withPhase;
    std::vector<Way> ways;
    std::vector<model::TableWriter> tables;
    for (const int s : optics.scatterers) {
        const auto& scatterer = job.description.scatterers[s];
        const bool smooth = scatterer.phaseFunctionType == atmo::PhaseFunctionType::Smooth;
        const bool achromatic = scatterer.phaseFunctionType == atmo::PhaseFunctionType::Achromatic;
        withPhase.push_back(smooth);
        const bool luminance = !job.options.radiance && (smooth || achromatic);
        ways.push_back(!luminance                                          ? Way::spectra
                       : smooth && !job.scene.medium.species[s].achromatic ? Way::luminanceOfSpectra
                                                                           : Way::luminance);
        tables.push_back(writer.table(
            job.spec("single-scattering/" + scatterer.name,
                     smooth ? "single scattering, phase function included" : "single scattering, to be multiplied by the phase function",
                     luminance)));
    }
    const auto any = [&](Way way) { return std::find(ways.begin(), ways.end(), way) != ways.end(); };
    std::optional<LitGather> luminance;
    std::optional<DirectGather> luminanceOfSpectra, spectra;
    if (any(Way::luminance))
        luminance.emplace(api, job.scene, luminanceOf(job.scene.medium));
    if (any(Way::luminanceOfSpectra))
        luminanceOfSpectra.emplace(api, job.scene, DirectGather::Purpose::table, luminanceOf(job.scene.medium));
    if (any(Way::spectra))
        spectra.emplace(api, job.scene, DirectGather::Purpose::table, std::vector<std::array<double, 4>>{});

    const auto altitudes = job.altitudes();
    const std::size_t vec4s = spectra ? job.scene.sets() : 1;
    const Layer shape(job, scatterers * vec4s * 16);
    gl::Buffer results(api, "single scattering", shape.texels(shape.viewsAtOnce) * scatterers * vec4s * 16);
    std::vector<std::vector<float>> layers(scatterers);
    base::Background writing;
    for (std::size_t layer = 0; layer < altitudes.size(); ++layer) {
        const auto fraction = [&] { breath(double(layer) / double(altitudes.size())); };
        const SunSamples samples = samplesOf(api, job, altitudes[layer]);
        for (int first = 0; first < shape.views; first += shape.viewsAtOnce) {
            const int count = std::min(shape.viewsAtOnce, shape.views - first);
            const DirectRayData rays(job.scene, viewsFrom(job, altitudes[layer], first, count),
                                     job.settings.directNodesFor(job.size.sunZenithAngle), false);
            const auto place = [&](Way way) {
                const std::size_t floats = way == Way::spectra ? std::size_t(job.scene.sets()) * 4 : 4,
                                  block = shape.texels(count) * floats;
                for (int i = 0; i < scatterers; ++i)
                    if (ways[i] == way)
                        shape.place(results, i * block, first, count, floats, layers[i]);
            };
            if (luminance) {
                luminance->gather(rays, samples, shape.strides(count), withPhase, results, fraction);
                place(Way::luminance);
            }
            if (!luminanceOfSpectra && !spectra)
                continue;
            const DirectRays onGpu(api, rays);
            if (luminanceOfSpectra) {
                luminanceOfSpectra->gather(onGpu, samples, shape.strides(count), withPhase, results, fraction);
                place(Way::luminanceOfSpectra);
            }
            if (spectra) {
                spectra->gather(onGpu, samples, shape.strides(count), withPhase, results, fraction);
                place(Way::spectra);
            }
        }
        writing.start([&, layer, done = std::exchange(layers, std::vector<std::vector<float>>(scatterers))] {
            for (int i = 0; i < scatterers; ++i)
                writeLayer(job, tables[i], static_cast<int>(layer), ways[i] != Way::spectra, done[i].data(), shape.suns,
                           shape.texels(shape.views));
        });
    }
    writing.finish();
    breath(1);
}

void bakeMultipleScattering(const gl::Api& api, const BakeJob& job, const physics::Moments& field, const std::string& name,
                            const std::string& quantity, model::ModelWriter& writer, const std::function<void(double)>& breath)
{
    const bool luminance = !job.options.radiance;
    auto table = writer.table(job.spec(name, quantity, luminance));
    const std::size_t texels = std::size_t(job.size.viewZenithAngle) * job.size.sunZenithAngle * job.size.dotViewSun;
    base::Background writing;
    gatherMultipleScattering(api, job, field, luminance, breath, [&](int layer, std::vector<float> values) {
        writing.start([&, layer, done = std::move(values)] {
            writeLayer(job, table, layer, luminance, done.data(), job.size.sunZenithAngle, texels);
        });
    });
    writing.finish();
}

void gatherMultipleScattering(const gl::Api& api, const BakeJob& job, const physics::Moments& field, const bool luminance,
                              const std::function<void(double)>& breath,
                              const std::function<void(int layer, std::vector<float> texels)>& use)
{
    ScatteredGather gather(api, job.scene, luminance ? luminanceOf(job.scene.medium) : std::vector<std::array<double, 4>>{});
    const FoldField fine(field, job.settings.refinement);
    const auto altitudes = job.altitudes();
    const std::size_t floats = luminance ? 4 : std::size_t(job.scene.sets()) * 4;
    const Layer shape(job, floats * sizeof(float));
    gl::Buffer results(api, "multiple scattering", shape.texels(shape.viewsAtOnce) * floats * sizeof(float));
    std::vector<float> values;
    for (std::size_t layer = 0; layer < altitudes.size(); ++layer) {
        const SunSamples samples = samplesOf(api, job, altitudes[layer]);
        for (int first = 0; first < shape.views; first += shape.viewsAtOnce) {
            const int count = std::min(shape.viewsAtOnce, shape.views - first);
            const ScatteredRays rays(api, job.scene, field.grid, viewsFrom(job, altitudes[layer], first, count),
                                     {job.settings.nodes, job.settings.stationTolerance, false});
            gather.gather(rays, fine, rays.degree, samples, shape.strides(count), results,
                          [&] { breath(double(layer) / double(altitudes.size())); });
            shape.place(results, 0, first, count, floats, values);
        }
        use(static_cast<int>(layer), std::exchange(values, {}));
    }
    breath(1);
}

void bakeTransmittance(const BakeJob& job, model::ModelWriter& writer)
{
    const auto& size = job.description.transmittanceSize;
    const auto& planet = job.scene.profile.planet();
    const auto& medium = job.scene.medium;
    // True extinction: what delta-M scaling took from it is light that goes straight on only inside the solver.
    model::TableSpec spec;
    spec.name = "transmittance";
    spec.quantity = "transmittance from the altitude to space, above the horizon";
    spec.unit = "1";
    spec.channels = model::Channels::SpectralDimensionless;
    spec.wavelengthsNm = medium.wavelengthsNm;
    model::Axis view{"viewZenithAngle", "1", {}, {"horizon-upper-half", {{"scale", physics::horizonAngleScale}}}};
    for (int k = 0; k < size.zenithAngle; ++k)
        view.nodes.push_back(k);
    const auto altitudes = physics::altitudeNodes(planet, size.altitude);
    spec.axes = {{"altitude", "m", altitudes, {"horizon-distance", {}}}, view};
    const int wavelengths = medium.wavelengthCount();
    std::vector<float> values(std::size_t(size.altitude) * size.zenithAngle * wavelengths);
    base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(job.scene.profile, job.scene.optics, 2);
        std::vector<double> columns(medium.species.size());
        for (int a = thread; a < size.altitude; a += threads) {
            const double h = altitudes[a], horizon = physics::horizonElevation(planet, h);
            const auto angles = physics::horizonAngleNodes(std::acos(-1.) / 2 - horizon, size.zenithAngle);
            for (int k = 0; k < size.zenithAngle; ++k) {
                tracer.columns(h, std::min(1., std::sin(horizon + angles[k])), columns.data());
                for (int w = 0; w < wavelengths; ++w) {
                    double depth = 0;
                    for (std::size_t s = 0; s < columns.size(); ++s)
                        depth += columns[s] * medium.species[s].extinctionCrossSection[w];
                    values[(std::size_t(a) * size.zenithAngle + k) * wavelengths + w] = static_cast<float>(std::exp(-depth));
                }
            }
        }
    });
    writer.table(spec, values);
}

void bakeIrradiance(const BakeJob& job, const RadiationField* field, bool perEvent, model::ModelWriter& writer)
{
    const auto& size = job.description.irradianceSize;
    const auto& planet = job.scene.profile.planet();
    const auto& medium = job.scene.medium;
    const int wavelengths = medium.wavelengthCount();
    const auto altitudes = physics::altitudeNodes(planet, size.altitude);
    model::TableSpec spec;
    spec.unit = "W m^-2 nm^-1";
    spec.channels = model::Channels::SpectralDimensionless;
    spec.wavelengthsNm = medium.wavelengthsNm;
    spec.axes = {{"altitude", "m", altitudes, {"horizon-distance", {}}}, axisOfSuns(job, size.zenithAngle)};
    const auto suns = [&](double altitude) { return physics::sunElevationNodes(planet, altitude, job.sunAxis, size.zenithAngle); };

    std::vector<float> direct;
    std::vector<double> light(wavelengths);
    for (const double h : altitudes)
        for (const double e : suns(h)) {
            physics::sunOnSurface(job.scene.profile, job.scene.optics, medium.sunAngularRadius, h, e, light.data());
            for (int w = 0; w < wavelengths; ++w)
                direct.push_back(static_cast<float>(light[w] * medium.solarIrradiance[w]));
        }
    spec.name = "irradiance-direct";
    spec.quantity = "downward irradiance of a horizontal surface by the Sun alone";
    writer.table(spec, direct);
    if (!field)
        return;

    const auto write = [&](const std::vector<double>& grid, const std::string& name, const std::string& quantity) {
        const auto& from = field->total.grid;
        std::vector<float> values;
        for (const double h : altitudes) {
            const auto a = from.altitudeStencil(h);
            const auto between = physics::logarithmBetween(a);
            for (const double e : suns(h)) {
                const auto b = from.sunStencil(from.sunPosition(e));
                for (int w = 0; w < wavelengths; ++w) {
                    double logarithm = 0;
                    for (int j = 0; j < 4; ++j) {
                        const auto level = [&](int i) {
                            return std::log(
                                std::max(grid[(std::size_t(a.index[i]) * from.sunCount() + from.sunAsHigh(b.index[j])) * wavelengths + w],
                                         physics::darkness));
                        };
                        logarithm += b.weight[j] * between(level(0), level(1), level(2), level(3));
                    }
                    values.push_back(static_cast<float>(std::exp(logarithm) * medium.solarIrradiance[w]));
                }
            }
        }
        spec.name = name;
        spec.quantity = quantity;
        writer.table(spec, values);
    };
    std::vector<double> sum(field->irradiance.front().size(), 0.);
    for (std::size_t event = 0; event < field->irradiance.size(); ++event) {
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += field->irradiance[event][i];
        if (perEvent)
            write(field->irradiance[event], "irradiance-order-" + std::to_string(event + 1),
                  "downward irradiance of a horizontal surface by light of " +
                      job.orderName(event + 1, event + 1 == field->irradiance.size()));
    }
    write(sum, "irradiance-diffuse", "downward irradiance of a horizontal surface by the sky");
}

} // namespace sky::solver
