// One direction per pixel: its place in the tables of this sky, the exact phase functions, the Sun.
// vec3 viewDirection(vec2 position) comes from the host, or from render/projections.glsl.
#include "lib/sky_view.glsl"
#include "user:viewDirection"

uniform sampler2D skyTables;  // atlas: what is seen as it is, then one table for each scatterer
uniform sampler2D phases;     // fourth roots, over cbrt(angle / pi), four scatterers a row
uniform vec4 tableScales[SCATTERERS + 1]; // the tables are stored over these; 0 where one isn't shown
uniform vec3 sunDirection;
uniform float horizon;
uniform vec2 inverseRanges;
uniform vec2 tableSize;
uniform float phaseWidth;
uniform vec4 sunColours[SUN_COLOURS]; // luminance of the disc from its lower to its upper edge
uniform float sunRadius;              // rad; 0 where the disc isn't shown
uniform bool wholeTurn;               // an eclipse: azimuths all around, rows and columns gathered at the Sun
uniform vec4 viewFocus;
uniform vec3 azimuthFocus;
uniform vec3 moonDirection;
uniform float moonRadius;             // rad; 0 where there is no eclipse
uniform vec4 limbExponents;           // of X, Y, Z and scotopic luminance; 0 for a uniform disc
uniform bool mirror;
uniform bool showDirection;           // instead of the luminance
uniform float pixelScale;             // picture's pixels per drawn pixel
uniform vec2 pixelOffset;
uniform float largest;                // that the target can hold

out vec4 result;

vec4 sunDisc(vec3 direction, float elevation, float angle, float pixel)
{
    float cover = clamp((sunRadius - angle) / max(pixel, 1e-7) + 0.5, 0.0, 1.0);
    // The Moon takes its part of a pixel first: where both limbs cross one, nothing shines through between them.
    if (moonRadius > 0.0)
        cover -= clamp((moonRadius - angleBetween(direction, moonDirection)) / max(pixel, 1e-7) + 0.5, 0.0, 1.0);
    if (cover <= 0.0)
        return vec4(0.0);
    float x = min(angle / sunRadius, 1.0);
    vec4 limb = (1.0 + 0.5 * limbExponents) * pow(vec4(max(1.0 - x * x, 1e-6)), 0.5 * limbExponents);
    float u = clamp((elevation - elevationOf(sunDirection.z)) / sunRadius * 0.5 + 0.5, 0.0, 1.0) * float(SUN_COLOURS - 1);
    int k = min(int(u), SUN_COLOURS - 2);
    return cover * limb * mix(sunColours[k], sunColours[k + 1], u - float(k));
}

void main()
{
    vec3 direction = viewDirection(gl_FragCoord.xy * pixelScale + pixelOffset);
    float pixelAngle = length(dFdx(direction));
    float size = length(direction);
    result = vec4(0.0);
    if (!(size > 0.0))
        return;
    direction /= size;
    pixelAngle /= size;
    if (showDirection) {
        result = vec4(direction, 1.0);
        return;
    }
    float elevation = elevationOf(direction.z);
    if (mirror && elevation < horizon) {
        elevation = 2.0 * horizon - elevation;
        direction = vec3(direction.xy / max(length(direction.xy), 1e-7) * cos(elevation), sin(elevation));
    }
    SkyViewAxes axes = SkyViewAxes(sunDirection, horizon, inverseRanges, tableSize, wholeTurn, viewFocus, azimuthFocus);
    SkyViewPlace place = placeInSkyView(axes, direction, elevation);
    const float tables = float(SCATTERERS + 1);
    result = tableScales[0] * texture(skyTables, skyViewCoordinate(axes, place, 0.0, tables));
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
        result += p * tableScales[i + 1] * texture(skyTables, skyViewCoordinate(axes, place, float(i + 1), tables));
    }
    if (sunRadius > 0.0 && elevation >= horizon)
        result += sunDisc(direction, elevation, angle, pixelAngle);
    result = min(result, vec4(largest));
}
