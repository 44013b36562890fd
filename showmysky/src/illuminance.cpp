#include "illuminance.hpp"
#include "base/angles.hpp"
#include "physics/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace showmysky {

namespace {

using sky::base::pi;
/// Angles from the Sun, dense near it as cubes, and directions around it; along a radius of the Sun's disc.
constexpr int angles = 160, turns = 96, radii = 8;

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

void addCrescentIlluminance(const std::vector<Texel>& colours, const double elevation, const Crescent& crescent, const double horizon,
                            Illuminance& result)
{
    // In units of the Sun's radius, from its centre: `rho` at an angle `phi` from the way that leads off the Moon. The Moon's limb is at
    // rho^2 + 2 rho d cos(phi) + d^2 = b^2.
    const double radius = crescent.discs.sunRadius, b = crescent.discs.moonRadius / radius, d = crescent.discs.separation / radius;
    const double solidAngle = 2 * pi * (1 - std::cos(radius)), aside = std::sqrt(std::max(0., 1 - crescent.up * crescent.up));
    const auto add = [&](double area, double rho, double height) {
        const double at = elevation + radius * height;
        const double u = std::clamp(0.5 * (height + 1), 0., 1.) * static_cast<double>(colours.size() - 1);
        const auto k = std::min(static_cast<std::size_t>(u), colours.size() - 2);
        for (std::size_t c = 0; c < 4; ++c) {
            const auto exponent = static_cast<double>(crescent.limbExponents[c]), low = static_cast<double>(colours[k][c]);
            const double limb = (1 + 0.5 * exponent) * std::pow(1 - rho * rho, 0.5 * exponent);
            const double lux =
                area / pi * solidAngle * limb * (low + (u - static_cast<double>(k)) * (static_cast<double>(colours[k + 1][c]) - low));
            result.sunFacing[c] += static_cast<float>(lux);
            result.sunHorizontal[c] += static_cast<float>(lux * std::max(0., std::sin(at)));
        }
    };
    const double lowest = (horizon - elevation) / radius;
    const auto rule = sky::physics::gaussLegendre(radii, 0, 1);
    const double horns = std::acos(std::clamp((b * b - 1 - d * d) / (2 * std::max(d, 1e-12)), -1., 1.)); // where the limbs cross
    for (const auto& [from, to] : {std::pair{0., horns}, {horns, pi}})
        for (int i = 0; i < turns; ++i) {
            const double width = (to - from) / turns, phi = from + width * (i + 0.5), cosine = std::cos(phi), sine = std::sin(phi);
            const auto addStretch = [&](double near, double far) {
                for (const double side : {-1., 1.}) {
                    // Height per radius; the horizon cuts the stretch.
                    const double slope = cosine * crescent.up + side * sine * aside, cut = lowest / slope;
                    const double low = slope > 0 ? std::max(near, cut) : near, high = slope < 0 ? std::min(far, cut) : far;
                    for (std::size_t k = 0; high > low && k < rule.nodes.size(); ++k) {
                        const double rho = low + (high - low) * rule.nodes[k];
                        add(width * (high - low) * rule.weights[k] * rho, rho, rho * slope);
                    }
                }
            };
            const double root = b * b - d * d * sine * sine;
            if (root <= 0) {
                addStretch(0, 1);
            } else {
                addStretch(0, std::min(1., -d * cosine - std::sqrt(root)));
                addStretch(std::max(0., std::sqrt(root) - d * cosine), 1);
            }
        }
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
