// A few pixels of a picture, evenly spread.
uniform sampler2D picture;
uniform vec2 size; // of the target, pixels

out vec4 result;

void main()
{
    result = texelFetch(picture, ivec2(gl_FragCoord.xy / size * vec2(textureSize(picture, 0))), 0);
}
