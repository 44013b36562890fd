// One level of the veil: its own light and the smoothed sum of all coarser levels.
uniform sampler2D own;
uniform sampler2D coarser;
uniform vec2 size; // of the target, texels
uniform float ownWeight;
uniform float coarserWeight;

out vec4 result;

void main()
{
    vec2 place = gl_FragCoord.xy / size;
    vec2 texel = 0.5 / vec2(textureSize(coarser, 0));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i)
        sum += texture(coarser, place + texel * vec2(float(i & 1) * 2.0 - 1.0, float(i >> 1) * 2.0 - 1.0));
    result = ownWeight * texture(own, place) + coarserWeight * 0.25 * sum;
}
