// Half the size: each texel a tent over 4 x 4 of the larger picture.
uniform sampler2D larger;
uniform vec2 size; // of the target, texels
uniform float factor;
uniform float largest; // that the target can hold

out vec4 result;

void main()
{
    vec2 texel = 1.0 / vec2(textureSize(larger, 0));
    vec2 middle = gl_FragCoord.xy / size;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i)
        sum += texture(larger, middle + texel * vec2(float(i & 1) - 0.5, float(i >> 1) - 0.5) * 1.5);
    result = min(sum * (0.25 * factor), vec4(largest));
}
