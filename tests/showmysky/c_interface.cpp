// The plain C interface: what it adds to the C++ one is pointers, numbers in place of enumerations, and sentences in place of exceptions.

#include "gl/framebuffer.hpp"
#include "gl/program.hpp"
#include "showmysky/sky.h"
#include "sky_for_tests.hpp"
#include "sky_shaders.hpp"
#include <catch2/catch.hpp>
#include <memory>
#include <string>

using namespace showmysky;
using namespace showmysky::testing;
namespace gl = sky::gl;

namespace {

/// A loaded sky in a context.
struct Opened {
    gl::HeadlessContext context{desktop()};
    gl::Loader loader = context.loader();
    std::unique_ptr<showmysky_sky, decltype(&showmysky_close)> sky{
        showmysky_open(
            SHOWMYSKY_TEST_MODEL, [](const char* name, void* user) { return (*static_cast<gl::Loader*>(user))(name); }, &loader, nullptr),
        showmysky_close};

    Opened()
    {
        REQUIRE(sky);
        REQUIRE(showmysky_load_all(sky.get()));
    }
    operator showmysky_sky*() const { return sky.get(); }
};

showmysky_scene defaultScene()
{
    showmysky_scene scene;
    showmysky_default_scene(&scene);
    return scene;
}

} // namespace

TEST_CASE("C interface: a host's program with the functions draws what the library draws", "[gl]")
{
    constexpr int width = 64, height = 32;
    const Opened sky;
    const auto& api = sky.context.api();
    const char* functions = showmysky_shader_functions(sky);
    REQUIRE(functions);
    const std::string fragment = std::string(functions) + R"(
out vec4 colour;
void main()
{
    vec2 p = (gl_FragCoord.xy / vec2(64.0, 32.0) - 0.5) * vec2(6.28318531, 3.14159265);
    colour = showmyskyRadiance(vec3(cos(p.y) * cos(p.x), -cos(p.y) * sin(p.x), sin(p.y)));
}
)";
    const auto program = gl::ProgramBuilder(api, [&](std::string_view path) -> std::string_view {
                             return path == "host.frag" ? std::string_view(fragment) : sky::shaders::source("render/triangle.vert");
                         }).graphics("host", "host.vert", "host.frag");
    gl::Texture2D picture(api, "host's", gl::TextureFormat::rgba32f, width, height);
    gl::Framebuffer target(api, "host's");
    target.attach(0, picture);
    const gl::VertexArray triangle(api, "host's");

    auto scene = defaultScene();
    scene.altitude = 2000;
    REQUIRE(showmysky_set_scene(sky, &scene));
    for (int done = 0; !done;)
        REQUIRE(showmysky_prepare_step(sky, &done, nullptr));
    REQUIRE(showmysky_bind_shader_functions(sky, program.name(), 2));
    {
        const gl::Bound bound(target);
        const gl::Bound pass(program);
        triangle.drawFullScreenTriangle();
    }
    const auto values = target.readPixels(0);
    const showmysky_camera camera{SHOWMYSKY_EQUIRECTANGULAR, 360 * degree, 0, 0, 0};
    REQUIRE(showmysky_draw(sky, &camera, width, height, 1));
    for (int y = 0; y < height; y += 3)
        for (int x = 1; x < width; x += 5) {
            showmysky_luminance expected;
            REQUIRE(showmysky_pixel_luminance(sky, x, y, &expected));
            const float* found = &values[static_cast<std::size_t>(4 * (y * width + x))];
            CHECK(found[1] == Approx(double(expected.y)).epsilon(1e-3));
            CHECK(found[3] == Approx(double(expected.scotopic)).epsilon(1e-3));
        }

    CHECK_FALSE(showmysky_bind_shader_functions(sky, 123456, 0));
    CHECK(std::string(showmysky_error()).find("no linked OpenGL program of number 123456") != std::string::npos);
    CHECK_FALSE(showmysky_bind_shader_functions(sky, program.name(), 100000));
    CHECK(std::string(showmysky_error()).find("texture units") != std::string::npos);
}

TEST_CASE("C interface: before the model is loaded there are no functions, but a sentence", "[gl]")
{
    const gl::HeadlessContext context(desktop());
    auto loader = context.loader();
    showmysky_sky* sky = showmysky_open(
        SHOWMYSKY_TEST_MODEL, [](const char* name, void* user) { return (*static_cast<gl::Loader*>(user))(name); }, &loader, nullptr);
    REQUIRE(sky);
    CHECK(showmysky_shader_functions(sky) == nullptr);
    CHECK(std::string(showmysky_error()).find("isn't loaded") != std::string::npos);
    CHECK_FALSE(showmysky_bind_shader_functions(sky, 1, 0));
    showmysky_eclipse state;
    const auto scene = defaultScene();
    CHECK_FALSE(showmysky_eclipse_state(sky, &scene, &state));
    CHECK(showmysky_uses_eclipse_table(sky, &scene) == 0);
    showmysky_close(sky);
}

TEST_CASE("C interface: the state of an eclipse, phase by phase", "[gl]")
{
    const Opened sky;
    auto scene = defaultScene();
    scene.moon_azimuth = scene.sun_azimuth;
    const auto stateAt = [&](double apart, double distance) {
        scene.moon_zenith_angle = scene.sun_zenith_angle + apart;
        scene.moon_distance = distance;
        showmysky_eclipse state;
        REQUIRE(showmysky_eclipse_state(sky, &scene, &state));
        CHECK(state.separation == Approx(std::abs(apart)).margin(1e-12));
        return state;
    };
    const auto total = stateAt(0, 371925e3);
    CHECK(total.phase == SHOWMYSKY_TOTAL);
    CHECK(total.obscuration == 1);
    CHECK(total.magnitude == Approx(total.moon_angular_radius / total.sun_angular_radius));
    CHECK(total.moon_angular_radius > total.sun_angular_radius);
    const auto annular = stateAt(0, 400000e3);
    CHECK(annular.phase == SHOWMYSKY_ANNULAR);
    CHECK(annular.obscuration == Approx(std::pow(annular.moon_angular_radius / annular.sun_angular_radius, 2)).epsilon(1e-4));
    const auto partial = stateAt(0.3 * degree, 371925e3);
    CHECK(partial.phase == SHOWMYSKY_PARTIAL);
    CHECK(partial.obscuration > 0);
    CHECK(partial.obscuration < 1);
    const auto none = stateAt(1 * degree, 371925e3);
    CHECK(none.phase == SHOWMYSKY_NO_ECLIPSE);
    CHECK(none.obscuration == 0);
    scene.moon_distance = 6400e3; // in the air
    showmysky_eclipse untouched{7, 0, 0, 0, 0, 0};
    CHECK_FALSE(showmysky_eclipse_state(sky, &scene, &untouched));
    CHECK(untouched.phase == 7);
    CHECK(std::string(showmysky_error()).size() > 20);
}
