#pragma once
// Straight rays around a sphere. The radial coordinate is X = r^2 - R^2 = h (h + 2R): along a ray it is *exactly*
// the quadratic X(s) = X0 + 2 b s + s^2 with b = r mu, so that neither radii are subtracted nor roots needed.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sky::montecarlo {

struct Vec {
    double x = 0, y = 0, z = 0;
    friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec operator*(double k, Vec a) { return {k * a.x, k * a.y, k * a.z}; }
};
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec a) { return std::sqrt(dot(a, a)); }
inline Vec normalized(Vec a) { return (1 / length(a)) * a; }

/// Angle between two unit vectors, rad. The half-angle form keeps full precision near 0 and pi, where acos loses half
/// of the digits.
inline double angleBetween(Vec a, Vec b) { return 2 * std::atan2(length(a - b), length(a + b)); }

/// A unit vector perpendicular to the unit vector `a`.
inline Vec perpendicular(Vec a) { return normalized(std::abs(a.x) < 0.5 ? cross(a, Vec{1, 0, 0}) : cross(a, Vec{0, 1, 0})); }

/// `axis` turned by the angle with this cosine and sine, in the azimuth `phi` around it.
inline Vec turned(Vec axis, double cosine, double sine, double phi)
{
    const Vec u = perpendicular(axis), v = cross(axis, u);
    return normalized(cosine * axis + (sine * std::cos(phi)) * u + (sine * std::sin(phi)) * v);
}

/// A point by its altitude and the unit vector from the planet's centre.
struct Place {
    double altitude = 0;
    Vec up{0, 0, 1};
};

/// The quadratic X(s) of a ray, s >= 0.
struct Ray {
    double x0 = 0; ///< X at the start, m^2
    double b = 0;  ///< radius times cosine of the zenith angle, m

    double at(double s) const { return x0 + s * (2 * b + s); }
    double lowest() const { return x0 - b * b; } ///< X at the perigee; meaningful where b < 0
    bool hitsGround() const { return b < 0 && lowest() < 0; }

    /// Distance at which a descending ray (b < 0) crosses x on its way down, lowest() <= x <= x0.
    double down(double x) const { return (x0 - x) / (std::sqrt(std::max(0.0, b * b - (x0 - x))) - b); }
    /// Distance at which the ray crosses x on its way up; x >= x0 where b >= 0, x >= lowest() otherwise.
    double up(double x) const
    {
        const double root = std::sqrt(std::max(0.0, b * b + (x - x0)));
        return b < 0 ? root - b : b + root > 0 ? std::max(0.0, x - x0) / (b + root) : 0.0;
    }
};

inline double radialSquare(double planetRadius, double altitude) { return altitude * (altitude + 2 * planetRadius); }
/// Inverse of radialSquare, by the conjugate of sqrt(R^2 + X) - R.
inline double altitudeOf(double planetRadius, double x) { return x / (std::sqrt(planetRadius * planetRadius + x) + planetRadius); }

inline Ray rayFrom(double planetRadius, const Place& place, Vec direction)
{
    return {radialSquare(planetRadius, place.altitude), (planetRadius + place.altitude) * dot(place.up, direction)};
}

/// The place at distance s along the ray.
inline Place moved(double planetRadius, const Place& place, Vec direction, const Ray& ray, double s)
{
    return {altitudeOf(planetRadius, ray.at(s)), normalized((planetRadius + place.altitude) * place.up + s * direction)};
}

} // namespace sky::montecarlo
