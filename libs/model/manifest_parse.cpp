// Everything here may come from a stranger: each entry is checked for type, size and range before it is used.
#include "base/error.hpp"
#include "model/manifest.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace sky::model {

namespace {

using Json = nlohmann::ordered_json;

constexpr int maxDepth = 16;
constexpr std::size_t maxItems = 1 << 20;

/// An entry of the manifest that knows its place, for messages.
class Entry
{
public:
    Entry(const Json& value, std::string place, std::string path) : value_(value), place_(std::move(place)), path_(std::move(path)) {}

    [[noreturn]] void fail(const std::string& what) const
    {
        throw ModelError(place_ + ": " + (path_.empty() ? "" : path_ + ": ") + what + ".");
    }

    [[noreturn]] void wrongType(const char* expected) const { fail(std::string("expected ") + expected + ", found " + value_.type_name()); }

    Entry operator[](const std::string& key) const
    {
        if (!value_.is_object())
            wrongType("an object");
        const auto found = value_.find(key);
        if (found == value_.end())
            fail("the entry '" + key + "' is missing");
        return {*found, place_, path_.empty() ? key : path_ + "." + key};
    }

    bool has(const std::string& key) const { return value_.is_object() && value_.contains(key); }

    template<typename Visitor>
    void forEach(Visitor visit) const
    {
        if (!value_.is_array())
            wrongType("an array");
        if (value_.size() > maxItems)
            fail("more than " + std::to_string(maxItems) + " items");
        for (std::size_t i = 0; i < value_.size(); ++i)
            visit(Entry(value_[i], place_, path_ + "[" + std::to_string(i) + "]"));
    }

    template<typename Visitor>
    void forEachMember(Visitor visit) const
    {
        if (!value_.is_object())
            wrongType("an object");
        for (auto item = value_.begin(); item != value_.end(); ++item)
            visit(item.key(), Entry(item.value(), place_, path_ + "." + item.key()));
    }

    double number() const
    {
        if (!value_.is_number())
            wrongType("a number");
        const double number = value_.get<double>();
        if (!std::isfinite(number))
            fail("the number is not finite");
        return number;
    }

    double number(double low, double high) const
    {
        const double x = number();
        if (!(x >= low && x <= high))
            fail("is " + Json(x).dump() + "; " + Json(low).dump() + " to " + Json(high).dump() + " is expected");
        return x;
    }

    long long integer(long long low, long long high) const
    {
        if (!value_.is_number_integer())
            wrongType("an integer");
        // An unsigned value above the signed range would wrap; go by the double first.
        const double rough = value_.get<double>();
        if (!(rough >= static_cast<double>(low) && rough <= static_cast<double>(high)))
            fail("is " + value_.dump() + "; " + std::to_string(low) + " to " + std::to_string(high) + " is expected");
        return value_.get<long long>();
    }

    bool boolean() const
    {
        if (!value_.is_boolean())
            wrongType("true or false");
        return value_.get<bool>();
    }

    std::string text(std::size_t limit = 65536) const
    {
        if (!value_.is_string())
            wrongType("a string");
        const auto& text = value_.get_ref<const std::string&>();
        if (text.size() > limit)
            fail("a text of more than " + std::to_string(limit) + " bytes");
        return text;
    }

    std::vector<double> numbers(double low = -1e300, double high = 1e300) const
    {
        std::vector<double> all;
        forEach([&](const Entry& item) { all.push_back(item.number(low, high)); });
        return all;
    }

    std::vector<std::string> texts() const
    {
        std::vector<std::string> all;
        forEach([&](const Entry& item) { all.push_back(item.text()); });
        return all;
    }

private:
    const Json& value_;
    std::string place_, path_;
};

std::vector<double> spectrum(const Entry& entry, std::size_t count, double high, bool mayBeEmpty = false)
{
    auto values = entry.numbers(0, high);
    if (values.size() != count && !(mayBeEmpty && values.empty()))
        entry.fail("has " + std::to_string(values.size()) + " values; one for each of the " + std::to_string(count) +
                   " wavelengths is expected");
    return values;
}

Channels channelsFromWord(const Entry& entry)
{
    const std::string word = entry.text();
    if (word == "spectral radiance")
        return Channels::SpectralRadiance;
    if (word == "spectral dimensionless")
        return Channels::SpectralDimensionless;
    if (word == "luminance")
        return Channels::Luminance;
    if (word == "named")
        return Channels::Named;
    entry.fail("is '" + word + "'; spectral radiance, spectral dimensionless, luminance or named is expected");
}

Axis parseAxis(const Entry& entry)
{
    Axis axis{entry["name"].text(), entry["unit"].text(), entry["nodes"].numbers()};
    axis.mapping.id = entry["mapping"].text();
    if (entry.has("parameters"))
        entry["parameters"].forEachMember(
            [&](const std::string& key, const Entry& value) { axis.mapping.parameters[key] = value.number(); });
    return axis;
}

Table parseTable(const Entry& entry)
{
    Table table;
    table.name = entry["name"].text();
    table.file = entry["file"].text();
    if (!isPlainRelativePath(table.file))
        entry["file"].fail("is '" + table.file + "'; a plain relative name inside the model is expected");
    table.quantity = entry["quantity"].text();
    table.unit = entry["unit"].text();
    table.channels = channelsFromWord(entry["channels"]);
    table.channelNames = entry["channelNames"].texts();
    if (entry.has("wavelengthsNm"))
        table.wavelengthsNm = entry["wavelengthsNm"].numbers();
    table.isSigned = entry["signed"].boolean();
    table.significandBits = static_cast<int>(entry["significandBits"].integer(1, 24));
    table.rowAxes = static_cast<int>(entry["rowAxes"].integer(1, 8));
    entry["axes"].forEach([&](const Entry& axis) { table.axes.push_back(parseAxis(axis)); });
    try {
        validate(table);
    } catch (const RangeError& error) {
        entry.fail(std::string(error.what()).substr(0, std::string(error.what()).size() - 1));
    }
    if (table.channelNames != channelNamesOf(table))
        entry["channelNames"].fail("does not agree with the kind of channels and the wavelengths");

    const std::string storage = entry["storage"].text();
    if (storage != "half" && storage != "float")
        entry["storage"].fail("is '" + storage + "'; half or float is expected");
    table.half = storage == "half";
    if (table.half) {
        entry["rowExponents"].forEach([&](const Entry& e) { table.rowExponents.push_back(static_cast<int>(e.integer(-300, 300))); });
        if (table.rowExponents.size() != static_cast<std::size_t>(table.rows()))
            entry["rowExponents"].fail("has " + std::to_string(table.rowExponents.size()) + " values; one for each of the " +
                                       std::to_string(table.rows()) + " rows is expected");
    }
    return table;
}

FileInfo parseFile(const std::string& name, const Entry& entry)
{
    if (!isPlainRelativePath(name))
        entry.fail("the file name '" + name + "' is not a plain relative name inside the model");
    FileInfo info{static_cast<std::uint64_t>(entry["bytes"].integer(0, 1LL << 50)), entry["xxh3-128"].text()};
    if (info.xxh3.size() != 32 || info.xxh3.find_first_not_of("0123456789abcdef") != std::string::npos)
        entry["xxh3-128"].fail("32 hexadecimal digits in lower case are expected");
    return info;
}

SpeciesInfo parseSpecies(const Entry& entry, std::size_t wavelengths)
{
    SpeciesInfo species;
    species.name = entry["name"].text(200);
    species.scatters = entry["scatters"].boolean();
    species.phaseFunctionType = entry["phaseFunctionType"].text();
    static const std::set<std::string> known{"general", "achromatic", "smooth", "none"};
    if (!known.contains(species.phaseFunctionType))
        entry["phaseFunctionType"].fail("is '" + species.phaseFunctionType + "'; general, achromatic, smooth or none is expected");
    species.singleScatteringAlbedo = spectrum(entry["singleScatteringAlbedo"], wavelengths, 1);
    species.extinctionCrossSection = spectrum(entry["extinctionCrossSection"], wavelengths, 1e300);
    return species;
}

Json parseJson(const std::string& text, const std::string& place)
{
    bool tooDeep = false;
    const auto watchDepth = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > maxDepth)
            tooDeep = true;
        return !tooDeep;
    };
    try {
        Json json = Json::parse(text, watchDepth);
        if (tooDeep)
            throw ModelError(place + ": more than " + std::to_string(maxDepth) + " nested levels.");
        return json;
    } catch (const Json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line ..." without the library's own tag.
        std::string what = error.what();
        if (const auto end = what.find("] "); end != std::string::npos)
            what.erase(0, end + 2);
        throw ModelError(place + ": not valid JSON: " + what + ".");
    }
}

} // namespace

Manifest parseManifest(const std::string& text, const std::string& place)
{
    const Json json = parseJson(text, place);
    const Entry root(json, place, "");
    if (!json.is_object() || !root.has("format") || json["format"] != "sky model")
        root.fail("this is not the manifest of a sky model; an object with \"format\": \"sky model\" is expected");
    const long long version = root["formatVersion"].integer(1, 1000000);
    if (version != formatVersion)
        root.fail("the model has format version " + std::to_string(version) + ", this program reads version " +
                  std::to_string(formatVersion) + "; compute the model again, or use the program that made it");

    Manifest m;
    m.generator = root["generator"].text();
    m.name = root["name"].text();
    m.planetRadius = root["planetRadius"].number(1e-3, 1e20);
    m.topOfAtmosphere = root["topOfAtmosphere"].number(1e-6, 1e20);
    m.sunAngularRadius = root["sunAngularRadius"].number(0, 1.6);
    m.sunDistance = root["sunDistance"].number(0, 1e32);
    m.moonDistance = root["moonDistance"].number(0, 1e32);
    m.moonRadius = root["moonRadius"].number(0, 1e32);
    m.wavelengthsNm = root["wavelengthsNm"].numbers(1e-6, 1e9);
    if (m.wavelengthsNm.empty() || m.wavelengthsNm.size() > 8192)
        root["wavelengthsNm"].fail("has " + std::to_string(m.wavelengthsNm.size()) + " values; 1 to 8192 are expected");
    for (std::size_t i = 1; i < m.wavelengthsNm.size(); ++i)
        if (m.wavelengthsNm[i] <= m.wavelengthsNm[i - 1])
            root["wavelengthsNm"].fail("must increase from value to value");
    const std::size_t count = m.wavelengthsNm.size();
    m.solarIrradiance = spectrum(root["solarIrradiance"], count, 1e300);
    m.groundAlbedo = spectrum(root["groundAlbedo"], count, 1);
    m.lightPollutionRadiance = spectrum(root["lightPollutionRadiance"], count, 1e300, true);
    m.scatteringOrders = static_cast<int>(root["scatteringOrders"].integer(0, 1000000));
    m.allScatteringOrders = root["allScatteringOrders"].boolean();
    root["species"].forEach([&](const Entry& s) { m.species.push_back(parseSpecies(s, count)); });
    root["skipped"].forEach([&](const Entry& s) { m.skipped.push_back({s["what"].text(), s["why"].text()}); });
    m.warnings = root["warnings"].texts();
    root["estimatedError"].forEachMember([&](const std::string& key, const Entry& value) { m.estimatedError[key] = value.number(); });
    root["settings"].forEachMember([&](const std::string& key, const Entry& value) { m.settings[key] = value.text(); });

    root["files"].forEachMember([&](const std::string& key, const Entry& value) { m.files[key] = parseFile(key, value); });
    std::set<std::string> names;
    root["tables"].forEach([&](const Entry& entry) {
        m.tables.push_back(parseTable(entry));
        const Table& table = m.tables.back();
        if (!names.insert(table.name).second)
            entry["name"].fail("two tables are called '" + table.name + "'");
        if (!m.files.contains(table.file))
            entry["file"].fail("the file '" + table.file + "' of table '" + table.name + "' is not listed under files");
    });
    return m;
}

} // namespace sky::model
