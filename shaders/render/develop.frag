// Luminance to the levels of a screen: exposure, glare, colours, dithering.
#include "lib/display.glsl"

uniform sampler2D luminance; // X, Y, Z, scotopic, cd m^-2
uniform sampler2D veil;      // light scattered by all angles, times the exposure
uniform sampler2D noise;     // blue noise, thresholds 0..1
uniform vec2 pictureOrigin;  // of the picture in the framebuffer, pixels
uniform vec2 pictureSize;    // in the framebuffer, pixels
uniform float exposure;      // factor
uniform float scatteredShare;
uniform int colourMode;
uniform int curve;
uniform bool gradual;
uniform int dithering;       // 0 none, 1 ordered, 2 blue noise
uniform vec3 steps;          // levels of each channel, less one

out vec4 result;

void main()
{
    vec2 position = gl_FragCoord.xy - pictureOrigin;
    vec4 light = texture(luminance, position / pictureSize) * exposure;
    if (scatteredShare > 0.0)
        light = mix(light, texture(veil, position / pictureSize), scatteredShare);
    vec3 encoded = encodeSrgb(shownColour(light, colourMode, curve, gradual));
    ivec2 pixel = ivec2(position);
    float threshold = 0.5;
    if (dithering == 1)
        threshold = orderedThreshold(pixel);
    else if (dithering == 2)
        threshold = texelFetch(noise, pixel % textureSize(noise, 0), 0).r;
    result = vec4(quantised(encoded, steps, threshold), 1.0);
}
