// Direct sunlight at a point: visible part of the disc, and the coordinates of the tables over the Sun's elevation.
// Twins in double precision: libs/physics/geometry.hpp, sun.hpp, moments.hpp.

#include "lib/angles.glsl"

// Fraction of a uniform disc of angular radius `radius` above a straight edge; its centre stands `above` over it (rad).
// The smaller segment's share is y^(3/2) P(y) of its height y in radii; P by Chebyshev interpolation, error 2e-7 of the share.
// A Sun without extent is a step.
float visibleDiscFraction(float above, float radius)
{
    if (above >= radius)
        return 1.0;
    if (above <= -radius)
        return 0.0;
    float y = 1.0 - abs(above) / radius;
    float p = 6.00210956e-1 + y * (-9.00369308e-2 + y * (-7.98012091e-3 + y * (-1.79385596e-3 + y * (-5.49666396e-6 - y * 3.94456163e-4))));
    float segment = y * sqrt(y) * p;
    return above > 0.0 ? 1.0 - segment : segment;
}

// Fraction of the disc that shows to a node of a ray, which stands for its surroundings; elevations above the horizon of the nodes before, here and
// after (rad). Twin with the reasons: libs/physics/shadow_edge.hpp.
float visibleAlong(float before, float here, float after, float radius)
{
    float b = before - here, a = after - here;
    return visibleDiscFraction(here + (b + a) / 6.0, sqrt(radius * radius + (b * b - b * a + a * a) * (2.0 / 9.0)));
}

// Position 0..1 on the elevation axis of the table of sunlight. `above` the horizon (rad), `scale` physics::SunTable's (rad),
// `inverseRange` 1 / asinh(range / scale), range = pi/2 - horizon + radius.
float sunAxis(float above, float radius, float scale, float inverseRange)
{
    float x = max(0.0, above + radius);
    return min(1.0, inverseSinh(x / scale) * inverseRange);
}

// Position on the elevation axis of the moments, 0..1: e = (pi/2) sinh(a v) / sinh a, v from its value for the lowest Sun to 1.
// axis: a, sinh a, lowest v.
float momentAxis(float elevation, vec3 axis)
{
    float v = inverseSinh(elevation * (axis.y / halfPi)) / axis.x;
    return clamp((v - axis.z) / (1.0 - axis.z), 0.0, 1.0);
}

// Mean cosine of the visible part of the disc on a horizontal surface at the ground: the centroid of the segment that shows.
float horizontalSunCosine(float muSun, float elevation, float radius)
{
    if (abs(elevation) >= radius)
        return max(muSun, 0.0);
    float x = elevation / radius, area = 2.0 * halfPi * visibleDiscFraction(elevation, radius);
    float lift = x < -0.99 ? 0.0 : radius * (2.0 / 3.0) * pow(max(0.0, 1.0 - x * x), 1.5) / max(area, 1e-6);
    return max(0.0, elevation + lift);
}
