// From X, Y, Z and scotopic luminance, times an exposure, to what a screen shows.

// Linear sRGB (IEC 61966-2-1 primaries, white D65); twin: physics::linearSrgb.
vec3 linearSrgb(vec3 xyz)
{
    return vec3(dot(xyz, vec3(3.2409699419, -1.5373831776, -0.4986107603)),
                dot(xyz, vec3(-0.9692436363, 1.8759675015, 0.0415550574)),
                dot(xyz, vec3(0.0556300797, -0.2039769589, 1.0569715142)));
}

// Luminance of linear sRGB: the second row of the inverse matrix.
float luminanceOf(vec3 colour)
{
    return dot(colour, vec3(0.2126390059, 0.7151686788, 0.0721923154));
}

// Towards grey of the same luminance until no component is negative.
vec3 intoGamut(vec3 colour, float luminance)
{
    float lowest = min(colour.r, min(colour.g, colour.b));
    float keep = lowest < 0.0 ? luminance / (luminance - lowest) : 1.0;
    return max(vec3(0.0), luminance + keep * (colour - luminance));
}

// Towards grey of the same luminance, in the end white, until no component is above one.
vec3 clippedGradually(vec3 colour)
{
    float luminance = luminanceOf(colour);
    float highest = max(colour.r, max(colour.g, colour.b));
    if (highest <= 1.0)
        return colour;
    if (luminance >= 1.0)
        return vec3(1.0);
    return luminance + (1.0 - luminance) / (highest - luminance) * (colour - luminance);
}

const int curveExponential = 0, curveReinhard = 1, curveLinear = 2;

// colour: linear, not negative; luminance: its Y.
vec3 toneMapped(vec3 colour, float luminance, int curve)
{
    // As film does: a little more contrast, and thereby colour, about a middle tone; then light that saturates.
    // A trace of light leaks between the channels, so that what is far too bright, the Sun itself, ends white.
    const float middle = 0.3, leak = 0.01;
    if (curve == curveExponential) {
        vec3 leaked = mix(colour, vec3(luminance), leak);
        return 1.0 - exp(-leaked * sqrt(sqrt(leaked / middle))); // the contrast: to the power of 5/4 about the middle
    }
    if (curve == curveReinhard)
        return colour / (1.0 + luminance);
    return colour;
}

// Of linear sRGB that is not negative; black for black.
vec3 pureHue(vec3 colour)
{
    vec3 saturated = colour - min(colour.r, min(colour.g, colour.b));
    float highest = max(saturated.r, max(saturated.g, saturated.b));
    return highest > 0.0 ? saturated / highest : vec3(0.0);
}

vec3 overSum(vec3 colour)
{
    float sum = colour.r + colour.g + colour.b;
    return sum > 0.0 ? colour / sum : vec3(0.0);
}

vec3 overLargest(vec3 colour)
{
    float highest = max(colour.r, max(colour.g, colour.b));
    return highest > 0.0 ? colour / highest : vec3(0.0);
}

// In the order of showmysky::app::ColourMode.
const int modeSrgb = 0, modePhotopic = 1, modeScotopic = 2, modeXyzSmooth = 3, modeXyzBright = 4, modeSrgbSmooth = 5,
          modeSrgbBright = 6, modeHue = 7, modeX = 8, modeZ = 9, modeRed = 10, modeGreen = 11, modeBlue = 12;

// Linear 0..1 by channel, from X, Y, Z, scotopic luminance times the exposure.
vec3 shownColour(vec4 luminance, int mode, int curve, bool gradual)
{
    if (mode == modeXyzSmooth)
        return overSum(luminance.xyz);
    if (mode == modeXyzBright)
        return overLargest(luminance.xyz);
    vec3 colour = intoGamut(linearSrgb(luminance.xyz), luminance.y);
    if (mode == modeSrgbSmooth)
        return overSum(colour);
    if (mode == modeSrgbBright)
        return overLargest(colour);
    if (mode == modeHue)
        return pureHue(colour);
    if (mode == modeSrgb) {
        vec3 mapped = toneMapped(colour, luminance.y, curve);
        return min(vec3(1.0), gradual ? clippedGradually(mapped) : mapped);
    }
    float grey = mode == modePhotopic ? luminance.y
               : mode == modeScotopic ? luminance.w
               : mode == modeX        ? luminance.x
               : mode == modeZ        ? luminance.z
               : mode == modeRed      ? colour.r
               : mode == modeGreen    ? colour.g
                                      : colour.b;
    return min(vec3(1.0), toneMapped(vec3(grey), grey, curve));
}

// sRGB's transfer function for 0..1; twin: physics::encodeSrgb.
vec3 encodeSrgb(vec3 linear)
{
    vec3 curved = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(curved, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

// Threshold of an 8 x 8 ordered dither (Bayer 1973), 0..1 exclusive.
float orderedThreshold(ivec2 pixel)
{
    int value = 0;
    for (int bit = 0; bit < 3; ++bit) {
        int a = (pixel.x >> bit) & 1, b = (pixel.y >> bit) & 1;
        value |= ((a ^ b) << (5 - 2 * bit)) | (b << (4 - 2 * bit));
    }
    return (float(value) + 0.5) / 64.0;
}

// To 0, 1/steps .. 1: up where what is left over a step is above 1 - threshold. Uniform thresholds keep the mean; 1/2 rounds.
vec3 quantised(vec3 encoded, vec3 steps, float threshold)
{
    return min(vec3(1.0), floor(encoded * steps + threshold) / steps);
}
