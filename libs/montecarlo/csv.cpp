#include "montecarlo/reference.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <ostream>

namespace sky::montecarlo {

void writeCsv(std::ostream& out, const std::vector<Row>& rows, const std::vector<double>& wavelengthsNm)
{
    const auto degrees = [](double rad) { return rad * 180 / std::numbers::pi; };
    const bool eclipse = std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.query.moon.has_value(); });
    out << "atmosphere,orders,altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm,L1_per_sr,Lms_per_sr,Lms_stderr,L0_per_sr"
        << (eclipse ? ",moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m\n" : "\n");
    for (const Row& row : rows) {
        const Query& q = row.query;
        const Result& r = row.result;
        out << row.atmosphere << ',' << (row.orders > 0 ? std::to_string(row.orders) : "all");
        char line[256];
        std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g,%.6g,%.3f,%.8e,%.8e,%.3e,%.8e", q.altitude, degrees(q.sunZenithAngle),
                      degrees(q.viewZenithAngle), degrees(q.relativeAzimuth), wavelengthsNm[static_cast<std::size_t>(q.wavelength)],
                      r.single, r.multiple, r.multipleStderr, r.groundDirect);
        out << line;
        if (eclipse && q.moon) {
            std::snprintf(line, sizeof line, ",%.9g,%.9g,%.10g", degrees(q.moon->zenithAngle), degrees(q.moon->relativeAzimuth),
                          q.moon->distance);
            out << line;
        } else if (eclipse) {
            out << ",,,";
        }
        out << '\n';
    }
}

} // namespace sky::montecarlo
