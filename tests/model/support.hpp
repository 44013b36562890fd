#pragma once
#include "model/model.hpp"
#include "model/writer.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace sky::model::test {

/// A directory of its own for each test, removed at its end.
struct Scratch {
    std::filesystem::path path;
    Scratch()
    {
        path = std::filesystem::temp_directory_path() / ("sky-model-test-" + std::to_string(std::random_device{}()));
        std::filesystem::create_directories(path);
    }
    ~Scratch()
    {
        std::error_code code;
        std::filesystem::remove_all(path, code);
    }
};

inline std::string readFile(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeFile(const std::filesystem::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

inline Manifest smallManifest()
{
    Manifest m;
    m.generator = "test 1.0";
    m.name = "small";
    m.planetRadius = 6.371e6;
    m.topOfAtmosphere = 1.2e5;
    m.sunAngularRadius = 0.00465;
    m.sunDistance = 1.496e11;
    m.moonDistance = 3.844e8;
    m.moonRadius = 1.7374e6;
    m.wavelengthsNm = {391 + 1. / 3, 500, 600, 700};
    m.solarIrradiance = {1.1, 1.9, 1.7, 1.4};
    m.groundAlbedo = {0.1, 0.2, 0.3, 0.4};
    m.species = {{"molecules", true, "achromatic", {1, 1, 1, 1}, {2e-30, 6e-31, 3e-31, 1e-31}}};
    m.scatteringOrders = 4;
    m.skipped = {{"light pollution", "the description has none"}};
    m.warnings = {"phase function of \"dust\" renormalised"};
    m.estimatedError = {{"moments", 0.003}};
    m.settings = {{"tolerance", "0.001"}};
    return m;
}

inline Axis axis(const std::string& name, const std::string& unit, int count, double step)
{
    Axis axis{name, unit, {}, {"uniform", {{"step", step}}}};
    for (int i = 0; i < count; ++i)
        axis.nodes.push_back(i * step);
    return axis;
}

/// [altitude 4][sun 32] x [view 6][azimuth 3].
inline TableSpec skySpec(const std::string& name, Channels channels, int bits)
{
    TableSpec spec;
    spec.name = name;
    spec.quantity = "radiance";
    spec.unit = "W m^-2 sr^-1 nm^-1";
    spec.axes = {axis("altitude", "m", 4, 1000), axis("sunZenithAngle", "rad", 32, 0.1), axis("viewZenithAngle", "rad", 6, 0.5),
                 axis("relativeAzimuth", "rad", 3, 1)};
    spec.rowAxes = 2;
    spec.channels = channels;
    if (channels == Channels::SpectralRadiance || channels == Channels::SpectralDimensionless)
        spec.wavelengthsNm = smallManifest().wavelengthsNm;
    spec.significandBits = bits;
    return spec;
}

/// Positive values that fall by ten decades over the rows, as twilight does, all different.
inline std::vector<float> skyValues(const TableSpec& spec)
{
    std::vector<float> values;
    const int width = spec.columns() * spec.channelCount();
    for (int row = 0; row < spec.rows(); ++row)
        for (int i = 0; i < width; ++i)
            values.push_back(static_cast<float>(std::pow(10., -10. * row / spec.rows()) * (1 + 0.37 * i)));
    return values;
}

/// A whole model of two tables and a text.
inline void writeSmallModel(const std::filesystem::path& directory)
{
    ModelWriter writer(directory);
    const TableSpec radiance = skySpec("radiance", Channels::SpectralRadiance, 24);
    const TableSpec luminance = skySpec("layers/luminance", Channels::Luminance, 11);
    writer.table(radiance, skyValues(radiance));
    writer.table(luminance, skyValues(luminance));
    writer.text("description.atmo", "version: 6\n");
    writer.commit(smallManifest());
}

} // namespace sky::model::test
