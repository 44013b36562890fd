// Direct sunlight scattered once along each ray, for each Sun and azimuth:  sum over nodes of w_ki T_sun(node k).
// FIELD (GROUND_ONLY: its second part): all species together, phase functions cut at DEGREE, and the sunlit ground: what starts the source iteration.
// FIELD and LIGHT_APART: the same without phase functions, each species and then the ground apart, for phase.comp.
// Otherwise each species apart, without its phase function or (withPhase) with the exact one.
#include "solve/rays.glsl"
#include "lib/sun.glsl"

uniform samplerBuffer sunDepths; // [altitude, then the ground with its cosine][elevation][set]: optical depth towards the visible part of the Sun
uniform samplerBuffer weights;   // [ray][node][scatterer][set]
uniform samplerBuffer ground;    // [ray][set]: transmittance times albedo / pi
uniform int elevations;
uniform float sunRadius, elevationScale;
#if !defined(FIELD)
uniform samplerBuffer phases; // [scatterer][angle][set]
uniform int angles;
uniform int withPhase[SCATTERERS];
#elif !defined(LIGHT_APART)
#include "solve/phase_series.glsl"
#endif
#if !defined(FIELD) || defined(LIGHT_APART)
uniform int resultOffsets[SCATTERERS + 1]; // in texels of the result buffer; the last for the ground
#endif

// Sunlight of the visible part of the disc; `place` is the row of the table and the fraction of a row.
void sunlight(float visible, float above, float inverseRange, vec2 place, out vec4 light[SETS])
{
    for (int q = 0; q < SETS; ++q)
        light[q] = vec4(0.0);
    if (visible <= 0.0)
        return;
    float u = sunAxis(above, sunRadius, elevationScale, inverseRange) * float(elevations - 1);
    int k = min(int(u), elevations - 2);
    float x = u - float(k);
    int near = (int(place.x) * elevations + k) * totalSets, far = near + elevations * totalSets;
    for (int q = 0; q < SETS; ++q) {
        int set = setIndex(q);
        vec4 low = mix(texelFetch(sunDepths, near + set), texelFetch(sunDepths, near + totalSets + set), x);
        vec4 high = mix(texelFetch(sunDepths, far + set), texelFetch(sunDepths, far + totalSets + set), x);
        light[q] = visible * exp(-mix(low, high, place.y));
    }
}

void main()
{
    int first = (int(gl_GlobalInvocationID.y) + firstRay) * (nodes + 1) * 2;
    Sample s = sampleOfInvocation(texelFetch(rayNodes, first + 1).z);
    if (!s.valid)
        return;
    vec4 lit[SCATTERERS * SETS];
    for (int i = 0; i < SCATTERERS * SETS; ++i)
        lit[i] = vec4(0.0);
    vec4 light[SETS];
#ifndef GROUND_ONLY
    vec4 node = texelFetch(rayNodes, first);
    float here = sunAbove(s, node), before = sunAbove(s, texelFetch(rayNodes, first + (nodes > 1 ? 2 : 0)));
    for (int k = 0; k < nodes; ++k) {
        vec4 next = texelFetch(rayNodes, first + 2 * k + 2);
        float after = k + 1 < nodes ? sunAbove(s, next) : before;
        sunlight(visibleAlong(before, here, after, sunRadius), here, node.w, texelFetch(rayNodes, first + 2 * k + 1).xy, light);
        before = here;
        here = after;
        node = next;
        int w = (s.ray * nodes + k) * SCATTERERS * totalSets;
        for (int i = 0; i < SCATTERERS; ++i)
            for (int q = 0; q < SETS; ++q)
                lit[i * SETS + q] += texelFetch(weights, w + i * totalSets + setIndex(q)) * light[q];
    }
#endif
#ifdef FIELD
    vec4 total[SETS];
    for (int q = 0; q < SETS; ++q)
        total[q] = vec4(0.0);
    for (int i = 0; i < SCATTERERS; ++i) {
        vec4 one[SETS];
        for (int q = 0; q < SETS; ++q)
            one[q] = lit[i * SETS + q];
#ifdef LIGHT_APART
        for (int q = 0; q < SETS; ++q)
            storeSet(resultOffsets[i] + s.texel, q, one[q]);
#else
        scatter(i, one, s.nu, total);
#endif
    }
    vec4 place = texelFetch(rayNodes, first + 2 * nodes + 1);
    if (place.w > 0.0) {
        vec4 there = texelFetch(rayNodes, first + 2 * nodes);
        float muSun = clamp(there.x * s.muSun + there.y * s.nu, -1.0, 1.0);
        float elevation = elevationOf(muSun), above = elevation - there.z;
        sunlight(visibleDiscFraction(above, sunRadius), above, there.w, place.xy, light);
        float cosine = horizontalSunCosine(muSun, elevation, sunRadius);
        for (int q = 0; q < SETS; ++q)
            total[q] += texelFetch(ground, s.ray * totalSets + setIndex(q)) * cosine * light[q];
    }
#ifdef LIGHT_APART
    for (int q = 0; q < SETS; ++q)
        storeSet(resultOffsets[SCATTERERS] + s.texel, q, total[q]);
#else
    for (int q = 0; q < SETS; ++q)
        storeSet(s.texel, q, max(total[q], vec4(0.0))); // a cut series may undershoot
#endif
#else
    PhasePlace angle = phasePlace(s.nu, angles);
    for (int i = 0; i < SCATTERERS; ++i) {
        vec4 radiance[SETS];
        for (int q = 0; q < SETS; ++q) {
            radiance[q] = lit[i * SETS + q];
            int at = (i * angles + angle.index) * totalSets + setIndex(q);
            if (withPhase[i] != 0)
                radiance[q] *= mix(texelFetch(phases, at), texelFetch(phases, at + totalSets), angle.fraction);
        }
#ifdef LUMINANCE
        storeLuminance(resultOffsets[i] + s.texel, radiance);
#else
        for (int q = 0; q < SETS; ++q)
            storeSet(resultOffsets[i] + s.texel, q, radiance[q]);
#endif
    }
#endif
}
