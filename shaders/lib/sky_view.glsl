// The sky of one altitude and Sun from its tables (showmysky/src/sky_view.hpp): where a direction lies in them.
#include "lib/angles.glsl"

// Scale of the angle from the horizon in tables; physics::horizonAngleScale.
const float horizonAngleScale = 0.05;

// What the mapping of directions depends on.
struct SkyViewAxes {
    vec3 sun;            // unit vector towards the Sun's centre; z is the zenith
    float horizon;       // elevation of the geometric horizon, rad, <= 0
    vec2 inverseRanges;  // 1 / asinh(range / scale) above and below it
    vec2 size;           // azimuths, views of one half
    bool wholeTurn;      // an eclipse: azimuths from -pi to pi; showmysky/src/sky_axes.hpp
    vec4 viewFocus;      // share of the upper half's rows around the Sun, its angle from the horizon, offset, scale
    vec3 azimuthFocus;   // share of the columns, 1 / width, scale
};

const float focusWidth = 0.04; // SkyAxes::focusWidth

// Place of a direction: column and row in texels from the first texel's centre; the row counts from the half's horizon on.
struct SkyViewPlace {
    vec2 texel;
    float half_; // 0 above the horizon, 1 below
};

// Angle between two unit vectors, rad, 0 .. pi; from the chord, which keeps its digits where the cosine loses them.
float angleBetween(vec3 a, vec3 b)
{
    vec3 chord = dot(a, b) > 0.0 ? a - b : a + b;
    float angle = 2.0 * elevationOf(0.5 * length(chord));
    return dot(a, b) > 0.0 ? angle : 2.0 * halfPi - angle;
}

// `elevation` is that of `direction`, or where a mirror shows another.
SkyViewPlace placeInSkyView(SkyViewAxes axes, vec3 direction, float elevation)
{
    SkyViewPlace place;
    float fromHorizon = elevation - axes.horizon;
    place.half_ = fromHorizon < 0.0 ? 1.0 : 0.0;
    float range = fromHorizon < 0.0 ? axes.inverseRanges.y : axes.inverseRanges.x;
    float view = clamp(inverseSinh(abs(fromHorizon) / horizonAngleScale) * range, 0.0, 1.0);
    if (axes.wholeTurn && fromHorizon >= 0.0) {
        float aroundSun = (inverseSinh((fromHorizon - axes.viewFocus.y) / focusWidth) + axes.viewFocus.z) * axes.viewFocus.w;
        view = clamp(mix(view, aroundSun, axes.viewFocus.x), 0.0, 1.0);
    }
    float lengths = length(direction.xy) * length(axes.sun.xy);
    float cosine = lengths > 1e-7 ? clamp(dot(direction.xy, axes.sun.xy) / lengths, -1.0, 1.0) : 1.0;
    float azimuth = 0.5 - elevationOf(cosine) / (2.0 * halfPi);
    if (axes.wholeTurn) {
        // Small angles from the sine, whose digits the cosine has lost.
        float sine = lengths > 1e-7 ? clamp((axes.sun.x * direction.y - axes.sun.y * direction.x) / lengths, -1.0, 1.0) : 0.0;
        float angle = cosine > 0.7 ? elevationOf(abs(sine)) : halfPi - elevationOf(cosine);
        float plain = angle / (2.0 * halfPi);
        float column = mix(plain, inverseSinh(angle * axes.azimuthFocus.y) * axes.azimuthFocus.z, axes.azimuthFocus.x);
        azimuth = 0.5 + (sine < 0.0 ? -0.5 : 0.5) * min(column, 1.0);
    }
    place.texel = vec2(azimuth, view) * (axes.size - 1.0);
    return place;
}

// Texture coordinate of a place in table `table` of an atlas that holds `tables` tables one above the other.
vec2 skyViewCoordinate(SkyViewAxes axes, SkyViewPlace place, float table, float tables)
{
    float row = (2.0 * table + place.half_) * axes.size.y + place.texel.y;
    return (vec2(place.texel.x, row) + 0.5) / vec2(axes.size.x, 2.0 * tables * axes.size.y);
}
