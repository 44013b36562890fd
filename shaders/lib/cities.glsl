// Where a view meets the ground, and whether a city is there.
#include "lib/angles.glsl"

// Azimuth of a direction, from North (x) over East (-y), 0 .. 2 pi, and the angle at the planet's centre between the camera and the
// ground that is seen; -1 where none is.
struct CityPlace {
    float azimuth, angle;
};

// `horizon` is the elevation of the horizon, `dipTangent` the tangent of its depth D. With a the depth of the view and E the
// elevation of its ray at the ground, cos E = cos a / cos D, and sin angle = cos^2 a tan^2 D / sin(a + E): no angles are subtracted.
CityPlace placeAmongCities(vec3 direction, float elevation, float horizon, float dipTangent)
{
    CityPlace place;
    float size = length(direction.xy);
    float turn = size > 1e-7 ? halfPi - elevationOf(clamp(direction.x / size, -1.0, 1.0)) : 0.0;
    place.azimuth = direction.y > 0.0 ? 4.0 * halfPi - turn : turn;
    place.angle = -1.0;
    float below = horizon - elevation;
    if (below > 0.0) {
        float cosineDip = 1.0 / sqrt(1.0 + dipTangent * dipTangent);
        vec2 view = cosineAndSine(elevation);
        float sineView = -view.y, cosineView = view.x;
        float sineThere = sqrt(max(0.0, sine(below - 2.0 * horizon) * sine(below))) / cosineDip, cosineThere = cosineView / cosineDip;
        float both = sineView * cosineThere + cosineView * sineThere;
        place.angle = elevationOf(clamp(cosineView * cosineView * dipTangent * dipTangent / max(both, 1e-9), 0.0, 1.0));
    }
    return place;
}

// `disc`: angle of the middle, azimuth, radius. Haversines, which keep their digits where cities are small.
bool insideCity(CityPlace place, vec3 disc)
{
    float along = sine(0.5 * (place.angle - disc.x)), across = sine(0.5 * (place.azimuth - disc.y)), edge = sine(0.5 * disc.z);
    return along * along + sine(place.angle) * sine(disc.x) * across * across <= edge * edge;
}
