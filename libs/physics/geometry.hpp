#pragma once
// Straight rays in a spherical shell. One implementation of each formula; the GLSL twin is shaders/lib/geometry.glsl.
// No two radii are ever subtracted (docs/method, "numbers"): differences are written as products.
//
// Symbols: R planet radius, h altitude, r = R + h, mu cosine of the zenith angle, s distance along the ray; metres.

#include <algorithm>
#include <cmath>

namespace sky::physics {

struct Planet {
    double radius = 0;          ///< R, m
    double topOfAtmosphere = 0; ///< H, m, altitude
};

/// r^2 - R^2 at altitude h, as a product.
inline double radiusExcessSquared(const Planet& p, double h) { return h * (h + 2 * p.radius); }

/// Distance to the geometric horizon, sqrt(r^2 - R^2): the measure of altitude in which gentle profiles and limb geometry are spread
/// evenly. 0 below the ground.
inline double horizonDistance(const Planet& p, double h) { return std::sqrt(std::max(0., radiusExcessSquared(p, h))); }

/// The altitude whose horizon is so far away.
inline double altitudeOfHorizon(const Planet& p, double distance)
{
    return distance * distance / (std::sqrt(p.radius * p.radius + distance * distance) + p.radius);
}

/// Altitude at distance s. From r'^2 - R^2 = h (h + 2R) + s^2 + 2 r mu s, divided by r' + R.
inline double altitudeAlong(const Planet& p, double h, double mu, double s)
{
    const double q = radiusExcessSquared(p, h) + s * (s + 2 * (p.radius + h) * mu);
    return std::max(0., q / (std::sqrt(std::max(0., p.radius * p.radius + q)) + p.radius));
}

/// Cosine of the zenith angle of the geometric horizon seen from altitude h >= 0; 0 on the ground, negative above.
inline double horizonMu(const Planet& p, double h) { return -horizonDistance(p, h) / (p.radius + h); }

/// Elevation of the geometric horizon, rad, <= 0. atan2 keeps the digits that acos(mu) loses near zero.
inline double horizonElevation(const Planet& p, double h) { return -std::atan2(horizonDistance(p, h), p.radius); }

/// True if the ray from altitude h meets the ground. The horizon itself misses it.
inline bool hitsGround(const Planet& p, double h, double mu) { return mu < horizonMu(p, h); }

/// Distance to the top of the atmosphere from inside it (0 <= h <= H), not looking at the ground.
/// Root by conjugate where b > 0: b and the square root would cancel.
inline double distanceToTop(const Planet& p, double h, double mu)
{
    const double b = (p.radius + h) * mu;
    const double c = std::max(0., (p.topOfAtmosphere - h) * (2 * p.radius + h + p.topOfAtmosphere));
    const double root = std::sqrt(b * b + c);
    return b > 0 ? c / (b + root) : root - b;
}

/// Distance to the ground, for rays that hit it (see hitsGround).
inline double distanceToGround(const Planet& p, double h, double mu)
{
    const double b = (p.radius + h) * mu;
    const double c = radiusExcessSquared(p, h);
    const double root = std::sqrt(std::max(0., b * b - c));
    return c <= 0 ? 0 : c / (root - b);
}

/// Distance to the shell of altitude `shell`, the nearer (`first`) or farther crossing; negative if there is none ahead.
inline double distanceToShell(const Planet& p, double h, double mu, double shell, bool first)
{
    const double b = (p.radius + h) * mu;
    const double c = (shell - h) * (2 * p.radius + h + shell); // r_shell^2 - r^2
    const double discriminant = b * b + c;
    if (discriminant < 0)
        return -1;
    const double root = std::sqrt(discriminant);
    if (first) // -b - root
        return b < 0 ? (c < 0 ? -c / (root - b) : -b - root) : -b - root;
    return b > 0 ? c / (b + root) : root - b;
}

/// Fraction of a uniform disc of angular radius `discRadius` above a straight edge, whose centre stands `above` over it (rad).
/// Area of a circular segment; continuous, 0..1. A point-like disc is a step at zero.
inline double visibleDiscFraction(double above, double discRadius)
{
    if (above >= discRadius)
        return 1;
    if (above <= -discRadius)
        return 0;
    const double x = above / discRadius;
    return std::clamp(0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / 3.14159265358979323846, 0., 1.);
}

} // namespace sky::physics
