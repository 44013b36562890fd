#pragma once
// Questions of `showmysky probe`: a CSV file, read with its words kept for the answer.

#include "showmysky/photometry.hpp"
#include <iosfwd>
#include <string>
#include <vector>

namespace showmysky::app {

struct ProbeQueries {
    std::string header;                  ///< the first line as it came
    std::vector<std::string> lines;      ///< the other lines as they came, without empty ones
    std::vector<Photometer::View> views; ///< of each line
    std::vector<Moon> moons;             ///< of each line; empty without the Moon's columns: no eclipse
    std::vector<std::string> complaints; ///< "file:line:column: what is wrong"; the first few
};

/// Reads queries: a header with the columns altitude_m, sun_zenith_deg, sun_azimuth_deg, view_zenith_deg, view_azimuth_deg in any
/// order, others beside them; then one query a line. With moon_zenith_deg, moon_azimuth_deg and earth_moon_distance_m they are about an
/// eclipse.
///   name    of the file, for messages
///   throws  sky::UsageError where the header is wrong
ProbeQueries readQueries(std::istream& stream, const std::string& name);

} // namespace showmysky::app
