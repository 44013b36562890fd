#include "reference_table.hpp"
#include "base/error.hpp"
#include <cmath>
#include <fstream>
#include <sstream>

namespace sky::bench {

namespace {
constexpr double degree = 3.14159265358979323846 / 180;
}

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
        rows.push_back({{std::stod(c[2]), std::stod(c[3]) * degree, std::stod(c[4]) * degree, std::stod(c[5]) * degree},
                        std::stod(c[6]), std::stod(c[7]) + std::stod(c[8]), std::stod(c[9])});
    }
    return rows;
}

int regimeOf(const ReferenceRow& row)
{
    const double sun = row.geometry.sunZenithAngle / degree;
    return sun <= 86.01 ? 0 : sun <= 91.01 ? 1 : 2;
}

int wavelengthIndex(const ReferenceRow& row, const std::vector<double>& wavelengthsNm)
{
    for (std::size_t w = 0; w < wavelengthsNm.size(); ++w)
        if (std::abs(wavelengthsNm[w] - row.wavelengthNm) < 0.01)
            return static_cast<int>(w);
    return -1;
}

} // namespace sky::bench
