#include "reference_queries.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/error.hpp"

namespace sky::cli {

namespace {

constexpr std::array columnNames{"altitude_m", "sza_deg", "vza_deg", "relaz_deg", "lambda_nm"};
enum Column { Altitude, SunZenith, ViewZenith, Azimuth, Wavelength };

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

std::vector<montecarlo::Query> readQueries(std::istream& file, const std::string& name,
                                           const std::vector<double>& wavelengthsNm)
{
    constexpr double degree = std::numbers::pi / 180;
    std::string line;
    std::getline(file, line);
    const auto columns = columnsOf(cellsOf(line), name);
    std::vector<montecarlo::Query> queries;
    for (int number = 2; std::getline(file, line); ++number) {
        if (line.empty() || line == "\r")
            continue;
        const auto cells = cellsOf(line);
        const std::string place = name + ":" + std::to_string(number) + ": ";
        std::array<double, columnNames.size()> value{};
        for (std::size_t c = 0; c < value.size(); ++c) {
            const std::string cell = columns[c] < cells.size() ? cells[columns[c]] : "";
            const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value[c]);
            if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value[c]))
                throw UsageError(place + columnNames[c] + " is `" + cell + "`; expected a number.");
        }
        if (value[Altitude] < 0)
            throw UsageError(place + "altitude_m is negative; expected a camera above the ground.");
        queries.push_back({value[Altitude], value[SunZenith] * degree, value[ViewZenith] * degree, value[Azimuth] * degree,
                           wavelengthIndex(value[Wavelength], wavelengthsNm, place)});
    }
    return queries;
}

} // namespace sky::cli
