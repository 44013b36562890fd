#include "reference_table.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sky::bench {

namespace {
using sky::base::degree;
using sky::base::pi;
constexpr double usableNoise = 0.05;

/// std::stod throws at radiances below the smallest normal number, which opaque air has.
double number(const std::string& text)
{
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str())
        throw FileError("\"" + text + "\" is no number.");
    return value;
}
} // namespace

std::vector<ReferenceRow> readReference(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
        throw FileError("Can't read \"" + path + "\".");
    std::string line;
    std::getline(file, line);
    std::vector<ReferenceRow> rows;
    while (std::getline(file, line)) {
        std::vector<std::string> c;
        std::stringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            c.push_back(cell);
        if (c.size() < 11)
            throw FileError("\"" + path + "\": expected 11 columns in \"" + line + "\".");
        const ReferenceRow row{{number(c[2]), number(c[3]) * degree, number(c[4]) * degree, number(c[5]) * degree},
                               number(c[6]),
                               number(c[7]) + number(c[8]),
                               number(c[9])};
        if (row.noise <= usableNoise * row.radiance)
            rows.push_back(row);
    }
    return rows;
}

int regimeOf(const ReferenceRow& row, const cli::SampleScale& scale)
{
    constexpr double slack = 0.1 * degree; // tables hold whole degrees, and the scale is not exactly that of the Earth
    const double elevation = pi / 2 - row.geometry.sunZenithAngle + slack;
    return elevation >= scale.suns[0].low ? 0 : elevation >= scale.suns[1].low ? 1 : 2;
}

bool isHigh(const ReferenceRow& row, const cli::SampleScale& scale) { return row.geometry.altitude >= 0.8 * scale.altitudes[2]; }

int wavelengthIndex(const ReferenceRow& row, const std::vector<double>& wavelengthsNm)
{
    for (std::size_t w = 0; w < wavelengthsNm.size(); ++w)
        if (std::abs(wavelengthsNm[w] - row.wavelengthNm) < 0.01)
            return static_cast<int>(w);
    return -1;
}

} // namespace sky::bench
