// Straight rays in a spherical shell; twin in double precision: libs/physics/geometry.hpp. No two radii are subtracted.

struct Planet {
    float radius, topOfAtmosphere; // m
};

// Part of a ray that lies in the air, m from its start.
struct AirSpan {
    float start, end; // equal where the ray misses the air
};

// Ray from `altitude` (m, above the air too); `mu` is the cosine of its zenith angle. `ground`: it ends there, by the caller's
// knowledge and not by rounding.
AirSpan spanInAir(Planet planet, float altitude, float mu, bool ground)
{
    float b = (planet.radius + altitude) * mu;
    // r_top^2 - r^2 and r^2 - R^2
    float toTop = (planet.topOfAtmosphere - altitude) * (2.0 * planet.radius + altitude + planet.topOfAtmosphere);
    float toGround = altitude * (altitude + 2.0 * planet.radius);
    float discriminant = b * b + toTop;
    if (discriminant <= 0.0 || (toTop < 0.0 && b >= 0.0))
        return AirSpan(0.0, 0.0);
    // Roots by conjugates where b and the square root would cancel.
    float root = sqrt(discriminant);
    AirSpan span;
    span.start = toTop < 0.0 ? -toTop / (root - b) : 0.0;
    span.end = b > 0.0 ? toTop / (b + root) : root - b;
    if (ground)
        span.end = toGround <= 0.0 ? 0.0 : max(span.start, toGround / (sqrt(max(0.0, b * b - toGround)) - b));
    return span;
}
