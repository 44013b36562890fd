#include "probe_queries.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/suggest.hpp"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <istream>

namespace showmysky::app {

namespace {

using sky::base::degree;
constexpr std::size_t complaintsAtMost = 20;

struct Cell {
    std::string text;
    int column; ///< in characters, from 1
};

/// Cells of a line; quotes as RFC 4180 has them. Spaces around a cell don't count.
std::vector<Cell> cellsOf(const std::string& line)
{
    std::vector<Cell> cells;
    Cell cell{{}, 1};
    bool quoted = false;
    int column = 1;
    const auto finish = [&] {
        const auto from = cell.text.find_first_not_of(" \t"), to = cell.text.find_last_not_of(" \t");
        if (from != std::string::npos)
            cell.column += static_cast<int>(from);
        cell.text = from == std::string::npos ? "" : cell.text.substr(from, to - from + 1);
        cells.push_back(cell);
    };
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            finish();
            cell = {{}, column + 1};
        } else {
            cell.text += c;
        }
        if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) // not inside a UTF-8 character
            ++column;
    }
    finish();
    return cells;
}

/// A question as a line asks it.
struct Query {
    Photometer::View view;
    Moon moon;
};

struct Field {
    const char* name;
    double low, high, unit;
    const char* range;
    double& (*target)(Query&);
};

constexpr std::array<Field, 5> fields{{
    {"altitude_m", 0, 1e15, 1, "0 or more", [](Query& q) -> double& { return q.view.altitude; }},
    {"sun_zenith_deg", 0, 180, degree, "0 to 180", [](Query& q) -> double& { return q.view.sunZenithAngle; }},
    {"sun_azimuth_deg", -1e6, 1e6, degree, "a finite angle", [](Query& q) -> double& { return q.view.sunAzimuth; }},
    {"view_zenith_deg", 0, 180, degree, "0 to 180", [](Query& q) -> double& { return q.view.viewZenithAngle; }},
    {"view_azimuth_deg", -1e6, 1e6, degree, "a finite angle", [](Query& q) -> double& { return q.view.viewAzimuth; }},
}};
constexpr std::array<Field, 3> moonFields{{
    {"moon_zenith_deg", 0, 180, degree, "0 to 180", [](Query& q) -> double& { return q.moon.zenithAngle; }},
    {"moon_azimuth_deg", -1e6, 1e6, degree, "a finite angle", [](Query& q) -> double& { return q.moon.azimuth; }},
    {"earth_moon_distance_m", 1, 1e32, 1, "a length above 0", [](Query& q) -> double& { return q.moon.distance; }},
}};

/// Where a field stands in the lines.
struct Column {
    const Field* field;
    std::size_t index;
};

std::vector<Column> findColumns(const std::vector<Cell>& header, const std::string& name)
{
    std::vector<std::string> names;
    for (const auto& cell : header)
        names.push_back(cell.text);
    for (std::size_t i = 0; i < names.size(); ++i)
        if (std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]))
            throw sky::UsageError(name + ":1:" + std::to_string(header[i].column) + ": the column `" + names[i] + "` is there twice.");
    std::vector<Column> result;
    const auto find = [&](const Field& field, const std::string& expected) {
        const auto found = std::find(names.begin(), names.end(), field.name);
        if (found == names.end())
            throw sky::UsageError(name + ":1:1: the column `" + field.name + "` is missing; expected " + expected + "." +
                                  sky::suggestion(field.name, names));
        result.push_back({&field, static_cast<std::size_t>(found - names.begin())});
    };
    for (const auto& field : fields)
        find(field, "altitude_m, sun_zenith_deg, sun_azimuth_deg, view_zenith_deg and view_azimuth_deg");
    const auto given = [&](const Field& field) { return std::find(names.begin(), names.end(), field.name) != names.end(); };
    if (std::any_of(moonFields.begin(), moonFields.end(), given))
        for (const auto& field : moonFields)
            find(field, "all of moon_zenith_deg, moon_azimuth_deg and earth_moon_distance_m for an eclipse");
    return result;
}

/// The number in a cell; says what is wrong with it.
bool parse(const Cell& cell, const Field& field, double& value, std::string& problem)
{
    const char *first = cell.text.data(), *last = first + cell.text.size();
    if (first != last && *first == '+')
        ++first;
    const auto [end, code] = std::from_chars(first, last, value);
    if (cell.text.empty())
        problem = "is empty";
    else if (code != std::errc{} || end != last || !std::isfinite(value))
        problem = "is \"" + cell.text + "\", which is not a number";
    else if (value < field.low || value > field.high)
        problem = "is " + cell.text;
    else
        return true;
    problem = std::string(field.name) + " " + problem + "; expected " + field.range + ".";
    return false;
}

} // namespace

ProbeQueries readQueries(std::istream& stream, const std::string& name)
{
    ProbeQueries queries;
    const auto next = [&](std::string& line) {
        if (!std::getline(stream, line))
            return false;
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        return true;
    };
    if (!next(queries.header) || queries.header.empty())
        throw sky::UsageError(name + ":1:1: the file is empty; expected a header that names the columns.");
    if (queries.header.starts_with("\xEF\xBB\xBF")) // byte order mark
        queries.header.erase(0, 3);
    const auto header = cellsOf(queries.header);
    const auto columns = findColumns(header, name);
    std::string line, problem;
    for (int number = 2; next(line); ++number) {
        if (line.find_first_not_of(" \t") == std::string::npos)
            continue;
        const auto complain = [&](int column, const std::string& what) {
            if (queries.complaints.size() < complaintsAtMost)
                queries.complaints.push_back(name + ":" + std::to_string(number) + ":" + std::to_string(column) + ": " + what);
        };
        const auto cells = cellsOf(line);
        Query query;
        if (cells.size() != header.size()) {
            complain(cells.size() > header.size() ? cells[header.size()].column : cells.back().column,
                     "the line has " + std::to_string(cells.size()) + " cells; the header has " + std::to_string(header.size()) + ".");
            continue;
        }
        for (const auto& [field, index] : columns) {
            double value = 0;
            if (parse(cells[index], *field, value, problem))
                field->target(query) = value * field->unit;
            else
                complain(cells[index].column, problem);
        }
        queries.lines.push_back(line);
        queries.views.push_back(query.view);
        if (columns.size() > fields.size())
            queries.moons.push_back(query.moon);
    }
    return queries;
}

} // namespace showmysky::app
