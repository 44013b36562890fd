#include "texture_lookup.hpp"

#include "model/eclipse_table.hpp"
#include "model/moment_tables.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace {

const char* const multipleScattering = "multiple-scattering";

std::vector<std::string> tableNames(const Atmosphere& atmosphere)
{
    std::vector<std::string> names;
    if (!sky::model::scattersOnceAtMost(atmosphere.model.manifest()))
        names.emplace_back(multipleScattering);
    for (int i = 0; i < atmosphere.scatterers(); ++i)
        names.push_back(atmosphere.singleScatteringTable(i));
    return names;
}

} // namespace

std::string TextureLookup::missingTable(const Atmosphere& atmosphere)
{
    for (const auto& name : tableNames(atmosphere))
        if (!atmosphere.model.hasTable(name))
            return name;
    return {};
}

bool TextureLookup::anyLuminance(const Atmosphere& atmosphere)
{
    const auto names = tableNames(atmosphere);
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return atmosphere.model.hasTable(name) && atmosphere.model.table(name).channels == sky::model::Channels::Luminance;
    });
}

const sky::model::ScatteringTable& TextureLookup::table(const std::string& name)
{
    auto found = tables_.find(name);
    if (found == tables_.end())
        found = tables_.emplace(name, sky::model::ScatteringTable(atmosphere_.model, name)).first;
    return found->second;
}

/// One table at an altitude and Sun; a scatterer's (-1: none) without its phase function.
ViewTable TextureLookup::look(const std::string& name, const int scatterer, const double altitude, const double muSun,
                              const std::vector<Texel>& weights)
{
    const double elevation = std::asin(std::clamp(muSun, -1., 1.));
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    auto perRadiance = weights; // the tables are of true radiance
    for (std::size_t w = 0; w < wavelengths; ++w)
        for (float& weight : perRadiance[w])
            weight = atmosphere_.medium.solarIrradiance[w] > 0 ? weight / static_cast<float>(atmosphere_.medium.solarIrradiance[w]) : 0.f;
    const auto& from = table(name);
    const auto values = from.slice(altitude, elevation);
    const bool luminance = from.table().channels == sky::model::Channels::Luminance;
    const bool withPhase = from.table().quantity.find("phase function included") != std::string::npos;
    const auto channels = static_cast<std::size_t>(from.channels());
    const auto azimuths = static_cast<std::size_t>(from.azimuths());
    std::vector<Texel> texels(values.size() / channels, Texel{});
    std::vector<double> ratio(wavelengths, 1.);
    const auto sines = sky::physics::viewMuNodes(atmosphere_.planet(), altitude, from.views());
    for (std::size_t t = 0; t < texels.size(); ++t) {
        double divisor = 1;
        if (scatterer >= 0) {
            const double mu = sines[t / azimuths];
            const double nu =
                mu * muSun + std::sqrt(std::max(0., (1 - mu * mu) * (1 - muSun * muSun))) *
                                 std::cos(3.14159265358979323846 * static_cast<double>(t % azimuths) / static_cast<double>(azimuths - 1));
            if (withPhase)
                divisor = std::max(phases_.drawn(scatterer, nu), 1e-30);
            else if (!luminance)
                phases_.ratio(scatterer, nu, ratio.data());
        }
        for (std::size_t k = 0; k < channels; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                if (luminance)
                    texels[t][c] += k == c ? values[t * 4 + k] / static_cast<float>(divisor) : 0.f;
                else
                    texels[t][c] += values[t * channels + k] * perRadiance[k][c] * static_cast<float>(ratio[k] / divisor);
    }
    return fromIncreasingElevation(texels, from.views(), from.azimuths());
}

ViewTable TextureLookup::eclipsed(const double altitude, const double muSun, const std::vector<Texel>& weights)
{
    return look(sky::model::eclipseTable, -1, altitude, muSun, weights);
}

SkyView TextureLookup::slice(double altitude, double muSun, const LayersUsed& layers, const std::vector<Texel>& weights)
{
    SkyView result;
    result.scattered.resize(static_cast<std::size_t>(atmosphere_.scatterers()));
    if (layers.multiple && !sky::model::scattersOnceAtMost(atmosphere_.model.manifest()))
        result.whole = look(multipleScattering, -1, altitude, muSun, weights);
    for (int i = 0; i < atmosphere_.scatterers(); ++i)
        if (layers.single[static_cast<std::size_t>(i)])
            result.scattered[static_cast<std::size_t>(i)] = look(atmosphere_.singleScatteringTable(i), i, altitude, muSun, weights);
    return result;
}

} // namespace showmysky
