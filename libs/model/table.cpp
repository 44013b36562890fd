#include "model/table.hpp"
#include "base/error.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>

namespace sky::model {

namespace {

constexpr std::int64_t maxSide = 1 << 24, maxChannels = 8192, maxValues = std::int64_t(1) << 36;

std::int64_t product(const std::vector<Axis>& axes, std::size_t first, std::size_t last)
{
    std::int64_t size = 1;
    for (std::size_t i = first; i < last && i < axes.size(); ++i) {
        size *= static_cast<std::int64_t>(axes[i].nodes.size());
        if (size > maxSide)
            return maxSide + 1; // too large in any case; stops before it overflows
    }
    return size;
}

// "391,333" with as many decimals as asked, trailing zeros cut; the layout wants a decimal comma.
std::string wavelengthText(double nm, int decimals)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, nm);
    std::string s = text;
    for (char& c : s)
        if (c == '.')
            c = ',';
    if (s.find(',') != std::string::npos) {
        s.erase(s.find_last_not_of('0') + 1);
        if (s.back() == ',')
            s.pop_back();
    }
    return s;
}

std::vector<std::string> spectralNames(const std::string& prefix, const std::vector<double>& wavelengthsNm)
{
    for (int decimals = 3;; decimals += 3) {
        std::vector<std::string> names;
        for (const double nm : wavelengthsNm)
            names.push_back(prefix + wavelengthText(nm, decimals) + "nm");
        if (decimals >= 12 || std::set<std::string>(names.begin(), names.end()).size() == names.size())
            return names;
    }
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

} // namespace

int TableSpec::rows() const { return static_cast<int>(product(axes, 0, static_cast<std::size_t>(rowAxes))); }

int TableSpec::columns() const { return static_cast<int>(product(axes, static_cast<std::size_t>(rowAxes), axes.size())); }

int TableSpec::channelCount() const
{
    switch (channels) {
    case Channels::Luminance: return 4;
    case Channels::Named: return static_cast<int>(channelNames.size());
    default: return static_cast<int>(wavelengthsNm.size());
    }
}

std::size_t Table::valueCount(int rowCount) const
{
    return static_cast<std::size_t>(rowCount) * static_cast<std::size_t>(columns()) * static_cast<std::size_t>(channelCount());
}

std::string Table::describeTexel(int row, int column) const
{
    std::string text;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const bool isRow = i < static_cast<std::size_t>(rowAxes);
        const std::size_t end = isRow ? static_cast<std::size_t>(rowAxes) : axes.size();
        const std::int64_t index = (isRow ? row : column) / product(axes, i + 1, end) % static_cast<std::int64_t>(axes[i].nodes.size());
        text += (i ? ", " : "") + axes[i].name + "[" + std::to_string(index) +
                "] = " + number(axes[i].nodes[static_cast<std::size_t>(index)]) + (axes[i].unit == "1" ? "" : " " + axes[i].unit);
    }
    return text;
}

std::vector<std::string> channelNamesOf(const TableSpec& spec)
{
    switch (spec.channels) {
    case Channels::SpectralRadiance: return spectralNames("S0.", spec.wavelengthsNm);
    case Channels::SpectralDimensionless: return spectralNames("T.", spec.wavelengthsNm);
    case Channels::Luminance: return {"X", "Y", "Z", "scotopic"};
    case Channels::Named: break;
    }
    return spec.channelNames;
}

std::string safeFileName(const std::string& name)
{
    std::string file;
    bool atStart = true; // of a path component, where a dot would hide it or leave the directory
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                           (c == '.' && !atStart) || (c == '/' && !atStart);
        if (plain)
            file += c;
        else {
            char code[4];
            std::snprintf(code, sizeof code, "_%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
            file += code;
        }
        atStart = c == '/';
    }
    return file + (atStart ? "_.exr" : ".exr");
}

bool isPlainRelativePath(const std::string& path)
{
    if (path.empty() || path.size() > 255 || path.back() == '/')
        return false;
    bool atStart = true;
    for (const char c : path) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
        if (atStart ? !letter : !letter && c != '.' && c != '/')
            return false;
        atStart = c == '/';
    }
    return true;
}

void validate(const TableSpec& spec)
{
    const auto require = [&](bool condition, const std::string& what) {
        if (!condition)
            throw RangeError("Table '" + spec.name + "': " + what + ".");
    };
    require(!spec.name.empty() && spec.name.size() <= 200, "its name must have 1 to 200 bytes");
    require(spec.file.empty() || isPlainRelativePath(spec.file),
            "its file '" + spec.file + "' must be a plain relative name inside the model");
    require(!spec.axes.empty() && spec.axes.size() <= 8, "1 to 8 axes are expected, not " + std::to_string(spec.axes.size()));
    require(spec.rowAxes >= 1 && spec.rowAxes <= static_cast<int>(spec.axes.size()),
            "rowAxes is " + std::to_string(spec.rowAxes) + ", expected 1 to the number of axes");
    for (const Axis& axis : spec.axes) {
        require(!axis.name.empty(), "an axis has no name");
        require(!axis.nodes.empty(), "axis '" + axis.name + "' has no nodes");
        for (const double node : axis.nodes)
            require(std::isfinite(node), "axis '" + axis.name + "' has a node that is not finite");
        for (const auto& [name, value] : axis.mapping.parameters)
            require(std::isfinite(value), "the parameter '" + name + "' of axis '" + axis.name + "' is not finite");
    }
    require(spec.rows() <= maxSide && spec.columns() <= maxSide, "more than 2^24 rows or columns");
    require(spec.significandBits >= 1 && spec.significandBits <= 24,
            "significandBits is " + std::to_string(spec.significandBits) + ", expected 1 to 24");
    const bool spectral = spec.channels == Channels::SpectralRadiance || spec.channels == Channels::SpectralDimensionless;
    for (const double nm : spec.wavelengthsNm)
        require(std::isfinite(nm) && nm > 0 && nm < 1e9, "a wavelength of " + number(nm) + " nm; 0 to 1e9 is expected");
    require(spectral || spec.wavelengthsNm.empty(), "only spectral tables have wavelengths");
    require(spec.channelCount() >= 1 && spec.channelCount() <= maxChannels,
            std::to_string(spec.channelCount()) + " channels; 1 to 8192 are expected");
    const auto names = channelNamesOf(spec);
    require(std::set<std::string>(names.begin(), names.end()).size() == names.size(), "two channels have the same name");
    for (const std::string& name : names)
        require(!name.empty() && name.size() <= 255 && name.find('\0') == std::string::npos, "a channel name must have 1 to 255 bytes");
    require(std::int64_t(spec.rows()) * spec.columns() * spec.channelCount() <= maxValues, "more than 2^36 values");
}

} // namespace sky::model
