#pragma once
// Questions to the judge, read from a CSV file.

#include <istream>
#include <string>
#include <vector>

#include "montecarlo/reference.hpp"

namespace sky::cli {

/// What an eclipse needs of the atmosphere: m.
struct EclipseScale {
    double moonRadius = 0, sunDistance = 0;
};

/// Reads columns altitude_m, sza_deg, vza_deg, relaz_deg and lambda_nm, in any order and among others, so that a table of
/// results can be asked again. With moon_zenith_deg, moon_azimuth_deg (from the Sun's, as relaz_deg) and earth_moon_distance_m the
/// Moon takes part; rows where all three are empty have none.
///   wavelengthsNm  those of the medium; a row must name one of them within 0.01 nm
///   name           of the file, for messages
///   throws         UsageError: file:line: what is wrong, what was expected
std::vector<montecarlo::Query> readQueries(std::istream& file, const std::string& name, const std::vector<double>& wavelengthsNm,
                                           const EclipseScale& scale);

} // namespace sky::cli
