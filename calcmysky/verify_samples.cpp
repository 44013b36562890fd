#include "verify_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/angles.hpp"
#include "base/error.hpp"
#include "physics/geometry.hpp"

namespace sky::cli {

namespace {

using base::degree, base::pi;

/// Upper end of the air that scatters: 1e-6 of vertical optical depth is left above it. 92 km on the clear Earth.
double scatteringTop(const physics::Medium& medium)
{
    constexpr double negligibleDepth = 1e-6;
    const std::size_t middle = medium.wavelengthsNm.size() / 2;
    double depth = 0;
    for (std::size_t k = medium.altitudes.size() - 1; k > 0; --k) {
        double beta = 0;
        for (const auto& species : medium.species)
            beta += 0.5 * (species.numberDensity[k] + species.numberDensity[k - 1]) * species.extinctionCrossSection[middle] *
                    species.singleScatteringAlbedo[middle];
        depth += beta * (medium.altitudes[k] - medium.altitudes[k - 1]);
        if (depth > negligibleDepth)
            return medium.altitudes[k];
    }
    return medium.topOfAtmosphere; // hardly any air: where we look does not matter
}

/// Point `index` of a sequence that fills the cube evenly: multiples of powers of the inverse of the generalised golden
/// ratio of four dimensions, x^5 = x + 1 (Roberts 2018, R-sequence).
std::array<double, 4> evenPoint(int index, int stream)
{
    constexpr double ratio = 1.1673039782614187;
    std::array<double, 4> point;
    double step = 1;
    for (double& x : point) {
        step /= ratio;
        x = std::fmod(0.5 + step * (index + 1) + 0.31 * stream, 1.);
    }
    return point;
}

/// About four wavelengths over the spectrum, away from its ends where there are many.
std::vector<int> chosenWavelengths(const physics::Medium& medium)
{
    std::vector<int> lit;
    for (int w = 0; w < medium.wavelengthCount(); ++w)
        if (medium.solarIrradiance[static_cast<std::size_t>(w)] > 0)
            lit.push_back(w);
    if (lit.empty())
        throw UsageError("This model has no sunlight at any wavelength: there is nothing to compare.");
    std::vector<int> chosen;
    for (const double share : {0.07, 0.27, 0.47, 0.67}) {
        const int w = lit[static_cast<std::size_t>(share * static_cast<double>(lit.size()))];
        if (chosen.empty() || chosen.back() != w)
            chosen.push_back(w);
    }
    return chosen;
}

double angleToSun(const montecarlo::Query& q)
{
    return std::acos(std::clamp(std::cos(q.viewZenithAngle) * std::cos(q.sunZenithAngle) +
                                    std::sin(q.viewZenithAngle) * std::sin(q.sunZenithAngle) * std::cos(q.relativeAzimuth),
                                -1., 1.));
}

/// Elevation of a view that fills its range as evenly as `view` and `side` fill 0..1, but quadratically: half of the views lie in the quarter
/// next to the horizon, where the sky changes fastest.
double elevationOf(const physics::Planet& planet, const double scatteringTop, const double altitude, const double view, const double side)
{
    const double horizon = physics::horizonElevation(planet, altitude);
    const bool fromSpace = altitude >= planet.topOfAtmosphere, few = side < 0.25;
    const double down = horizon - (pi / 2 + horizon) * view * view;
    if (fromSpace) {
        const physics::Planet upToThere{planet.radius + scatteringTop, planet.topOfAtmosphere - scatteringTop};
        const double limb = physics::horizonElevation(upToThere, altitude - scatteringTop);
        return few ? horizon + (limb - horizon) * view : down;
    }
    return few && altitude > 0 ? down : horizon + (pi / 2 - horizon) * view * view;
}

} // namespace

const char* nameOf(const Regime regime) { return regime == Regime::Day ? "day" : regime == Regime::Sunset ? "sunset" : "twilight"; }

SampleScale sampleScale(const physics::Medium& medium)
{
    constexpr double earthTop = 92e3, earthDip = 9.68 * degree; // scatteringTop() of the clear Earth, and its dip
    const double top = scatteringTop(medium);
    SampleScale scale;
    for (const double altitude : {0., 2e3, 12e3, 60e3})
        scale.altitudes.push_back(altitude / earthTop * top);
    scale.altitudes.push_back(medium.topOfAtmosphere);
    const physics::Planet planet{medium.planetRadius, medium.topOfAtmosphere};
    const double unit = -physics::horizonElevation(planet, top) / earthDip;
    // A tiny planet has its air lit from far below the horizon; day still begins at 40 degrees at the latest.
    const double day = std::min(4 * degree * unit, 40 * degree);
    scale.suns[0] = {day, 88 * degree};
    scale.suns[1] = {-0.25 * day, day};
    scale.suns[2] = {-1.5 * day, -0.25 * day};
    return scale;
}

std::vector<Sample> sampleSky(const physics::Medium& medium, const int rowsPerCell)
{
    constexpr double awayFromSun = 5 * degree;
    const SampleScale scale = sampleScale(medium);
    const physics::Planet planet{medium.planetRadius, medium.topOfAtmosphere};
    const std::vector<int> wavelengths = chosenWavelengths(medium);
    const double top = scatteringTop(medium);
    const int within = static_cast<int>(scale.altitudes.size()) - 1; // altitudes in the air, whose samples are as if there was no other
    std::vector<Sample> samples;
    for (const Regime regime : allRegimes)
        for (int a = 0; a < static_cast<int>(scale.altitudes.size()); ++a) {
            const double altitude = scale.altitudes[static_cast<std::size_t>(a)];
            const auto& range = scale.suns[static_cast<int>(regime)];
            const int cell = a < within ? static_cast<int>(regime) * within + a : 3 * within + static_cast<int>(regime);
            int found = 0;
            for (int i = 0; found < rowsPerCell; ++i) {
                const auto [sun, view, azimuth, side] = evenPoint(i, cell);
                Sample sample{regime, a, {}};
                montecarlo::Query& q = sample.query;
                q.altitude = altitude;
                q.sunZenithAngle = pi / 2 - (range.low + (range.high - range.low) * sun);
                q.viewZenithAngle = pi / 2 - elevationOf(planet, top, altitude, view, side);
                q.relativeAzimuth = pi * azimuth;
                q.wavelength = wavelengths[static_cast<std::size_t>(found) % wavelengths.size()];
                if (angleToSun(q) < awayFromSun + medium.sunAngularRadius)
                    continue;
                samples.push_back(sample);
                ++found;
            }
        }
    return samples;
}

} // namespace sky::cli
