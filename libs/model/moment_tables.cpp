#include "model/moment_tables.hpp"
#include "base/error.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace sky::model {

namespace {

Axis sunAxis(const physics::MomentGrid& grid)
{
    Axis axis{"sunElevation", "rad", {}, {"sinh", {{"scale", grid.sunScale()}}}};
    for (int j = 0; j < grid.sunCount(); ++j)
        axis.nodes.push_back(grid.sunElevation(j));
    return axis;
}

/// Logarithms and shares of the mean light are kept to 3e-5, so that files compress. In radiances it shows by 2e-6, a fiftieth of what the finest
/// quality errs by.
float rounded(const double value)
{
    constexpr double step = 0x1p-15;
    return static_cast<float>(step * std::nearbyint(value / step));
}

/// Share of each species' scattering that counts as none, mean of the wavelengths, [species].
std::vector<double> truncatedShares(const physics::Optics& optics)
{
    std::vector<double> shares(optics.species, 0.);
    for (std::size_t i = 0; i < optics.truncation.size(); ++i)
        shares[i / optics.wavelengths] += optics.truncation[i] / optics.wavelengths;
    return shares;
}

/// Whether a manifest tells the same shares, but for what single precision of the tables makes of them. Where it tells none, none are expected.
bool sameShares(const std::vector<double>& shares, const std::string& told)
{
    std::istringstream in(told);
    in.imbue(std::locale::classic()); // a host may have another
    return std::all_of(shares.begin(), shares.end(), [&](double share) {
        double other = 0;
        in >> other;
        return std::abs(other - share) < 1e-3;
    });
}

} // namespace

void writeMoments(ModelWriter& writer, const std::string& name, const physics::Moments& m)
{
    const int harmonics = physics::harmonicCount(m.degree);
    TableSpec spec;
    spec.name = name;
    spec.quantity = "ln I_00, then I_lm / I_00, of the radiance moments per unit solar irradiance";
    spec.unit = "1";
    spec.isSigned = true;
    Axis lm{"harmonic l (l + 1) / 2 + m", "1", {}, {"index", {}}};
    for (int i = 0; i < harmonics; ++i)
        lm.nodes.push_back(i);
    spec.axes = {{"altitude", "m", m.grid.altitudes(), {}}, lm, sunAxis(m.grid)};
    spec.rowAxes = 2;
    spec.channels = Channels::Named;
    for (int w = 0; w < m.wavelengths; ++w)
        spec.channelNames.push_back("wavelength" + std::to_string(w));
    std::vector<float> values;
    values.reserve(m.values.size());
    for (int a = 0; a < m.grid.altitudeCount(); ++a)
        for (int i = 0; i < harmonics; ++i)
            for (int j = 0; j < m.grid.sunCount(); ++j)
                for (int w = 0; w < m.wavelengths; ++w)
                    values.push_back(rounded(m.at(a, j)[i * m.wavelengths + w]));
    writer.table(spec, values);

    TableSpec ground = spec;
    ground.name = name + "-ground-irradiance";
    ground.quantity = "diffuse irradiance of the ground per unit solar irradiance";
    ground.isSigned = false;
    ground.axes = {sunAxis(m.grid)};
    ground.rowAxes = 1;
    writer.table(ground, std::vector<float>(m.groundIrradiance.begin(), m.groundIrradiance.end()));
}

bool scattersOnceAtMost(const Manifest& manifest)
{
    const bool one = manifest.scatteringOrders <= 1 && !manifest.allScatteringOrders;
    const bool clear = std::none_of(manifest.species.begin(), manifest.species.end(), [](const SpeciesInfo& s) { return s.scatters; });
    const auto& sun = manifest.solarIrradiance;
    return one || clear || std::none_of(sun.begin(), sun.end(), [](double e) { return e > 0; });
}

physics::Moments readMoments(const Model& model, const std::string& name)
{
    const auto& manifest = model.manifest();
    const auto bad = [&](const std::string& what) { return ModelError(model.directory().string() + ", table \"" + name + "\": " + what); };
    const Table& table = model.table(name);
    const Table& ground = model.table(name + "-ground-irradiance");
    if (table.axes.size() != 3 || table.rowAxes != 2 || table.channelCount() != manifest.wavelengthCount())
        throw bad("expected the axes altitude, harmonic, sunElevation and a channel per wavelength.");
    const auto& altitudes = table.axes[0].nodes;
    const auto& suns = table.axes[2].nodes;
    const int harmonics = static_cast<int>(table.axes[1].nodes.size());
    int degree = 0;
    while (physics::harmonicCount(degree) < harmonics)
        ++degree;
    if (physics::harmonicCount(degree) != harmonics)
        throw bad("has " + std::to_string(harmonics) + " harmonics; expected 1, 3, 6, 10, 15, ...");
    if (altitudes.size() < 2 || suns.size() < 2 || altitudes.front() != 0 || altitudes.back() != manifest.topOfAtmosphere)
        throw bad("its altitudes must reach from 0 to the top of the atmosphere, and it needs two Suns or more.");
    for (std::size_t i = 0; i + 1 < altitudes.size(); ++i)
        if (!(altitudes[i] < altitudes[i + 1]))
            throw bad("its altitudes must increase.");
    if (!(suns.front() < 0) || suns.front() < -1.5708)
        throw bad("its lowest Sun must stand between -90 degrees and the horizontal.");
    const auto& mapping = table.axes[2].mapping;
    const auto scale = mapping.parameters.find("scale");
    if (mapping.id != "sinh" || scale == mapping.parameters.end() || !(scale->second > 0 && scale->second <= 40))
        throw bad("its Suns must follow the mapping \"sinh\" with a scale above 0, at most 40.");
    physics::Moments m;
    m.grid = physics::MomentGrid({manifest.planetRadius, manifest.topOfAtmosphere}, altitudes, suns.front(), static_cast<int>(suns.size()),
                                 scale->second);
    m.degree = degree;
    m.wavelengths = manifest.wavelengthCount();
    for (std::size_t j = 0; j < suns.size(); ++j)
        if (std::abs(m.grid.sunElevation(static_cast<double>(j)) - suns[j]) > 1e-9)
            throw bad("its Suns don't follow the mapping \"sinh\".");
    const auto values = model.readAll(name);
    m.values.resize(values.size());
    std::size_t from = 0;
    for (int a = 0; a < m.grid.altitudeCount(); ++a)
        for (int i = 0; i < harmonics; ++i)
            for (int j = 0; j < m.grid.sunCount(); ++j)
                for (int w = 0; w < m.wavelengths; ++w)
                    m.at(a, j)[i * m.wavelengths + w] = double(values[from++]);
    if (ground.axes.size() != 1 || ground.axes[0].nodes.size() != suns.size() || ground.channelCount() != m.wavelengths)
        throw bad("its ground irradiance has other Suns or wavelengths.");
    const auto irradiance = model.readAll(ground.name);
    m.groundIrradiance.assign(irradiance.begin(), irradiance.end());
    return m;
}

void describeOptics(Manifest& manifest, const physics::Optics& optics, bool truncatePeaks)
{
    manifest.settings["moments.degree"] = std::to_string(optics.degree);
    manifest.settings["moments.truncatePeaks"] = truncatePeaks ? "yes" : "no";
    std::ostringstream shares;
    shares.imbue(std::locale::classic());
    for (const double share : truncatedShares(optics))
        shares << share << " ";
    manifest.settings["moments.truncated"] = shares.str();
}

physics::Optics readOptics(const Model& model, const physics::Medium& medium)
{
    const auto& settings = model.manifest().settings;
    const auto degree = settings.find("moments.degree"), truncate = settings.find("moments.truncatePeaks");
    const auto bad = [&](const std::string& what) { return ModelError(model.directory().string() + "/manifest.json: " + what); };
    if (degree == settings.end() || truncate == settings.end())
        throw bad("the settings \"moments.degree\" and \"moments.truncatePeaks\" are missing.");
    int value = -1;
    if (degree->second.size() <= 2 && degree->second.find_first_not_of("0123456789") == std::string::npos && !degree->second.empty())
        value = std::stoi(degree->second);
    if (value < 0 || value > 64)
        throw bad("the setting \"moments.degree\" is \"" + degree->second + "\"; expected 0 to 64.");
    auto optics = physics::makeOptics(medium, value, truncate->second == "yes");
    const auto truncated = settings.find("moments.truncated");
    if (!sameShares(truncatedShares(optics), truncated == settings.end() ? "" : truncated->second))
        throw bad("its phase functions were truncated otherwise than this version does it, which changes with versions of calcmysky: "
                  "compute the model anew.");
    return optics;
}

} // namespace sky::model
