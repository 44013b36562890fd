// Folds what depends on a ray alone into azimuthal terms per node and elevation of the Sun (lib/scattered.glsl), so that the
// gather meets DEGREE + 1 numbers instead of (DEGREE + 1)(DEGREE + 2) / 2.
layout(local_size_x = 64) in;

const int terms = DEGREE + 1;
const int harmonics = terms * (terms + 1) / 2;

uniform samplerBuffer field;        // [altitude][sun][lm][set]: log2 I_00, then I_lm / I_00
uniform samplerBuffer groundField;  // [sun][set]: log2 of the diffuse irradiance of the ground
uniform samplerBuffer altitudeStencils; // [ray][node][2]: levels, weights
uniform samplerBuffer coefficients; // [ray][node][l][set]: sum over species of weight lambda_l
uniform samplerBuffer factors;      // [ray][node][lm]: zenith-angle factor of the harmonic, one float
uniform samplerBuffer ground;       // [ray][set]: transmittance times albedo / pi
layout(std430, binding = 0) writeonly buffer Source { vec4 source[]; }; // [ray][node][sun][1 + term][set]

uniform int suns, nodes, firstRay;

void main()
{
    int item = int(gl_GlobalInvocationID.x), set = item % SETS, sun = item / SETS;
    if (sun >= suns)
        return;
    int place = int(gl_GlobalInvocationID.y), ray = firstRay + place / (nodes + 1), node = place % (nodes + 1);
    int target = (place * suns + sun) * (terms + 1) * SETS + set;

    vec4 g[terms];
    for (int m = 0; m < terms; ++m)
        g[m] = vec4(0.0);
    vec4 logarithm = vec4(0.0);
    if (node == nodes) {
        logarithm = texelFetch(groundField, sun * SETS + set);
        g[0] = texelFetch(ground, ray * SETS + set);
    } else {
        int at = ray * nodes + node;
        vec4 levels = texelFetch(altitudeStencils, 2 * at), weights = texelFetch(altitudeStencils, 2 * at + 1);
        ivec4 base = (ivec4(levels) * suns + sun) * (harmonics * SETS) + set;
        logarithm = weights.x * texelFetch(field, base.x) + weights.y * texelFetch(field, base.y)
                  + weights.z * texelFetch(field, base.z) + weights.w * texelFetch(field, base.w);
        for (int l = 0; l < terms; ++l) {
            vec4 c = texelFetch(coefficients, (at * terms + l) * SETS + set);
            for (int m = 0; m <= l; ++m) {
                int lm = l * (l + 1) / 2 + m;
                vec4 ratio = vec4(1.0);
                if (lm > 0) {
                    ivec4 i = base + lm * SETS;
                    ratio = weights.x * texelFetch(field, i.x) + weights.y * texelFetch(field, i.y)
                          + weights.z * texelFetch(field, i.z) + weights.w * texelFetch(field, i.w);
                }
                g[m] += c * ratio * texelFetch(factors, at * harmonics + lm).x;
            }
        }
    }
    source[target] = logarithm;
    for (int m = 0; m < terms; ++m)
        source[target + (m + 1) * SETS] = g[m];
}
