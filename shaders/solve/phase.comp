// Direct sunlight scattered once along each ray, from sunlight that direct.comp (LIGHT_APART) gathered at fewer azimuths. Sunlight changes slowly with
// azimuth, a phase function of high degree does not: it is met here, at all azimuths.
#include "solve/rays.glsl"
#include "solve/phase_series.glsl"

uniform samplerBuffer azimuthWeights; // [azimuth][azimuth of the light]
uniform int lightAzimuths, rays;      // rays: of the batch
layout(std430, binding = 1) readonly buffer Light { vec4 light[]; }; // [scatterer, then ground][ray][sun][azimuth of the light][set]

void main()
{
    int ray = int(gl_GlobalInvocationID.y) + firstRay;
    Sample s = sampleOfInvocation(texelFetch(rayNodes, ray * (nodes + 1) * 2 + 1).z);
    if (!s.valid)
        return;
    int item = int(gl_GlobalInvocationID.x), sun = item / azimuths, azimuth = item % azimuths;
    vec4 total[SETS];
    for (int q = 0; q < SETS; ++q)
        total[q] = vec4(0.0);
    for (int i = 0; i <= SCATTERERS; ++i) {
        vec4 lit[SETS];
        for (int q = 0; q < SETS; ++q)
            lit[q] = vec4(0.0);
        for (int k = 0; k < lightAzimuths; ++k) {
            float weight = texelFetch(azimuthWeights, azimuth * lightAzimuths + k).x;
            int at = (((i * rays + ray) * suns + sun) * lightAzimuths + k) * totalSets;
            for (int q = 0; q < SETS; ++q)
                lit[q] += weight * light[at + setIndex(q)];
        }
        if (i < SCATTERERS)
            scatter(i, lit, s.nu, total);
        else
            for (int q = 0; q < SETS; ++q)
                total[q] += lit[q];
    }
    for (int q = 0; q < SETS; ++q)
        storeSet(s.texel, q, max(total[q], vec4(0.0))); // cut series may undershoot
}
