#include "eclipse/frame.hpp"
#include <algorithm>
#include <cmath>

namespace sky::eclipse {

namespace {

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector combine(double p, const Vector& a, double q, const Vector& b)
{
    return {p * a[0] + q * b[0], p * a[1] + q * b[1], p * a[2] + q * b[2]};
}
Vector unit(const Vector& a) { return combine(1 / length(a), a, 0, a); }
Vector cross(const Vector& a, const Vector& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

/// A unit vector across a unit vector: towards `wish` if that is not parallel.
Vector acrossTo(const Vector& axis, const Vector& wish)
{
    Vector result = combine(1, wish, -dot(axis, wish), axis);
    if (length(result) < 1e-6) {
        const Vector other = std::abs(axis[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
        result = combine(1, other, -dot(axis, other), axis);
    }
    return unit(result);
}

/// The shadow's axis is taken to pass the planet's centre, so that any plane through it is a mirror, within this distance, m.
constexpr double central = 1e3;

} // namespace

Frame::Frame(const physics::EclipseBodies& bodies) : planet_(bodies.planet), cameraRadius_(bodies.planet.radius + bodies.cameraAltitude)
{
    const Vector zenith{0, 0, 1}, centre{0, 0, -cameraRadius_};
    const Vector sun =
        combine(1, physics::placeOfBody(planet_, bodies.cameraAltitude, bodies.sunDirection, bodies.sunDistance), -1, centre);
    const Vector moon =
        combine(1, physics::placeOfBody(planet_, bodies.cameraAltitude, bodies.moonDirection, bodies.moonDistance), -1, centre);
    sun_ = unit(sun);
    const Vector axis = unit(combine(1, sun, -1, moon)); // from the Moon to the Sun
    const Vector nearest = combine(1, moon, -dot(moon, axis), axis);
    aside_ = length(nearest) > central ? unit(cross(nearest, axis)) : cross(axis, acrossTo(axis, zenith));
    if (aside_[2] < 0)
        aside_ = combine(-1, aside_, 0, aside_);
    const double latitude = std::asin(std::clamp(aside_[2], 0., 1.));
    observer_ = planet_.radius * latitude;
    upward_ = acrossTo(aside_, zenith);
    stretch_ = std::max(0.1, std::cos(latitude));
    ahead_ = cross(aside_, upward_);
    if (dot(ahead_, sun_) < 0)
        ahead_ = combine(-1, ahead_, 0, ahead_);

    // Where the axis meets a sphere in the lower air, on the Moon's side; else its point next to the planet.
    const double sphere = planet_.radius + 0.1 * planet_.topOfAtmosphere, miss = length(nearest);
    const double half = std::sqrt(std::max(0., (sphere - miss) * (sphere + miss)));
    const Vector entry = combine(1, nearest, half, axis);
    shadow_ = planet_.radius * stretch_ * std::atan2(dot(entry, ahead_), dot(entry, upward_));
    shadowSunSine_ = half / std::max(sphere, miss);
}

LocalAxes Frame::axesAt(const double x, const double y) const
{
    const double longitude = x / (planet_.radius * stretch_), latitude = y / planet_.radius;
    const double a = std::cos(longitude), b = std::sin(longitude), c = std::cos(latitude), d = std::sin(latitude);
    const Vector outward = combine(a, upward_, b, ahead_);
    return {combine(a, ahead_, -b, upward_), combine(c, aside_, -d, outward), combine(c, outward, d, aside_)};
}

Vector Frame::position(const LocalAxes& axes, const double altitude) const
{
    const double r = planet_.radius + altitude;
    return {r * axes.up[0], r * axes.up[1], r * axes.up[2] - cameraRadius_};
}

Vector Frame::sunAt(const LocalAxes& axes) const { return {dot(sun_, axes.along), dot(sun_, axes.across), dot(sun_, axes.up)}; }

double Frame::azimuthOf(const double azimuth) const
{
    const LocalAxes axes = axesAt(0, observer_);
    const Vector direction{std::cos(azimuth), std::sin(azimuth), 0};
    return std::atan2(dot(direction, axes.across), dot(direction, axes.along));
}

std::vector<double> clusteredNodes(const double from, const double to, const std::array<double, 2>& centres,
                                   const std::array<double, 2>& cores, const int count)
{
    const auto crowd = [&](double x) { return std::asinh((x - centres[0]) / cores[0]) + std::asinh((x - centres[1]) / cores[1]); };
    const double first = crowd(from), last = crowd(to);
    std::vector<double> nodes{from};
    for (int i = 1; i + 1 < count; ++i) {
        const double target = first + (last - first) * i / (count - 1);
        double low = nodes.back(), high = to;
        for (int step = 0; step < 50; ++step) {
            const double middle = 0.5 * (low + high);
            (crowd(middle) < target ? low : high) = middle;
        }
        nodes.push_back(0.5 * (low + high));
    }
    nodes.push_back(to);
    return nodes;
}

double groundDistance(const double planetRadius, const double sunScale, const double nuScale, const double mu)
{
    return planetRadius * std::atan2(nuScale * std::sqrt(std::max(0., 1 - mu * mu)), sunScale + nuScale * mu);
}

} // namespace sky::eclipse
