// One direction per pixel: its place in the tables of this sky, the exact phase functions, the Sun.
// vec3 viewDirection(vec2 position) comes from the host, or from render/projections.glsl.
#include "render/city_light.glsl"
#include "render/sky_light.glsl"
#include "render/sun_disc.glsl"
#include "user:viewDirection"

uniform bool showSun;
uniform bool showDirection; // instead of the luminance
uniform float pixelScale;   // picture's pixels per drawn pixel
uniform vec2 pixelOffset;
uniform float largest;      // that the target can hold

out vec4 result;

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
    if (showSun && elevation >= horizon)
        result += sunDisc(direction, elevation, pixelAngle);
    result = min(result, vec4(largest));
}
