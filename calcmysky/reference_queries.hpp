#pragma once
// Questions to the judge, read from a CSV file.

#include <istream>
#include <string>
#include <vector>

#include "montecarlo/reference.hpp"

namespace sky::cli {

/// Reads columns altitude_m, sza_deg, vza_deg, relaz_deg and lambda_nm, in any order and among others, so that a table of
/// results can be asked again.
///   wavelengthsNm  those of the medium; a row must name one of them within 0.01 nm
///   name           of the file, for messages
///   throws         UsageError: file:line: what is wrong, what was expected
std::vector<montecarlo::Query> readQueries(std::istream& file, const std::string& name,
                                           const std::vector<double>& wavelengthsNm);

} // namespace sky::cli
