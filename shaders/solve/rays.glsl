// What the gathers share: which ray, Sun and azimuth an invocation is for, and where its result goes.
#include "lib/angles.glsl"

layout(local_size_x = 64) in;

// Wavelengths go four to a set. A dispatch serves SETS of the totalSets in all, from firstSet on; the last dispatch may meet fewer.
uniform int firstSet, totalSets;
int setIndex(int q) { return min(firstSet + q, totalSets - 1); }

uniform samplerBuffer sunCosines;     // [suns], cosine of the Sun's zenith angle at the ray's start
uniform samplerBuffer azimuthCosines; // [azimuths], cos(phi) from the Sun's azimuth
// Of direct light [ray][node, then the ground]: sunScale, nuScale, elevation of the horizon (rad), inverse range of the elevation axis, then row of
// the table of sunlight, fraction of a row, mu, hits the ground. Of scattered light [station]: sunScale, nuScale, mu.
uniform samplerBuffer rayNodes;
uniform int suns, azimuths, nodes, firstRay;
uniform ivec3 strides; // of the result, in texels: ray, sun, azimuth
layout(std430, binding = 0) buffer Results { vec4 results[]; };

#ifdef LUMINANCE
uniform vec4 luminance[4 * SETS]; // one wavelength's X, Y, Z, scotopic for unit radiance, solar irradiance included
#endif

struct Sample {
    int ray;      // of the batch
    float muSun;
    float nu;
    int texel;
    bool valid;
};

Sample sampleOfInvocation(float rayMu)
{
    int item = int(gl_GlobalInvocationID.x), sun = item / azimuths, azimuth = item % azimuths;
    Sample s;
    s.valid = sun < suns;
    s.ray = firstRay + int(gl_GlobalInvocationID.y);
    s.muSun = texelFetch(sunCosines, min(sun, suns - 1)).x;
    float c = texelFetch(azimuthCosines, azimuth).x;
    s.nu = clamp(rayMu * s.muSun + sqrt(max(0.0, (1.0 - rayMu * rayMu) * (1.0 - s.muSun * s.muSun))) * c, -1.0, 1.0);
    s.texel = s.ray * strides.x + sun * strides.y + azimuth * strides.z;
    return s;
}

// Elevation of the Sun's centre above the horizon of a node of the direct light, rad; `node` is its first texel.
float sunAbove(Sample s, vec4 node) { return elevationOf(clamp(node.x * s.muSun + node.y * s.nu, -1.0, 1.0)) - node.z; }

// Spectral results: set q of a texel.
void storeSet(int texel, int q, vec4 radiance)
{
    if (firstSet + q < totalSets)
        results[texel * totalSets + firstSet + q] = radiance;
}

#ifdef LUMINANCE
vec4 toLuminance(vec4 radiance[SETS])
{
    vec4 sum = vec4(0.0);
    for (int q = 0; q < SETS; ++q)
        sum += radiance[q].x * luminance[4 * q] + radiance[q].y * luminance[4 * q + 1] + radiance[q].z * luminance[4 * q + 2]
             + radiance[q].w * luminance[4 * q + 3];
    return sum;
}

// Luminance sums over the dispatches; `luminance` is zero for sets beyond the last.
void storeLuminance(int texel, vec4 radiance[SETS])
{
    vec4 sum = toLuminance(radiance);
    results[texel] = firstSet > 0 ? results[texel] + sum : sum;
}
#endif

// Place in a table of phase functions, whose angles are pi (k / (count - 1))^3.
struct PhasePlace {
    int index;
    float fraction;
};

PhasePlace phasePlace(float nu, int count)
{
    float position = pow(max(0.0, 0.5 - elevationOf(nu) / (2.0 * halfPi)), 1.0 / 3.0) * float(count - 1);
    PhasePlace place;
    place.index = min(int(position), count - 2);
    place.fraction = position - float(place.index);
    return place;
}
