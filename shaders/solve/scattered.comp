// Radiance of light that has been scattered or reflected before, along each ray, for each Sun and azimuth. The source may hold
// luminance instead: one "set" of X, Y, Z and scotopic, to which the same sums apply.
#include "solve/rays.glsl"
#include "lib/sun.glsl"
#include "lib/scattered.glsl"

uniform samplerBuffer rays;   // [ray]: first station, their number, mu at the start
uniform samplerBuffer source; // [station of this dispatch][sun][1 + term][set], from fold()
uniform int fieldSuns, terms, firstStation; // terms: azimuthal orders
uniform vec3 sunAxisOfField; // see momentAxis

void main()
{
    int first = int(gl_GlobalInvocationID.y) + firstRay;
    vec4 ray = texelFetch(rays, first);
    Sample s = sampleOfInvocation(ray.z);
    if (!s.valid)
        return;
    int begin = int(ray.x), end = begin + int(ray.y);

    vec4 total[SETS];
    for (int q = 0; q < SETS; ++q)
        total[q] = vec4(0.0);
    for (int k = begin; k < end; ++k) {
        vec4 node = texelFetch(rayNodes, k);
        float muSun = clamp(node.x * s.muSun + node.y * s.nu, -1.0, 1.0);
        float position = momentAxis(elevationOf(muSun), sunAxisOfField) * float(fieldSuns - 1);
        int sun = min(int(position), fieldSuns - 2);
        float x = position - float(sun);
        float c = azimuthCosine(node.z, muSun, s.nu);
        int at = ((k - firstStation) * fieldSuns + sun) * (terms + 1) * totalSets;
        int next = (terms + 1) * totalSets;
        for (int q = 0; q < SETS; ++q) {
            int set = at + setIndex(q);
            vec4 level = exp2(mix(texelFetch(source, set), texelFetch(source, set + next), x));
            vec4 sum = vec4(0.0);
            float wave = 1.0, before = c; // cos(m phi), cos((m - 1) phi)
            for (int m = 0; m < terms; ++m) {
                int i = set + (m + 1) * totalSets;
                sum += wave * mix(texelFetch(source, i), texelFetch(source, i + next), x);
                float after = 2.0 * c * wave - before;
                before = wave;
                wave = after;
            }
            total[q] += level * sum;
        }
    }
    for (int q = 0; q < SETS; ++q)
        total[q] = max(total[q], vec4(0.0)); // a series cut at DEGREE may undershoot beside a bright peak
    for (int q = 0; q < SETS; ++q)
        storeSet(s.texel, q, total[q]);
}
