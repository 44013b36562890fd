// Light of cities: of the air above them from a table, and of the discs themselves where the view meets the ground.
#include "lib/cities.glsl"
#include "render/sky_light.glsl"

uniform sampler2D cityAir;   // azimuths all around from North over East, views as of the sky's tables
uniform sampler2D cityDiscs; // a row for each: angle at the planet's centre, azimuth, radius; then luminance across it
uniform int cityCount;
uniform float cityScale;     // the table is stored over it
uniform vec2 cityTableSize;
uniform float dipTangent;    // of the horizon's depth

vec4 cityGround(CityPlace place)
{
    vec4 light = vec4(0.0);
    for (int i = 0; i < cityCount; ++i) {
        vec4 disc = texelFetch(cityDiscs, ivec2(0, i), 0);
        if (!insideCity(place, disc.xyz))
            continue;
        float near = max(0.0, disc.x - disc.z), far = disc.x + disc.z;
        float u = clamp((place.angle - near) / (far - near), 0.0, 1.0) * float(CITY_COLOURS - 1);
        int k = min(int(u), CITY_COLOURS - 2);
        light += mix(texelFetch(cityDiscs, ivec2(1 + k, i), 0), texelFetch(cityDiscs, ivec2(2 + k, i), 0), u - float(k));
    }
    return light;
}

// Of the air, and of the ground as far as the air lights it.
vec4 cityAirLight(CityPlace place, float elevation)
{
    bool ground = elevation < horizon;
    float range = ground ? inverseRanges.y : inverseRanges.x;
    float view = clamp(inverseSinh(abs(elevation - horizon) / horizonAngleScale) * range, 0.0, 1.0);
    vec2 texel = vec2(place.azimuth / (4.0 * halfPi), view) * (cityTableSize - 1.0) + 0.5;
    if (ground)
        texel.y += cityTableSize.y;
    return cityScale * texture(cityAir, texel / vec2(cityTableSize.x, 2.0 * cityTableSize.y));
}

vec4 cityLight(vec3 direction, float elevation)
{
    if (cityCount == 0)
        return vec4(0.0);
    CityPlace place = placeAmongCities(direction, elevation, horizon, dipTangent);
    vec4 air = cityAirLight(place, elevation);
    return elevation < horizon ? air + cityGround(place) : air;
}
