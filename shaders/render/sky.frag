// One direction per pixel: its place in the tables of this sky, the exact phase functions, the Sun.
// vec3 viewDirection(vec2 position) comes from the host, or from render/projections.glsl.
#include "render/city_light.glsl"
#include "render/sky_light.glsl"
#include "user:viewDirection"

uniform vec4 sunColours[SUN_COLOURS]; // luminance of the disc from its lower to its upper edge
uniform float sunRadius;              // rad; 0 where the disc isn't shown
uniform vec3 moonDirection;
uniform float moonRadius;             // rad; 0 where there is no eclipse
uniform vec4 limbExponents;           // of X, Y, Z and scotopic luminance; 0 for a uniform disc
uniform bool showDirection;           // instead of the luminance
uniform float pixelScale;             // picture's pixels per drawn pixel
uniform vec2 pixelOffset;
uniform float largest;                // that the target can hold

out vec4 result;

vec4 sunDisc(vec3 direction, float elevation, float angle, float pixel)
{
    float cover = clamp((sunRadius - angle) / max(pixel, 1e-7) + 0.5, 0.0, 1.0);
    // The Moon takes its part of a pixel first: where both limbs cross one, nothing shines through between them.
    if (WHOLE_TURN && moonRadius > 0.0)
        cover -= clamp((moonRadius - angleBetween(direction, moonDirection)) / max(pixel, 1e-7) + 0.5, 0.0, 1.0);
    if (cover <= 0.0)
        return vec4(0.0);
    float x = min(angle / sunRadius, 1.0);
    vec4 limb = vec4(1.0);
    if (WHOLE_TURN) // limb darkening goes with eclipses
        limb = (1.0 + 0.5 * limbExponents) * pow(vec4(max(1.0 - x * x, 1e-6)), 0.5 * limbExponents);
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
    lookIntoMirror(direction, elevation);
    result = skyLight(direction, elevation);
#ifdef CITIES
    result += cityLight(direction, elevation);
#endif
    if (sunRadius > 0.0 && elevation >= horizon)
        result += sunDisc(direction, elevation, angleBetween(direction, sunDirection), pixelAngle);
    result = min(result, vec4(largest));
}
