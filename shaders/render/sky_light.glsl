// Light of a direction from the tables of this sky: what the painter draws and what hosts ask for in their own shaders.
#include "lib/sky_view.glsl"

uniform sampler2D skyTables;  // atlas: what is seen as it is, then one table for each scatterer
uniform sampler2D phases;     // fourth roots, over cbrt(angle / pi), four scatterers a row
uniform vec4 tableScales[SCATTERERS + 1]; // the tables are stored over these; 0 where one isn't shown
uniform vec3 sunDirection;
uniform float horizon;
uniform vec2 inverseRanges;
uniform vec2 tableSize;
uniform float phaseWidth;
#ifndef WHOLE_TURN // a program made for either case knows it; branches that never run still cost a software driver time
uniform bool wholeTurn;               // an eclipse: azimuths all around, rows and columns gathered at the Sun
#define WHOLE_TURN wholeTurn
#endif
uniform vec4 viewFocus;
uniform vec3 azimuthFocus;
uniform bool mirror;

// Below the horizon the direction that a mirror there shows, if the scene has one.
void lookIntoMirror(inout vec3 direction, inout float elevation)
{
    if (!mirror || elevation >= horizon)
        return;
    elevation = 2.0 * horizon - elevation;
    vec2 turned = cosineAndSine(elevation);
    direction = vec3(direction.xy / max(length(direction.xy), 1e-7) * turned.x, turned.y);
}

// Luminance of a direction (unit vector); `shares`: how much of each table's light counts.
vec4 skyLight(vec3 direction, float elevation, vec4 shares[SCATTERERS + 1])
{
    SkyViewAxes axes = SkyViewAxes(sunDirection, horizon, inverseRanges, tableSize, WHOLE_TURN, viewFocus, azimuthFocus);
    SkyViewPlace place = placeInSkyView(axes, direction, elevation);
    const float tables = float(SCATTERERS + 1);
    vec4 light = shares[0] * tableScales[0] * texture(skyTables, skyViewCoordinate(axes, place, 0.0, tables));
    float angle = angleBetween(direction, sunDirection);
    float along = (pow(max(angle, 1e-9) / (2.0 * halfPi), 1.0 / 3.0) * (phaseWidth - 1.0) + 0.5) / phaseWidth;
    vec4 phase = vec4(0.0);
    for (int i = 0; i < SCATTERERS; ++i) {
        if ((i & 3) == 0) {
            phase = texture(phases, vec2(along, (float(i / 4) + 0.5) / float(PHASE_ROWS)));
            phase *= phase;
            phase *= phase;
        }
        int c = i & 3;
        float p = c == 0 ? phase.x : c == 1 ? phase.y : c == 2 ? phase.z : phase.w;
        light += p * shares[i + 1] * tableScales[i + 1] * texture(skyTables, skyViewCoordinate(axes, place, float(i + 1), tables));
    }
    return light;
}

vec4 skyLight(vec3 direction, float elevation)
{
    vec4 all[SCATTERERS + 1];
    for (int i = 0; i <= SCATTERERS; ++i)
        all[i] = vec4(1.0);
    return skyLight(direction, elevation, all);
}
