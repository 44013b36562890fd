#include "sky_axes.hpp"

#include "base/angles.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace {

using sky::base::pi;

/// Inverse of an increasing function on low..high.
template<class F>
double inverse(F&& f, double value, double low, double high)
{
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace

double SkyAxes::range(const int half) const { return half == 0 ? pi / 2 - horizon : pi / 2 + horizon; }

SkyAxes::Focus SkyAxes::focus(const int half) const
{
    const double sun = sunElevation - horizon;
    if (!eclipse || half != 0 || sun < 0)
        return {};
    Focus result;
    result.share = focusShare;
    result.sun = sun;
    result.offset = std::asinh(sun / focusWidth);
    result.scale = 1 / (std::asinh((range(half) - sun) / focusWidth) + result.offset);
    return result;
}

double SkyAxes::viewCoordinate(const double elevation, const int half) const
{
    const double fromHorizon = std::clamp(std::abs(elevation - horizon), 0., range(half));
    const double scale = sky::physics::horizonAngleScale;
    const double plain = std::asinh(fromHorizon / scale) / std::asinh(range(half) / scale);
    const Focus f = focus(half);
    return plain + f.share * ((std::asinh((fromHorizon - f.sun) / focusWidth) + f.offset) * f.scale - plain);
}

double SkyAxes::elevationAt(const double coordinate, const int half) const
{
    const auto at = [&](double fromHorizon) { return viewCoordinate(horizon + (half == 0 ? 1 : -1) * fromHorizon, half); };
    const double fromHorizon = inverse(at, coordinate, 0, range(half));
    return horizon + (half == 0 ? fromHorizon : -fromHorizon);
}

std::array<double, 3> SkyAxes::azimuthFocus() const
{
    if (!eclipse)
        return {0, 1, 0};
    // A circle around a Sun high up covers more azimuth.
    const double width = focusWidth / std::max(focusWidth, std::cos(sunElevation));
    return {focusShare, 1 / width, 1 / std::asinh(pi / width)};
}

double SkyAxes::azimuthCoordinate(const double relative) const
{
    const double angle = std::min(std::abs(relative), pi), plain = angle / pi;
    if (!eclipse)
        return plain;
    const auto [share, inverseWidth, scale] = azimuthFocus();
    const double x = plain + share * (std::asinh(angle * inverseWidth) * scale - plain);
    return 0.5 + (relative < 0 ? -0.5 : 0.5) * x;
}

double SkyAxes::azimuthAt(const double coordinate) const
{
    if (!eclipse)
        return pi * coordinate;
    const double side = coordinate < 0.5 ? -1 : 1;
    return side * inverse([&](double angle) { return std::abs(2 * azimuthCoordinate(angle) - 1); }, std::abs(2 * coordinate - 1), 0, pi);
}

} // namespace showmysky
