#include "model/scattering_table.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/not_negative.hpp"
#include "physics/geometry.hpp"
#include "physics/stencil.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace sky::model {

namespace {

using base::pi;
/// Layers kept in memory: an observer needs four, one who moves a few more.
constexpr std::size_t layersKept = 8;

/// Place of x among increasing nodes as an index with a fraction.
double positionAmong(const std::vector<double>& nodes, double x)
{
    if (nodes.size() < 2 || x <= nodes.front())
        return 0;
    if (x >= nodes.back())
        return static_cast<double>(nodes.size() - 1);
    const auto k = std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin() - 1;
    return static_cast<double>(k) + (x - nodes[k]) / (nodes[k + 1] - nodes[k]);
}

physics::Stencil stencilOn(double position, int n)
{
    if (n < 2)
        return {{0, 0, 0, 0}, {0, 1, 0, 0}, 0};
    return physics::uniformStencil(position, n);
}

} // namespace

ScatteringTable::ScatteringTable(const Model& model, const std::string& name) : model_(model), table_(model.table(name))
{
    if (table_.axes.size() != 4 || table_.rowAxes != 2 || table_.axes[2].nodes.size() % 2 != 0 || table_.axes[3].nodes.size() < 2 ||
        table_.axes[2].nodes.size() < 4)
        throw ModelError(model.directory().string() + ", table \"" + name +
                         "\": expected the axes altitude, sunElevation, viewZenithAngle (even, 4 or more) and relativeAzimuth.");
    const auto& mapping = table_.axes[1].mapping;
    const auto vDark = mapping.parameters.find("vDark"), scale = mapping.parameters.find("scale");
    if (mapping.id != "sun-from-horizon" || vDark == mapping.parameters.end() || scale == mapping.parameters.end() ||
        !(scale->second > 0 && scale->second < 100) || !(vDark->second < 1))
        throw ModelError(
            model.directory().string() + ", table \"" + name +
            "\": expected the mapping \"sun-from-horizon\" with a scale of 0 to 100 and vDark below 1 on the axis of the Sun.");
    sunAxis_ = {scale->second, vDark->second};
    channels_ = table_.channelCount();
    layers_ = static_cast<int>(table_.axes[0].nodes.size());
    suns_ = static_cast<int>(table_.axes[1].nodes.size());
    views_ = static_cast<int>(table_.axes[2].nodes.size());
    azimuths_ = static_cast<int>(table_.axes[3].nodes.size());
}

const std::vector<float>& ScatteringTable::layer(const int index) const
{
    const auto found = read_.find(index);
    if (found != read_.end())
        return found->second;
    while (read_.size() >= layersKept) // the farthest from where we are
        read_.erase(std::abs(read_.begin()->first - index) > std::abs(read_.rbegin()->first - index) ? read_.begin()
                                                                                                     : std::prev(read_.end()));
    return read_[index] = model_.readRows(table_.name, index * suns_, suns_);
}

std::vector<float> ScatteringTable::slice(const double altitude, const double sunElevation) const
{
    const std::size_t columns = std::size_t(views_) * azimuths_ * channels_;
    // Nodes are uniform in the distance to the horizon and in the Sun's v: place the point on those measures.
    const physics::Planet planet{model_.manifest().planetRadius, model_.manifest().topOfAtmosphere};
    const double sun = physics::sunElevationPosition(planet, altitude, sunAxis_, suns_, sunElevation);
    if (sun < 0)
        return std::vector<float>(columns, 0.F);
    std::vector<double> measures;
    for (const double h : table_.axes[0].nodes)
        measures.push_back(physics::horizonDistance(planet, h));
    const auto a = stencilOn(positionAmong(measures, physics::horizonDistance(planet, altitude)), layers_);
    const auto [b, beyondZenith] = suns_ < 2 ? physics::SunStencil{stencilOn(sun, suns_), false} : physics::sunStencil(sun, suns_);

    std::vector<float> result(columns);
    std::array<std::vector<float>, 4> rows; // each altitude interpolated over the Sun
    for (int i = 0; i < 4; ++i) {
        if (a.weight[i] == 0)
            continue;
        const auto& values = layer(a.index[i]);
        rows[i].resize(columns);
        for (std::size_t c = 0; c < columns; ++c) {
            const std::size_t azimuth = c / channels_ % azimuths_, opposite = c + (azimuths_ - 1 - 2 * azimuth) * channels_;
            rows[i][c] = static_cast<float>(physics::interpolateLog(
                b, {double(values[b.index[0] * columns + c]), double(values[b.index[1] * columns + c]),
                    double(values[b.index[2] * columns + c]), double(values[b.index[3] * columns + (beyondZenith ? opposite : c)])}));
        }
    }
    for (std::size_t c = 0; c < columns; ++c) {
        std::array<double, 4> v{};
        for (int i = 0; i < 4; ++i)
            v[i] = a.weight[i] == 0 ? 0 : double(rows[i][c]);
        result[c] = static_cast<float>(physics::interpolateLog(a, v));
    }
    return result;
}

void ScatteringTable::sample(const std::vector<float>& slice, const double altitude, const double viewElevation,
                             const double relativeAzimuth, double* const result) const
{
    const physics::Planet planet{model_.manifest().planetRadius, model_.manifest().topOfAtmosphere};
    const auto [ground, position] = physics::viewPlace(planet, altitude, views_, viewElevation);
    const int half = views_ / 2;
    const auto view = stencilOn(position, half);
    const double folded = std::abs(std::remainder(relativeAzimuth, 2 * pi));
    const auto azimuth = physics::mirroredStencil(folded / pi * (azimuths_ - 1), azimuths_);
    for (int c = 0; c < channels_; ++c) {
        std::array<double, 4> v{};
        for (int i = 0; i < 4; ++i) {
            const int row = ground ? half - 1 - view.index[i] : half + view.index[i];
            for (int j = 0; j < 4; ++j)
                v[i] += azimuth.weight[j] * double(slice[(std::size_t(row) * azimuths_ + azimuth.index[j]) * channels_ + c]);
            v[i] = base::notNegative(v[i]);
        }
        result[c] = physics::interpolateLog(view, v);
    }
}

} // namespace sky::model
