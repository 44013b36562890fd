#include "reference_queries.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/angles.hpp"
#include "base/error.hpp"

namespace sky::cli {

namespace {

constexpr std::array columnNames{"altitude_m", "sza_deg", "vza_deg", "relaz_deg", "lambda_nm"};
enum Column { Altitude, SunZenith, ViewZenith, Azimuth, Wavelength };
constexpr std::array moonColumnNames{"moon_zenith_deg", "moon_azimuth_deg", "earth_moon_distance_m"};
enum MoonColumn { MoonZenith, MoonAzimuth, MoonDistance };

std::vector<std::string> cellsOf(std::string line)
{
    if (!line.empty() && line.back() == '\r')
        line.pop_back();
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
        cells.push_back(cell);
    return cells;
}

/// Position of each of columnNames in the first line.
std::array<std::size_t, columnNames.size()> columnsOf(const std::vector<std::string>& header, const std::string& name)
{
    std::array<std::size_t, columnNames.size()> columns{};
    for (std::size_t c = 0; c < columns.size(); ++c) {
        while (columns[c] < header.size() && header[columns[c]] != columnNames[c])
            ++columns[c];
        if (columns[c] == header.size())
            throw UsageError(name + ":1: there is no column `" + columnNames[c] +
                             "`; expected altitude_m, sza_deg, vza_deg, relaz_deg and lambda_nm, separated by commas.");
    }
    return columns;
}

/// Position of each of moonColumnNames, or nothing if there is none of them.
std::optional<std::array<std::size_t, moonColumnNames.size()>> moonColumnsOf(const std::vector<std::string>& header,
                                                                             const std::string& name)
{
    std::array<std::size_t, moonColumnNames.size()> columns{};
    std::size_t found = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        columns[c] = static_cast<std::size_t>(std::find(header.begin(), header.end(), moonColumnNames[c]) - header.begin());
        found += columns[c] < header.size();
    }
    if (found == 0)
        return std::nullopt;
    if (found < columns.size())
        throw UsageError(name + ":1: an eclipse needs all of moon_zenith_deg, moon_azimuth_deg and earth_moon_distance_m.");
    return columns;
}

double numberIn(const std::vector<std::string>& cells, const std::size_t column, const std::string& columnName, const std::string& place)
{
    const std::string cell = column < cells.size() ? cells[column] : "";
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        throw UsageError(place + columnName + " is `" + cell + "`; expected a number.");
    return value;
}

int wavelengthIndex(const double wavelengthNm, const std::vector<double>& wavelengthsNm, const std::string& place)
{
    constexpr double same = 0.01; // nm
    std::string known;
    for (std::size_t w = 0; w < wavelengthsNm.size(); ++w) {
        if (std::abs(wavelengthsNm[w] - wavelengthNm) < same)
            return static_cast<int>(w);
        std::ostringstream text;
        text << wavelengthsNm[w];
        known += (known.empty() ? "" : ", ") + text.str();
    }
    throw UsageError(place + "lambda_nm is no wavelength of this atmosphere; expected one of " + known + ".");
}

} // namespace

std::vector<montecarlo::Query> readQueries(std::istream& file, const std::string& name, const std::vector<double>& wavelengthsNm,
                                           const EclipseScale& scale)
{
    using base::degree;
    std::string line;
    std::getline(file, line);
    const auto header = cellsOf(line);
    const auto columns = columnsOf(header, name);
    const auto moonColumns = moonColumnsOf(header, name);
    std::vector<montecarlo::Query> queries;
    for (int number = 2; std::getline(file, line); ++number) {
        if (line.empty() || line == "\r")
            continue;
        const auto cells = cellsOf(line);
        const std::string place = name + ":" + std::to_string(number) + ": ";
        std::array<double, columnNames.size()> value{};
        for (std::size_t c = 0; c < value.size(); ++c)
            value[c] = numberIn(cells, columns[c], columnNames[c], place);
        if (value[Altitude] < 0)
            throw UsageError(place + "altitude_m is negative; expected a camera above the ground.");
        queries.push_back({value[Altitude], value[SunZenith] * degree, value[ViewZenith] * degree, value[Azimuth] * degree,
                           wavelengthIndex(value[Wavelength], wavelengthsNm, place)});
        if (!moonColumns)
            continue;
        std::array<double, moonColumnNames.size()> moon{};
        std::size_t empty = 0;
        for (const std::size_t column : *moonColumns)
            empty += column >= cells.size() || cells[column].empty();
        if (empty == moon.size())
            continue;
        for (std::size_t c = 0; c < moon.size(); ++c)
            moon[c] = numberIn(cells, (*moonColumns)[c], moonColumnNames[c], place);
        queries.back().moon = montecarlo::MoonPlace{moon[MoonZenith] * degree, moon[MoonAzimuth] * degree, moon[MoonDistance],
                                                    scale.moonRadius, scale.sunDistance};
    }
    return queries;
}

} // namespace sky::cli
