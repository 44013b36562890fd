#include "montecarlo/reference.hpp"

#include <cstdio>
#include <numbers>
#include <ostream>

namespace sky::montecarlo
{

void writeCsv(std::ostream& out, const std::vector<Row>& rows, const std::vector<double>& wavelengthsNm)
{
    const auto degrees = [](double rad) { return rad * 180 / std::numbers::pi; };
    out << "atmosphere,orders,altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm,L1_per_sr,Lms_per_sr,Lms_stderr,L0_per_"
           "sr\n";
    for (const Row& row : rows) {
        const Query& q = row.query;
        const Result& r = row.result;
        out << row.atmosphere << ',' << (row.orders > 0 ? std::to_string(row.orders) : "all");
        char line[256];
        std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g,%.6g,%.3f,%.8e,%.8e,%.3e,%.8e\n", q.altitude,
                      degrees(q.sunZenithAngle), degrees(q.viewZenithAngle), degrees(q.relativeAzimuth),
                      wavelengthsNm[static_cast<std::size_t>(q.wavelength)], r.single, r.multiple, r.multipleStderr,
                      r.groundDirect);
        out << line;
    }
}

} // namespace sky::montecarlo
