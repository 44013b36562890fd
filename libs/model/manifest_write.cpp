#include "model/manifest.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace sky::model {

namespace {

using Json = nlohmann::ordered_json;

bool isScalarArray(const Json& value)
{
    if (!value.is_array())
        return false;
    for (const Json& item : value)
        if (item.is_structured())
            return false;
    return true;
}

// Indented, but with arrays of plain values on one line: hundreds of axis nodes would bury the rest.
void print(const Json& value, int indent, std::string& out)
{
    if (!value.is_structured() || value.empty() || isScalarArray(value)) {
        out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
        return;
    }
    const std::string inner(static_cast<std::size_t>(indent) + 2, ' ');
    out += value.is_array() ? "[" : "{";
    bool first = true;
    for (auto item = value.begin(); item != value.end(); ++item) {
        out += (first ? "\n" : ",\n") + inner;
        first = false;
        if (value.is_object())
            out += Json(item.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
        print(*item, indent + 2, out);
    }
    out += "\n" + std::string(static_cast<std::size_t>(indent), ' ') + (value.is_array() ? "]" : "}");
}

const char* channelsWord(Channels channels)
{
    switch (channels) {
    case Channels::SpectralRadiance: return "spectral radiance";
    case Channels::SpectralDimensionless: return "spectral dimensionless";
    case Channels::Luminance: return "luminance";
    case Channels::Named: break;
    }
    return "named";
}

Json axisJson(const Axis& axis)
{
    Json json{{"name", axis.name}, {"unit", axis.unit}, {"mapping", axis.mapping.id}};
    json["parameters"] = Json::object();
    for (const auto& [name, value] : axis.mapping.parameters)
        json["parameters"][name] = value;
    json["nodes"] = axis.nodes;
    return json;
}

Json tableJson(const Table& table)
{
    Json json{{"name", table.name}, {"file", table.file}, {"quantity", table.quantity}, {"unit", table.unit}};
    json["channels"] = channelsWord(table.channels);
    json["channelNames"] = table.channelNames;
    if (!table.wavelengthsNm.empty())
        json["wavelengthsNm"] = table.wavelengthsNm;
    json["signed"] = table.isSigned;
    json["significandBits"] = table.significandBits;
    json["storage"] = table.half ? "half" : "float";
    if (table.half)
        json["rowExponents"] = table.rowExponents;
    json["rowAxes"] = table.rowAxes;
    json["axes"] = Json::array();
    for (const Axis& axis : table.axes)
        json["axes"].push_back(axisJson(axis));
    return json;
}

} // namespace

std::string writeManifest(const Manifest& m)
{
    Json json;
    json["format"] = "sky model";
    json["formatVersion"] = formatVersion;
    json["generator"] = m.generator;
    json["name"] = m.name;
    json["planetRadius"] = m.planetRadius;
    json["topOfAtmosphere"] = m.topOfAtmosphere;
    json["sunAngularRadius"] = m.sunAngularRadius;
    json["sunDistance"] = m.sunDistance;
    json["moonDistance"] = m.moonDistance;
    json["moonRadius"] = m.moonRadius;
    json["wavelengthsNm"] = m.wavelengthsNm;
    json["solarIrradiance"] = m.solarIrradiance;
    json["groundAlbedo"] = m.groundAlbedo;
    json["lightPollutionRadiance"] = m.lightPollutionRadiance;
    json["scatteringOrders"] = m.scatteringOrders;
    json["allScatteringOrders"] = m.allScatteringOrders;
    json["species"] = Json::array();
    for (const SpeciesInfo& s : m.species)
        json["species"].push_back(Json{{"name", s.name},
                                       {"scatters", s.scatters},
                                       {"phaseFunctionType", s.phaseFunctionType},
                                       {"singleScatteringAlbedo", s.singleScatteringAlbedo},
                                       {"extinctionCrossSection", s.extinctionCrossSection}});
    json["skipped"] = Json::array();
    for (const Skipped& s : m.skipped)
        json["skipped"].push_back(Json{{"what", s.what}, {"why", s.why}});
    json["warnings"] = m.warnings;
    json["estimatedError"] = Json::object();
    for (const auto& [key, value] : m.estimatedError)
        json["estimatedError"][key] = value;
    json["settings"] = Json::object();
    for (const auto& [key, value] : m.settings)
        json["settings"][key] = value;
    json["tables"] = Json::array();
    for (const Table& table : m.tables)
        json["tables"].push_back(tableJson(table));
    json["files"] = Json::object();
    for (const auto& [file, info] : m.files)
        json["files"][file] = Json{{"bytes", info.bytes}, {"xxh3-128", info.xxh3}};
    std::string text;
    print(json, 0, text);
    return text + "\n";
}

bool isModelDirectory(const std::string& directory)
{
    std::ifstream file(directory + "/manifest.json", std::ios::binary);
    std::string start(64, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    return start.find("\"format\": \"sky model\"") != std::string::npos;
}

} // namespace sky::model
