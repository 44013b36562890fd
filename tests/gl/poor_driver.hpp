#pragma once
// Functions as bad as drivers may have them, in GLSL, to be put into every shader (ShaderInterceptor).

#include <string>
#include <vector>

namespace sky::gl::testing {

/// A driver that uses up what "Precision and Operation of SPIR-V Instructions" of the Vulkan specification allows; GLSL 4.60, 4.7.1, says
/// the same where it says anything:
///     exp, exp2       (3 + 2 |x|) ULP                        sin, cos   2^-11 within -pi .. pi
///     log, log2       3 ULP, 2^-21 within 0.5 .. 2           sqrt       1 / inversesqrt
///     pow             exp2(y log2(x))                        length, normalize   by sqrt
///     inversesqrt     2 ULP                                  atan       4096 ULP
///     asin, acos      by atan and sqrt                       tan, sinh, cosh, tanh   by sin, cos and exp
/// and filters textures with weights of 8 bits, as many GPUs do.
///   noise  -1..1 from the argument x, as a GLSL expression: what share of the permitted error is made
///   sine   the largest error of sin and cos
inline std::string poorDriver(const std::string& noise, const std::string& sine = "4.8828125e-4")
{
    std::string text = R"(
uint poor_mixed(uint h) { h ^= h >> 16; h *= 0x7feb352du; h ^= h >> 15; h *= 0x846ca68bu; return h ^ (h >> 16); }
float poor_random(float x) { return float(poor_mixed(floatBitsToUint(x)) >> 8) / 8388608.0 - 1.0; }
float poor_noise(float x) { return NOISE; }
const float poor_ulp = 1.1920929e-7;
float poor_exp(float x) { return exp(x) * (1.0 + poor_ulp * (3.0 + 2.0 * min(abs(x), 150.0)) * poor_noise(x)); }
float poor_exp2(float x) { return exp2(x) * (1.0 + poor_ulp * (3.0 + 2.0 * min(abs(x), 150.0)) * poor_noise(x)); }
float poor_log(float x) { return x > 0.5 && x < 2.0 ? log(x) + 4.76837e-7 * poor_noise(x) : log(x) * (1.0 + 3.0 * poor_ulp * poor_noise(x)); }
float poor_log2(float x) { return x > 0.5 && x < 2.0 ? log2(x) + 4.76837e-7 * poor_noise(x) : log2(x) * (1.0 + 3.0 * poor_ulp * poor_noise(x)); }
float poor_inversesqrt(float x) { return inversesqrt(x) * (1.0 + 2.0 * poor_ulp * poor_noise(x)); }
float poor_sqrt(float x) { return 1.0 / poor_inversesqrt(x); }
float poor_pow(float x, float y) { return poor_exp2(y * poor_log2(x)); }
float poor_sin(float x) { return sin(x) + SINE * poor_noise(x); }
float poor_cos(float x) { return cos(x) + SINE * poor_noise(x); }
float poor_tan(float x) { return poor_sin(x) / poor_cos(x); }
float poor_atan(float x) { return atan(x) * (1.0 + 4096.0 * poor_ulp * poor_noise(x)); }
float poor_atan(float y, float x) { return atan(y, x) * (1.0 + 4096.0 * poor_ulp * poor_noise(x + y)); }
float poor_asin(float x) { return poor_atan(x, poor_sqrt(1.0 - x * x)); }
float poor_acos(float x) { return poor_atan(poor_sqrt(1.0 - x * x), x); }
float poor_sinh(float x) { return 0.5 * (poor_exp(x) - poor_exp(-x)); }
float poor_cosh(float x) { return 0.5 * (poor_exp(x) + poor_exp(-x)); }
float poor_tanh(float x) { return poor_sinh(x) / poor_cosh(x); }
float poor_length(vec2 v) { return poor_sqrt(dot(v, v)); }
float poor_length(vec3 v) { return poor_sqrt(dot(v, v)); }
vec3 poor_normalize(vec3 v) { return v / poor_length(v); }
vec4 poor_texture(sampler2D s, vec2 at)
{
    vec2 size = vec2(textureSize(s, 0)), x = at * size - 0.5, left = floor(x);
    return texture(s, (left + floor((x - left) * 256.0 + 0.5) / 256.0 + 0.5) / size);
}
vec4 poor_texture(sampler3D s, vec3 at)
{
    vec3 size = vec3(textureSize(s, 0)), x = at * size - 0.5, left = floor(x);
    return texture(s, (left + floor((x - left) * 256.0 + 0.5) / 256.0 + 0.5) / size);
}
)";
    const std::vector<std::string> ofOne{"exp", "exp2", "log",  "log2", "inversesqrt", "sqrt", "sin", "cos",
                                         "tan", "atan", "asin", "acos", "sinh",        "cosh", "tanh"};
    for (const std::string& f : ofOne)
        for (const char* type : {"vec2", "vec3", "vec4"}) {
            const std::string t = type;
            text += t + " poor_" + f + "(" + t + " x) { " + t + " y; for (int i = 0; i < " + t.back() + "; ++i) y[i] = poor_" + f +
                    "(x[i]); return y; }\n";
        }
    for (const char* type : {"vec2", "vec3", "vec4"}) {
        const std::string t = type;
        text += t + " poor_pow(" + t + " x, " + t + " y) { " + t + " z; for (int i = 0; i < " + t.back() +
                "; ++i) z[i] = poor_pow(x[i], y[i]); return z; }\n";
    }
    std::vector<std::string> all{"pow", "length", "normalize", "texture"};
    all.insert(all.end(), ofOne.begin(), ofOne.end());
    for (const std::string& function : all)
        text += "#define " + function + " poor_" + function + "\n";
    const auto put = [&](const std::string& word, const std::string& value) {
        for (std::size_t at; (at = text.find(word)) != std::string::npos;)
            text.replace(at, word.size(), value);
    };
    put("NOISE", noise);
    put("SINE", sine);
    return text;
}

} // namespace sky::gl::testing
