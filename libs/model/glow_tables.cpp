#include "model/glow_tables.hpp"
#include "base/error.hpp"
#include "physics/stencil.hpp"
#include "physics/table_axes.hpp"
#include <cmath>

namespace sky::model {

namespace {

const std::string irradianceTable = std::string(lightPollutionMoments) + "-ground-irradiance";

ModelError bad(const Model& model, const std::string& table, const std::string& what)
{
    return ModelError(model.directory().string() + ", table \"" + table + "\": " + what);
}

} // namespace

void writeGlow(ModelWriter& writer, const physics::GlowMoments& m)
{
    TableSpec spec;
    spec.name = lightPollutionMoments;
    spec.quantity = "ln I_0, then I_l / I_0, of the moments of radiance per radiance of the glowing ground";
    spec.unit = "1";
    spec.isSigned = true;
    Axis harmonic{"harmonic l", "1", {}, {"index", {}}};
    for (int l = 0; l <= m.degree; ++l)
        harmonic.nodes.push_back(l);
    spec.axes = {{"altitude", "m", m.grid.altitudes(), {}}, harmonic};
    for (int w = 0; w < m.wavelengths; ++w)
        spec.channelNames.push_back("wavelength" + std::to_string(w));
    writer.table(spec, std::vector<float>(m.values.begin(), m.values.end()));

    TableSpec ground = spec;
    ground.name = irradianceTable;
    ground.quantity = "diffuse irradiance of the ground per radiance of the glowing ground";
    ground.unit = "sr";
    ground.isSigned = false;
    ground.axes = {{"altitude", "m", {0}, {}}};
    writer.table(ground, std::vector<float>(m.groundIrradiance.begin(), m.groundIrradiance.end()));
}

physics::GlowMoments readGlow(const Model& model)
{
    const auto& manifest = model.manifest();
    const Table& table = model.table(lightPollutionMoments);
    const Table& ground = model.table(irradianceTable);
    if (table.axes.size() != 2 || table.rowAxes != 1 || table.channelCount() != manifest.wavelengthCount() ||
        table.axes[1].nodes.size() > 65)
        throw bad(model, table.name, "expected the axes altitude and harmonic (65 at most) and a channel per wavelength.");
    const auto& altitudes = table.axes[0].nodes;
    if (altitudes.size() < 2 || altitudes.front() != 0 || altitudes.back() != manifest.topOfAtmosphere)
        throw bad(model, table.name, "its altitudes must reach from 0 to the top of the atmosphere.");
    for (std::size_t i = 0; i + 1 < altitudes.size(); ++i)
        if (!(altitudes[i] < altitudes[i + 1]))
            throw bad(model, table.name, "its altitudes must increase.");
    if (ground.axes.size() != 1 || ground.axes[0].nodes.size() != 1 || ground.channelCount() != manifest.wavelengthCount())
        throw bad(model, ground.name, "expected one row and a channel per wavelength.");
    physics::GlowMoments m;
    m.grid = physics::MomentGrid({manifest.planetRadius, manifest.topOfAtmosphere}, altitudes, -1, 2);
    m.degree = static_cast<int>(table.axes[1].nodes.size()) - 1;
    m.wavelengths = manifest.wavelengthCount();
    const auto values = model.readAll(table.name), irradiance = model.readAll(ground.name);
    m.values.assign(values.begin(), values.end());
    m.groundIrradiance.assign(irradiance.begin(), irradiance.end());
    return m;
}

GlowTable::GlowTable(const Model& model) : planet_{model.manifest().planetRadius, model.manifest().topOfAtmosphere}
{
    const Table& table = model.table(lightPollutionTable);
    if (table.axes.size() != 2 || table.rowAxes != 1 || table.axes[0].nodes.size() < 2 || table.axes[1].nodes.size() < 4 ||
        table.axes[1].nodes.size() % 2 != 0)
        throw bad(model, table.name, "expected the axes altitude (2 nodes or more) and viewZenithAngle (even, 4 or more).");
    if (table.channels != Channels::Luminance && table.channels != Channels::SpectralRadiance)
        throw bad(model, table.name, "expected luminance or spectral radiance.");
    layers_ = static_cast<int>(table.axes[0].nodes.size());
    views_ = static_cast<int>(table.axes[1].nodes.size());
    channels_ = table.channelCount();
    luminance_ = table.channels == Channels::Luminance;
    if (!luminance_ && channels_ != model.manifest().wavelengthCount())
        throw bad(model, table.name, "expected a channel per wavelength.");
    values_ = model.readAll(table.name);
}

std::vector<double> GlowTable::slice(const double altitude) const
{
    const double share =
        std::min(1., physics::horizonDistance(planet_, altitude) / physics::horizonDistance(planet_, planet_.topOfAtmosphere));
    const auto a = physics::uniformStencil(share * (layers_ - 1), layers_);
    const std::size_t columns = std::size_t(views_) * channels_;
    std::vector<double> result(columns);
    for (std::size_t c = 0; c < columns; ++c) {
        std::array<double, 4> v{};
        for (int i = 0; i < 4; ++i)
            v[i] = double(values_[a.index[i] * columns + c]);
        result[c] = physics::interpolateLog(a, v);
    }
    return result;
}

void GlowTable::sample(const std::vector<double>& slice, const double altitude, const double viewElevation, double* const result) const
{
    const auto [ground, position] = physics::viewPlace(planet_, altitude, views_, viewElevation);
    const int half = views_ / 2;
    const auto view = physics::uniformStencil(position, half);
    for (int c = 0; c < channels_; ++c) {
        std::array<double, 4> v{};
        for (int i = 0; i < 4; ++i)
            v[i] = slice[(ground ? half - 1 - view.index[i] : half + view.index[i]) * channels_ + c];
        result[c] = physics::interpolateLog(view, v);
    }
}

} // namespace sky::model
