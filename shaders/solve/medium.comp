// Evaluates the description's code blocks once: number densities over altitude, phase functions over the scattering angle.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Arguments { float arguments[]; };
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; };

uniform vec4 wavelengths; // nm
uniform int count;
uniform bool phase;

const float nm = 1e-9, um = 1e-6, mm = 1e-3, m = 1.0, km = 1e3, Mm = 1e6, Gm = 1e9, AU = 149597870700.0;
const float PI = 3.14159265358979;
const float dobsonUnit = 2.687e20; // m^-2
const float earthRadius = EARTH_RADIUS;
const float atmosphereHeight = ATMOSPHERE_HEIGHT;
#define CONST const
float sqr(float x) { return x * x; }
vec2 sqr(vec2 x) { return x * x; }
vec3 sqr(vec3 x) { return x * x; }
vec4 sqr(vec4 x) { return x * x; }

// numberDensityOf(species, altitude) and phaseFunctionOf(species, cosine), made around the code blocks.
#include "generated/medium_functions.glsl"

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    int species = int(gl_GlobalInvocationID.y);
    if (i >= count)
        return;
    results[species * count + i] = phase ? phaseFunctionOf(species, arguments[i])
                                         : vec4(numberDensityOf(species, arguments[i]), 0.0, 0.0, 0.0);
}
