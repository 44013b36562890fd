#include "physics/colour.hpp"
#include "sky_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace sky::physics {

namespace {

struct MatchingRow {
    double nm;
    std::array<double, 4> value; // x, y, z, V'
};

std::vector<MatchingRow> parseMatchingFunctions()
{
    std::vector<MatchingRow> rows;
    std::string_view text = data::source("cie-1931-xyz-and-scotopic.csv");
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (line.empty() || line[0] == '#')
            continue;
        std::array<double, 5> figures{};
        for (double& figure : figures) {
            const auto end = std::from_chars(line.data(), line.data() + line.size(), figure).ptr;
            line.remove_prefix(std::min(line.size(), static_cast<std::size_t>(end - line.data()) + 1));
        }
        rows.push_back({figures[0], {figures[1], figures[2], figures[3], figures[4]}});
    }
    return rows;
}

const std::vector<MatchingRow>& matchingTable()
{
    static const std::vector<MatchingRow> table = parseMatchingFunctions();
    return table;
}

// XYZ of a black body, to a common factor. Second radiation constant of ITS-90, as CIE 15 has it.
XYZ blackBody(double temperature)
{
    constexpr double c2 = 1.4388e7; // nm K
    XYZ sum{};
    for (const MatchingRow& row : matchingTable()) {
        // Relative to the value at 560 nm, so that nothing overflows at low temperatures.
        const double planck = std::pow(560 / row.nm, 5) * std::expm1(c2 / (560 * temperature)) / std::expm1(c2 / (row.nm * temperature));
        for (std::size_t i = 0; i < 3; ++i)
            sum[i] += planck * row.value[i];
    }
    return sum;
}

struct Uv {
    double u, v;
};

// CIE 1960; the caller has excluded black.
Uv uv(const XYZ& c)
{
    const double d = c[0] + 15 * c[1] + 3 * c[2];
    return {4 * c[0] / d, 6 * c[1] / d};
}

} // namespace

std::array<double, 4> matchingFunctions(double nm)
{
    const auto& table = matchingTable();
    if (!(nm >= table.front().nm && nm <= table.back().nm))
        return {};
    auto above = std::upper_bound(table.begin(), table.end(), nm, [](double x, const MatchingRow& row) { return x < row.nm; });
    if (above == table.end())
        --above;
    const MatchingRow &a = above[-1], &b = *above;
    const double t = (nm - a.nm) / (b.nm - a.nm);
    std::array<double, 4> value{};
    for (std::size_t i = 0; i < 4; ++i)
        value[i] = a.value[i] + t * (b.value[i] - a.value[i]);
    return value;
}

std::vector<std::array<double, 4>> luminanceWeights(const std::vector<double>& nm)
{
    constexpr std::array<double, 4> efficacy{photopicEfficacy, photopicEfficacy, photopicEfficacy, scotopicEfficacy};
    std::vector<std::array<double, 4>> weights(nm.size());
    if (nm.size() == 1) {
        const auto value = matchingFunctions(nm[0]);
        for (std::size_t c = 0; c < 4; ++c)
            weights[0][c] = efficacy[c] * value[c];
        return weights;
    }
    for (std::size_t i = 0; i + 1 < nm.size(); ++i) {
        // Between break points of both tables the integrand is a parabola: Simpson's rule is exact.
        std::vector<double> points{nm[i], nm[i + 1]};
        for (const MatchingRow& row : matchingTable())
            if (row.nm > nm[i] && row.nm < nm[i + 1])
                points.push_back(row.nm);
        std::sort(points.begin(), points.end());
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const double a = points[k], b = points[k + 1], middle = (a + b) / 2;
            // At the table's ends the functions jump to zero; the inner side is meant.
            if (b <= matchingTable().front().nm || a >= matchingTable().back().nm)
                continue;
            const std::array<std::array<double, 4>, 3> values{matchingFunctions(a), matchingFunctions(middle), matchingFunctions(b)};
            const std::array<double, 3> at{a, middle, b}, simpson{(b - a) / 6, (b - a) * 4 / 6, (b - a) / 6};
            for (std::size_t s = 0; s < 3; ++s) {
                const double t = (at[s] - nm[i]) / (nm[i + 1] - nm[i]);
                for (std::size_t c = 0; c < 4; ++c) {
                    weights[i][c] += efficacy[c] * simpson[s] * (1 - t) * values[s][c];
                    weights[i + 1][c] += efficacy[c] * simpson[s] * t * values[s][c];
                }
            }
        }
    }
    return weights;
}

std::optional<std::array<double, 2>> chromaticity(const XYZ& c)
{
    const double sum = c[0] + c[1] + c[2];
    if (!(sum > 0))
        return std::nullopt;
    return std::array{c[0] / sum, c[1] / sum};
}

std::optional<double> correlatedColourTemperature(const XYZ& colour)
{
    if (!chromaticity(colour) || !(colour[0] + 15 * colour[1] + 3 * colour[2] > 0))
        return std::nullopt;
    const Uv here = uv(colour);
    // Along the locus equal steps of the reciprocal temperature look about equally large.
    const auto distance = [&](double perMegakelvin) {
        const Uv there = uv(blackBody(1e6 / perMegakelvin));
        return std::hypot(here.u - there.u, here.v - there.v);
    };
    constexpr int steps = 100;
    constexpr double coolest = 1000, hottest = 1; // reciprocal megakelvin
    const auto node = [&](int i) { return hottest * std::pow(coolest / hottest, double(i) / steps); };
    int best = 0;
    double least = distance(node(0));
    for (int i = 1; i <= steps; ++i)
        if (const double d = distance(node(i)); d < least) {
            least = d;
            best = i;
        }
    if (best == 0 || best == steps || least > 0.05)
        return std::nullopt;
    double low = node(best - 1), high = node(best + 1);
    while (high - low > 1e-7 * high) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    return 2e6 / (low + high);
}

std::array<double, 3> linearSrgb(const XYZ& c)
{
    // Inverse of the matrix of the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) with white (0.3127, 0.3290).
    return {3.2409699419045226 * c[0] - 1.5373831775700940 * c[1] - 0.4986107602930034 * c[2],
            -0.9692436362808796 * c[0] + 1.8759675015077202 * c[1] + 0.0415550574071756 * c[2],
            0.0556300796969937 * c[0] - 0.2039769588889765 * c[1] + 1.0569715142428786 * c[2]};
}

double encodeSrgb(double linear)
{
    const double x = std::abs(linear);
    const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return std::copysign(y, linear);
}

double decodeSrgb(double encoded)
{
    const double y = std::abs(encoded);
    const double x = y <= 0.04045 ? y / 12.92 : std::pow((y + 0.055) / 1.055, 2.4);
    return std::copysign(x, encoded);
}

} // namespace sky::physics
