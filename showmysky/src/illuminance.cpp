#include "illuminance.hpp"
#include "base/angles.hpp"

#include <algorithm>
#include <cmath>

namespace showmysky {

namespace {

using sky::base::pi;
/// Angles from the Sun, dense near it as cubes, and directions around it.
constexpr int angles = 160, turns = 96;

} // namespace

Texel skyIlluminance(const SkyView& view, const SkyAxes& axes, const Phases& phases)
{
    std::vector<ViewTable> tables{view.whole};
    tables.insert(tables.end(), view.scattered.begin(), view.scattered.end());
    if (!view.eclipse)
        for (ViewTable& table : tables)
            table = resampled(table, drawnHalfViews, drawnAzimuths);
    const double sine = std::sin(axes.sunElevation), cosine = std::cos(axes.sunElevation);
    std::array<double, 4> sum{};
    std::vector<float> phase(tables.size(), 1.f);
    for (int k = 0; k < angles; ++k) {
        const double u = (k + 0.5) / angles, theta = pi * u * u * u;
        const double solidAngle = 3 * pi * u * u / angles * std::sin(theta) * 2 * pi / turns;
        for (std::size_t i = 1; i < tables.size(); ++i)
            if (!tables[i].empty())
                phase[i] = static_cast<float>(phases.drawn(static_cast<int>(i) - 1, std::cos(theta)));
        for (int t = 0; t < turns; ++t) {
            // Towards the Sun's azimuth, to its side, and up.
            const double around = 2 * pi * (t + 0.5) / turns;
            const double ahead = std::cos(theta) * cosine - std::sin(theta) * std::cos(around) * sine;
            const double aside = std::sin(theta) * std::sin(around);
            const double up = std::cos(theta) * sine + std::sin(theta) * std::cos(around) * cosine;
            if (up <= 0)
                continue;
            const double row = axes.viewCoordinate(std::asin(std::min(up, 1.)), 0);
            const double column = axes.azimuthCoordinate(std::atan2(aside, ahead));
            for (std::size_t i = 0; i < tables.size(); ++i) {
                if (tables[i].empty())
                    continue;
                const Texel light = sampled(tables[i], row, 0, column);
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += static_cast<double>(phase[i] * light[c]) * up * solidAngle;
            }
        }
    }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]), static_cast<float>(sum[3])};
}

void addSunIlluminance(const std::vector<Texel>& colours, double elevation, double radius, double horizon, Illuminance& result)
{
    // Segments between two heights: chords of the disc times their height, over the disc's area.
    const double solidAngle = 2 * pi * (1 - std::cos(radius));
    const auto segment = [](double x) { return (std::asin(x) + x * std::sqrt(std::max(0., 1 - x * x))) / pi; };
    const auto last = static_cast<double>(colours.size() - 1);
    for (std::size_t k = 0; k + 1 < colours.size(); ++k) {
        const double low = std::max(2 * static_cast<double>(k) / last - 1, std::clamp((horizon - elevation) / radius, -1., 1.));
        const double high = 2 * static_cast<double>(k + 1) / last - 1;
        if (high <= low)
            continue;
        const double share = (segment(high) - segment(low)) * solidAngle, at = elevation + radius * 0.5 * (low + high);
        for (std::size_t c = 0; c < 4; ++c) {
            const double lux = share * 0.5 * static_cast<double>(colours[k][c] + colours[k + 1][c]);
            result.sunFacing[c] += static_cast<float>(lux);
            result.sunHorizontal[c] += static_cast<float>(lux * std::max(0., std::sin(at)));
        }
    }
}

} // namespace showmysky
