#pragma once
// The Monte Carlo tables of tests/reference, whose README says what they hold.

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sky::test {

struct ReferenceRow {
    double altitude = 0, sza = 0, vza = 0, azimuth = 0; ///< m, degrees
    int wavelength = 0;                                 ///< index into sampleEarth's
    double single = 0, multiple = 0, standardError = 0; ///< sr^-1
    double mu = 0, muSun = 0;

    double nu() const
    {
        return mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(azimuth * 3.14159265358979323846 / 180);
    }
};

inline std::vector<ReferenceRow> referenceTable(const std::string& name)
{
    std::ifstream file(std::string(SKY_SOURCE_DIR) + "/tests/reference/" + name);
    std::string line, cell;
    if (!std::getline(file, line))
        throw std::runtime_error("tests/reference/" + name + " can't be read");
    std::vector<ReferenceRow> rows;
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::vector<double> v;
        std::getline(cells, cell, ','); // atmosphere
        std::getline(cells, cell, ','); // orders
        while (std::getline(cells, cell, ','))
            v.push_back(std::stod(cell));
        const double degree = 3.14159265358979323846 / 180;
        rows.push_back({v.at(0), v.at(1), v.at(2), v.at(3), static_cast<int>(std::lround((v.at(4) - 391.333) / 94)), v.at(5), v.at(6),
                        v.at(7), std::cos(v[2] * degree), std::cos(v[1] * degree)});
    }
    return rows;
}

} // namespace sky::test
