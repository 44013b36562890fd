// Direct sunlight scattered once along each ray, for each Sun and azimuth, as luminance: sums what LitGather prepared,
// each species apart, without its phase function or (withPhase) with it.
#include "solve/rays.glsl"
#include "lib/sun.glsl"

uniform samplerBuffer lit;    // [ray of this dispatch][node][elevation][scatterer]: X / Y, log2 Y, Z / Y, scotopic / Y
uniform samplerBuffer phases; // [scatterer][angle][set]: the first wavelength's are those of all
uniform int elevations, angles;
uniform float sunRadius, elevationScale;
uniform int withPhase[SCATTERERS];
uniform int resultOffsets[SCATTERERS]; // in texels of the result buffer

void main()
{
    int first = (int(gl_GlobalInvocationID.y) + firstRay) * (nodes + 1) * 2;
    Sample s = sampleOfInvocation(texelFetch(rayNodes, first + 1).z);
    if (!s.valid)
        return;
    vec4 radiance[SCATTERERS];
    for (int i = 0; i < SCATTERERS; ++i)
        radiance[i] = vec4(0.0);
    vec4 node = texelFetch(rayNodes, first);
    float here = sunAbove(s, node), before = sunAbove(s, texelFetch(rayNodes, first + (nodes > 1 ? 2 : 0)));
    for (int k = 0; k < nodes; ++k) {
        vec4 next = texelFetch(rayNodes, first + 2 * k + 2); // behind the last node the ground, which nobody looks at
        float after = k + 1 < nodes ? sunAbove(s, next) : before, above = here, inverseRange = node.w;
        float visible = visibleAlong(before, here, after, sunRadius);
        before = here;
        here = after;
        node = next;
        if (visible <= 0.0)
            continue;
        float u = sunAxis(above, sunRadius, elevationScale, inverseRange) * float(elevations - 1);
        int e = min(int(u), elevations - 2);
        int at = ((int(gl_GlobalInvocationID.y) * nodes + k) * elevations + e) * SCATTERERS;
        for (int i = 0; i < SCATTERERS; ++i) {
            vec4 light = mix(texelFetch(lit, at + i), texelFetch(lit, at + SCATTERERS + i), u - float(e));
            radiance[i] += visible * exp2(light.y) * vec4(light.x, 1.0, light.zw);
        }
    }
    PhasePlace angle = phasePlace(s.nu, angles);
    for (int i = 0; i < SCATTERERS; ++i) {
        int at = (i * angles + angle.index) * totalSets;
        float phase = withPhase[i] != 0 ? mix(texelFetch(phases, at).x, texelFetch(phases, at + totalSets).x, angle.fraction) : 1.0;
        results[resultOffsets[i] + s.texel] = phase * radiance[i];
    }
}
