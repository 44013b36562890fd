// The Sun's disc as the air leaves it, and what the Moon leaves of that.
#include "render/sky_light.glsl"

uniform vec4 sunColours[SUN_COLOURS]; // luminance of the disc from its lower to its upper edge
uniform float sunRadius;              // rad
uniform vec3 moonDirection;
uniform float moonRadius;             // rad; 0 where there is no eclipse
uniform vec4 limbExponents;           // of X, Y, Z and scotopic luminance; 0 for a uniform disc

// Luminance in a direction (unit vector) above the horizon, averaged over a pixel whose side is seen under `pixel` rad.
vec4 sunDisc(vec3 direction, float elevation, float pixel)
{
    float angle = angleBetween(direction, sunDirection);
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
