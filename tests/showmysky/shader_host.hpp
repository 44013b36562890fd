#pragma once
// A host's own program around the GLSL functions of the library, and what their light is compared with.

#include "sky_for_tests.hpp"

#include "atmosphere.hpp"
#include "gl/framebuffer.hpp"
#include "gl/program.hpp"
#include "physics/sky.hpp"
#include "sky_shaders.hpp"

namespace showmysky::testing {

namespace gl = sky::gl;
namespace physics = sky::physics;

/// A host program with names that the library uses inside: whatever `expression` says, at direction `d`.
class Host
{
public:
    Host(const gl::Api& api, const Sky& sky, const std::string& expression, int width, int height)
        : picture_(api, "host's", api.isEs() ? gl::TextureFormat::rgba16f : gl::TextureFormat::rgba32f, width, height),
          target_(api, "host's"), triangle_(api, "host's"), program_(build(api, sky, expression))
    {
        target_.attach(0, picture_);
        program_.set("size", std::array<float, 2>{static_cast<float>(width), static_cast<float>(height)});
    }

    std::vector<Luminance> draw(Sky& sky)
    {
        sky.bindShaderFunctions(program_.name(), 4);
        const gl::Bound target(target_);
        const gl::Bound pass(program_);
        triangle_.drawFullScreenTriangle();
        const auto values = target_.readPixels(0);
        std::vector<Luminance> result;
        for (std::size_t i = 0; i < values.size(); i += 4)
            result.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
        return result;
    }
    /// At one direction.
    Luminance ask(Sky& sky, const std::array<double, 3>& direction, double distance)
    {
        program_.set("wanted", std::array<float, 3>{static_cast<float>(direction[0]), static_cast<float>(direction[1]),
                                                    static_cast<float>(direction[2])});
        program_.set("metres", static_cast<float>(distance));
        return draw(sky).front();
    }

private:
    static gl::Program build(const gl::Api& api, const Sky& sky, const std::string& expression)
    {
        const std::string fragment = sky.shaderFunctions() + R"(
const float halfPi = 3.0; // the host's own names
uniform vec3 horizon, wanted;
uniform float metres;
uniform vec2 size;
out vec4 colour;
float elevationOf(vec2 p) { return p.y; }
void main()
{
    vec2 p = (gl_FragCoord.xy / size - 0.5) * vec2(6.28318531, 3.14159265);
    vec3 d = vec3(cos(p.y) * cos(p.x), -cos(p.y) * sin(p.x), sin(elevationOf(p)));
    if (dot(wanted, wanted) > 0.0)
        d = wanted;
    colour = )" + expression + ";\n}\n";
        return gl::ProgramBuilder(api,
                                  [&](std::string_view path) -> std::string_view {
                                      return path == "host.frag" ? std::string_view(fragment)
                                                                 : sky::shaders::source("render/triangle.vert");
                                  })
            .graphics("host", "host.vert", "host.frag");
    }

    gl::Texture2D picture_;
    gl::Framebuffer target_;
    gl::VertexArray triangle_;
    gl::Program program_;
};

/// What the air lets through between a camera and a point of its line of sight, [wavelength].
///   mu, muThere  cosines of the line's zenith angle at both
inline std::vector<double> transmittanceBetween(const Atmosphere& atmosphere, double altitude, double mu, double altitudeThere,
                                                double muThere)
{
    // Columns of a line that misses the ground, in the sense in which it does.
    const auto species = static_cast<std::size_t>(atmosphere.optics.species);
    const auto wavelengths = static_cast<std::size_t>(atmosphere.wavelengths());
    physics::RayTracer tracer(atmosphere.profile, atmosphere.optics);
    std::vector<double> outer(species), inner(species), result;
    const bool up = !physics::hitsGround(atmosphere.planet(), altitude, mu) && muThere > 0 && mu > 0;
    tracer.columns(up ? altitude : altitudeThere, up ? mu : -muThere, outer.data());
    tracer.columns(up ? altitudeThere : altitude, up ? muThere : -mu, inner.data());
    for (std::size_t w = 0; w < wavelengths; ++w) {
        double depth = 0;
        for (std::size_t s = 0; s < species; ++s)
            depth += (outer[s] - inner[s]) * atmosphere.optics.extinction[s * wavelengths + w];
        result.push_back(std::exp(-depth));
    }
    return result;
}

inline double relative(float a, float b) { return std::abs(static_cast<double>(a) / static_cast<double>(b) - 1); }

} // namespace showmysky::testing
