#pragma once
// A Sky in a context of its own, and measures of how far two pictures are apart.

#include "gl/context_for_tests.hpp"
#include "physics/colour.hpp"
#include "showmysky/sky.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky::testing {

constexpr double degree = 3.14159265358979323846 / 180;

inline sky::gl::HeadlessOptions desktop()
{
    sky::gl::HeadlessOptions options;
    options.version = {3, 3, false};
    return options;
}

inline sky::gl::HeadlessOptions embedded()
{
    sky::gl::HeadlessOptions options;
    options.version = {3, 0, true};
    return options;
}

inline Sky loadedSky(const sky::gl::HeadlessContext& context, Options options = {})
{
    Sky sky(SHOWMYSKY_TEST_MODEL, context.loader(), std::move(options));
    sky.loadAll();
    return sky;
}

inline SceneSettings scene(double altitude, double sunZenithDeg, Source source = Source::moments)
{
    SceneSettings settings;
    settings.altitude = altitude;
    settings.sun.zenithAngle = sunZenithDeg * degree;
    settings.sun.azimuth = 0.3;
    settings.source = source;
    return settings;
}

/// The whole sphere, the Sun a little off the middle.
inline Camera panorama() { return {Projection::equirectangular, 360 * degree, 0, 0, 0}; }

/// Relative differences in luminance where `reference` is above `floor` times its largest, sorted.
inline std::vector<double> differences(const std::vector<Luminance>& picture, const std::vector<Luminance>& reference, double floor = 1e-6)
{
    float largest = 0;
    for (const auto& pixel : reference)
        largest = std::max(largest, pixel.y);
    std::vector<double> result;
    for (std::size_t i = 0; i < reference.size(); ++i)
        if (static_cast<double>(reference[i].y) > floor * static_cast<double>(largest))
            result.push_back(std::abs(static_cast<double>(picture[i].y) / static_cast<double>(reference[i].y) - 1));
    std::sort(result.begin(), result.end());
    return result;
}

inline double quantile(const std::vector<double>& sorted, double share)
{
    return sorted.at(static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1)));
}

/// Luminance of a spectrum.
inline double luminanceOf(const std::vector<double>& radiance, const std::vector<double>& wavelengthsNm)
{
    const auto weights = sky::physics::luminanceWeights(wavelengthsNm);
    double sum = 0;
    for (std::size_t w = 0; w < radiance.size(); ++w)
        sum += weights[w][1] * radiance[w];
    return sum;
}

} // namespace showmysky::testing
