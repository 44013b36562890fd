#include "physics/eclipse.hpp"
#include "base/error.hpp"
#include <cstdio>
#include <string>

namespace sky::physics {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }
Vector scaled(const Vector& a, double k) { return {k * a[0], k * a[1], k * a[2]}; }
Vector cross(const Vector& a, const Vector& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }

std::string kilometres(double metres)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.7g km", metres / 1e3);
    return text;
}

} // namespace

std::array<double, 3> placeOfBody(const Planet& planet, double cameraAltitude, const std::array<double, 3>& direction, double distance)
{
    // |C + t d| = distance with C the camera seen from the planet's centre: t^2 + 2 r mu t = distance^2 - r^2.
    const double r = planet.radius + cameraAltitude, b = r * direction[2], c = (distance - r) * (distance + r);
    const double root = std::sqrt(std::max(0., b * b + c));
    return scaled(direction, b > 0 ? c / (b + root) : root - b);
}

Shadow makeShadow(const EclipseBodies& bodies)
{
    const double top = bodies.planet.radius + std::max(bodies.planet.topOfAtmosphere, bodies.cameraAltitude);
    if (!(bodies.moonRadius > 0))
        throw RangeError("The radius of the Moon is " + kilometres(bodies.moonRadius) + "; expected more than 0.");
    if (!(bodies.moonDistance > top + bodies.moonRadius))
        throw RangeError("The Moon is " + kilometres(bodies.moonDistance) + " from the planet's centre; expected more than " +
                         kilometres(top + bodies.moonRadius) + ", so that it touches neither the air nor the camera.");
    if (!(bodies.sunDistance > bodies.moonDistance))
        throw RangeError("The Moon is " + kilometres(bodies.moonDistance) +
                         " from the planet's centre; expected less than the Sun's distance, " + kilometres(bodies.sunDistance) + ".");
    const Vector moon = placeOfBody(bodies.planet, bodies.cameraAltitude, bodies.moonDirection, bodies.moonDistance);
    const Vector sun = placeOfBody(bodies.planet, bodies.cameraAltitude, bodies.sunDirection, bodies.sunDistance);
    const Vector between{sun[0] - moon[0], sun[1] - moon[1], sun[2] - moon[2]};
    Shadow shadow;
    shadow.moonRadius = bodies.moonRadius;
    shadow.sunRadius = length(sun) * std::sin(bodies.sunAngularRadius);
    if (!(length(between) > shadow.moonRadius + shadow.sunRadius))
        throw RangeError("The Moon, " + kilometres(bodies.moonDistance) +
                         " from the planet's centre, touches the Sun; expected it nearer.");
    shadow.along = scaled(between, 1 / length(between));
    const int least = std::abs(shadow.along[0]) < std::abs(shadow.along[1]) ? 0 : 1;
    const Vector aside = cross(shadow.along, Vector{least == 0 ? 1. : 0., least == 1 ? 1. : 0., 0.});
    shadow.across[0] = scaled(aside, 1 / length(aside));
    shadow.across[1] = cross(shadow.along, shadow.across[0]);
    shadow.axis = {dot(shadow.across[0], moon), dot(shadow.across[1], moon)};
    shadow.moonAlong = dot(shadow.along, moon);
    shadow.sunAlong = shadow.moonAlong + length(between);
    return shadow;
}

ShadowOf<float> singlePrecision(const Shadow& shadow)
{
    ShadowOf<float> result;
    for (std::size_t i = 0; i < 3; ++i) {
        result.along[i] = static_cast<float>(shadow.along[i]);
        for (std::size_t k = 0; k < 2; ++k)
            result.across[k][i] = static_cast<float>(shadow.across[k][i]);
    }
    result.axis = {static_cast<float>(shadow.axis[0]), static_cast<float>(shadow.axis[1])};
    result.moonAlong = static_cast<float>(shadow.moonAlong);
    result.sunAlong = static_cast<float>(shadow.sunAlong);
    result.moonRadius = static_cast<float>(shadow.moonRadius);
    result.sunRadius = static_cast<float>(shadow.sunRadius);
    return result;
}

GroundShadow groundShadow(const Shadow& shadow, const EclipseBodies& bodies)
{
    // From the axis' point next to the planet's centre back towards the Moon.
    const double r = bodies.planet.radius;
    const Vector centre{0, 0, -(r + bodies.cameraAltitude)};
    const double x = shadow.axis[0] - dot(shadow.across[0], centre), y = shadow.axis[1] - dot(shadow.across[1], centre);
    const double chord = (r - std::hypot(x, y)) * (r + std::hypot(x, y));
    GroundShadow result;
    result.central = chord >= 0;
    if (!result.central)
        return result;
    const double half = std::sqrt(chord), depth = dot(shadow.along, centre) + half;
    for (std::size_t i = 0; i < 3; ++i)
        result.place[i] = shadow.axis[0] * shadow.across[0][i] + shadow.axis[1] * shadow.across[1][i] + depth * shadow.along[i];
    result.sunElevation = std::asin(std::min(1., half / r));
    result.umbraRadius = shadow.umbraRadius(depth);
    result.penumbraRadius = shadow.penumbraRadius(depth);
    return result;
}

} // namespace sky::physics
