#include "model/medium_tables.hpp"
#include "base/error.hpp"

#include <numbers>

namespace sky::model {

using physics::Medium;
using physics::Species;

namespace {

Axis indexAxis(const std::string& name, std::size_t count)
{
    Axis axis{name, "1", {}, {"index", {}}};
    for (std::size_t i = 0; i < count; ++i)
        axis.nodes.push_back(static_cast<double>(i));
    return axis;
}

void append(std::vector<float>& values, const std::vector<double>& more)
{
    for (const double value : more)
        values.push_back(static_cast<float>(value));
}

// Axes of a table of the medium: one node per species, then strictly increasing nodes from 0 to `last`.
void checkAxes(const Table& table, std::size_t speciesCount, double last, int channels, double tolerance)
{
    const auto require = [&](bool condition, const std::string& expected) {
        if (!condition)
            throw ModelError("Table '" + table.name + "' in '" + table.file + "': " + expected + " is expected.");
    };
    require(table.axes.size() == 2 && table.rowAxes == 1, "one row per species, one column per node");
    require(table.axes[0].nodes.size() == speciesCount, "a row for each of " + std::to_string(speciesCount) + " species");
    require(table.channelCount() == channels, std::to_string(channels) + " channels");
    const auto& nodes = table.axes[1].nodes;
    require(nodes.size() >= 2, "at least two nodes along '" + table.axes[1].name + "'");
    for (std::size_t i = 1; i < nodes.size(); ++i)
        require(nodes[i] > nodes[i - 1], "that '" + table.axes[1].name + "' increases from node to node");
    require(nodes.front() == 0 && std::abs(nodes.back() - last) <= tolerance * last,
            "that '" + table.axes[1].name + "' goes from 0 to " + std::to_string(last));
}

std::vector<double> part(const std::vector<float>& values, std::size_t index, std::size_t count)
{
    const auto start = values.begin() + static_cast<std::ptrdiff_t>(index * count);
    return {start, start + static_cast<std::ptrdiff_t>(count)};
}

} // namespace

void describeMedium(Manifest& manifest, const Medium& medium)
{
    manifest.planetRadius = medium.planetRadius;
    manifest.topOfAtmosphere = medium.topOfAtmosphere;
    manifest.sunAngularRadius = medium.sunAngularRadius;
    manifest.wavelengthsNm = medium.wavelengthsNm;
    manifest.solarIrradiance = medium.solarIrradiance;
    manifest.groundAlbedo = medium.groundAlbedo;
    manifest.species.clear();
    for (const Species& s : medium.species)
        manifest.species.push_back({s.name, s.scatters(),
                                    !s.scatters()  ? "none"
                                    : s.achromatic ? "achromatic"
                                    : s.smooth     ? "smooth"
                                                   : "general",
                                    s.singleScatteringAlbedo, s.extinctionCrossSection});
}

void writeMedium(ModelWriter& writer, const Medium& medium)
{
    std::vector<float> densities, phaseFunctions;
    std::size_t scatterers = 0;
    for (const Species& s : medium.species) {
        append(densities, s.numberDensity);
        append(phaseFunctions, s.phaseFunction);
        scatterers += s.scatters();
    }
    if (!densities.empty()) {
        TableSpec spec;
        spec.name = "medium";
        spec.quantity = "number density";
        spec.unit = "m^-3";
        spec.axes = {indexAxis("species", medium.species.size()), {"altitude", "m", medium.altitudes}};
        spec.channelNames = {"numberDensity"};
        writer.table(spec, densities);
    }
    if (scatterers > 0) {
        TableSpec spec;
        spec.name = "phase-functions";
        spec.quantity = "phase function";
        spec.unit = "sr^-1";
        spec.axes = {indexAxis("scatteringSpecies", scatterers), {"scatteringAngle", "rad", medium.scatteringAngles}};
        spec.channels = Channels::SpectralDimensionless;
        spec.wavelengthsNm = medium.wavelengthsNm;
        writer.table(spec, phaseFunctions);
    }
}

Medium readMedium(const Model& model)
{
    const Manifest& manifest = model.manifest();
    Medium medium;
    medium.planetRadius = manifest.planetRadius;
    medium.topOfAtmosphere = manifest.topOfAtmosphere;
    medium.sunAngularRadius = manifest.sunAngularRadius;
    medium.wavelengthsNm = manifest.wavelengthsNm;
    medium.solarIrradiance = manifest.solarIrradiance;
    medium.groundAlbedo = manifest.groundAlbedo;

    std::size_t scatterers = 0;
    for (const SpeciesInfo& s : manifest.species)
        scatterers += s.scatters;
    const std::size_t wavelengths = medium.wavelengthsNm.size();
    std::vector<float> densities, phaseFunctions;
    if (manifest.species.empty())
        medium.altitudes = {0, medium.topOfAtmosphere}; // a vacuum
    else {
        const Table& table = model.table("medium");
        checkAxes(table, manifest.species.size(), medium.topOfAtmosphere, 1, 1e-12);
        medium.altitudes = table.axes[1].nodes;
        densities = model.readAll("medium");
    }
    if (scatterers > 0) {
        const Table& table = model.table("phase-functions");
        checkAxes(table, scatterers, std::numbers::pi, static_cast<int>(wavelengths), 1e-9);
        medium.scatteringAngles = table.axes[1].nodes;
        phaseFunctions = model.readAll("phase-functions");
    }
    std::size_t scatterer = 0;
    for (std::size_t i = 0; i < manifest.species.size(); ++i) {
        const SpeciesInfo& info = manifest.species[i];
        Species species;
        species.name = info.name;
        species.numberDensity = part(densities, i, medium.altitudes.size());
        species.extinctionCrossSection = info.extinctionCrossSection;
        species.singleScatteringAlbedo = info.singleScatteringAlbedo;
        if (info.scatters)
            species.phaseFunction = part(phaseFunctions, scatterer++, medium.scatteringAngles.size() * wavelengths);
        species.achromatic = info.phaseFunctionType == "achromatic";
        species.smooth = info.phaseFunctionType == "smooth";
        medium.species.push_back(std::move(species));
    }
    return medium;
}

} // namespace sky::model
