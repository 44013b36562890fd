#include "verify_report.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

#include "base/angles.hpp"
#include "base/error.hpp"
#include "model/error_summary.hpp"
#include "values.hpp"
#include "verify_judge.hpp"

namespace sky::cli {

namespace {

using base::degree;

/// The errors of one regime, at one altitude or (altitudeIndex < 0) at all.
struct Cell {
    Regime regime;
    int altitudeIndex;
    model::ErrorSummary total, single;
};

Cell cellOf(const Verification& v, const Regime regime, const int altitudeIndex)
{
    Cell cell{regime, altitudeIndex, {}, {}};
    for (const VerifiedRow& row : v.rows)
        if (row.sample.regime == regime && (altitudeIndex < 0 || row.sample.altitudeIndex == altitudeIndex)) {
            cell.total.add(row.error(), relativeNoise(row.judged));
            cell.single.add(row.singleError(), row.judged.singleStderr / row.judged.total());
        }
    return cell;
}

std::vector<Cell> cellsOf(const Verification& v)
{
    std::vector<Cell> cells;
    for (const Regime regime : allRegimes)
        for (int a = 0; a < static_cast<int>(v.scale.altitudes.size()); ++a)
            cells.push_back(cellOf(v, regime, a));
    return cells;
}

/// `value` with so many digits, right-aligned.
std::string number(const double value, const int width, const int digits, const bool sign = false)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << std::setw(width);
    if (sign)
        text << std::showpos;
    text << value;
    return text.str();
}

std::string altitudeText(const double altitude)
{
    return altitude < 1000 ? number(altitude, 8, 0) + " m " : number(altitude / 1000, 8, 1) + " km";
}

std::string percent(const double share, const int width, const bool sign = false) { return number(100 * share, width, 2, sign) + " %"; }

std::string numbersOf(const Cell& cell)
{
    const auto& t = cell.total;
    const std::string rows = number(t.rows(), 4, 0);
    if (t.rows() == 0)
        return rows + "   nothing to compare";
    return rows + percent(t.rms(), 10) + percent(t.uncertainty(), 8) + percent(t.mean(), 10, true) + percent(t.noise(), 10) +
           percent(cell.single.rms(), 9) + percent(t.worst(), 10);
}

nlohmann::json jsonOf(const Cell& cell)
{
    const auto& t = cell.total;
    return {{"rows", t.rows()},        {"rms_error", t.rms()},     {"rms_uncertainty", t.uncertainty()},
            {"mean_error", t.mean()},  {"judge_noise", t.noise()}, {"rms_single_error", cell.single.rms()},
            {"worst_error", t.worst()}};
}

} // namespace

void printTable(const Verification& v, std::ostream& to)
{
    to << v.directory << ": " << v.source << " against Monte Carlo, "
       << (v.orders > 0 ? "orders 1 to " + std::to_string(v.orders) : "all orders") << ", " << formatDuration(v.seconds)
       << "\nError of single + multiple scattering, the noise of the judge removed; elevation of the Sun in degrees.\n\n"
          "Sun                       altitude   rows   rms error     +/-     mean error    noise   of single   worst row\n";
    for (const Regime regime : allRegimes) {
        const auto& range = v.scale.suns[static_cast<int>(regime)];
        const std::string name = nameOf(regime);
        const std::string sun =
            name + std::string(8 - name.size(), ' ') + number(range.high / degree, 6, 1) + " to" + number(range.low / degree, 6, 1);
        const int fromSpace = static_cast<int>(v.scale.altitudes.size()) - 1;
        for (int a = 0; a <= fromSpace; ++a) {
            const std::string altitude = a < fromSpace ? altitudeText(v.scale.altitudes[static_cast<std::size_t>(a)]) : " from space";
            to << sun << altitude << "   " << numbersOf(cellOf(v, regime, a)) << "\n";
        }
        to << sun << "        all   " << numbersOf(cellOf(v, regime, -1)) << "\n";
    }
    if (v.darkRows > 0)
        to << "\nAll but without light in the reference, and left out: " << v.darkRows << " samples.\n";
    if (v.unsureRows > 0)
        to << "\nThe reference stayed above " << number(100 * unsureNoise, 0, 0) << " % noise, and was not used: " << v.unsureRows
           << " samples. Give it more --seconds.\n";
    to << std::flush;
}

void writeJson(const Verification& v, std::ostream& to)
{
    nlohmann::json json;
    json["model"] = v.directory;
    json["source"] = v.source;
    json["orders"] = v.orders > 0 ? nlohmann::json(v.orders) : nlohmann::json("all");
    json["seconds"] = v.seconds;
    json["dark_samples"] = v.darkRows;
    json["unsure_samples"] = v.unsureRows;
    for (const Regime regime : allRegimes) {
        const auto& range = v.scale.suns[static_cast<int>(regime)];
        nlohmann::json& part = json["regimes"][nameOf(regime)];
        part = jsonOf(cellOf(v, regime, -1));
        part["sun_elevation_deg"] = {range.low / degree, range.high / degree};
    }
    for (const Cell& cell : cellsOf(v)) {
        nlohmann::json part = jsonOf(cell);
        part["regime"] = nameOf(cell.regime);
        part["altitude_m"] = v.scale.altitudes[static_cast<std::size_t>(cell.altitudeIndex)];
        json["cells"].push_back(part);
    }
    for (const VerifiedRow& row : v.rows) {
        const montecarlo::Query& q = row.sample.query;
        json["rows"].push_back({{"regime", nameOf(row.sample.regime)},
                                {"altitude_m", q.altitude},
                                {"sza_deg", q.sunZenithAngle / degree},
                                {"vza_deg", q.viewZenithAngle / degree},
                                {"relaz_deg", q.relativeAzimuth / degree},
                                {"lambda_nm", row.wavelengthNm},
                                {"model_single", row.modelSingle},
                                {"model_multiple", row.modelMultiple},
                                {"reference_single", row.judged.single},
                                {"reference_multiple", row.judged.multiple},
                                {"reference_stderr", row.judged.multipleStderr},
                                {"error", row.error()}});
    }
    to << json.dump(1) << "\n";
}

double largestError(const Verification& v)
{
    if (v.rows.empty())
        throw NumericsError("No sample of " + v.directory + " could be judged, so nothing is known of its error: " + std::to_string(v.darkRows) +
                            " are all but without light, and of " + std::to_string(v.unsureRows) +
                            " the reference stayed unsure. Give it more --seconds.");
    double largest = 0;
    for (const Cell& cell : cellsOf(v))
        largest = std::max(largest, cell.total.rms());
    return largest;
}

} // namespace sky::cli
