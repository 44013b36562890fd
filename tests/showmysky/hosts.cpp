// What a host relies on: its state, its context, the lifetime of things, and sentences where something is wrong.

#include "sky_for_tests.hpp"

#include "gl/buffer.hpp"
#include "gl/framebuffer.hpp"
#include "gl/texture.hpp"
#include "view_direction.hpp"
#include <filesystem>
#include <map>
#include <random>

using namespace showmysky;
using namespace showmysky::testing;
namespace gl = sky::gl;

namespace {

/// All that a renderer could disturb, by name.
std::map<std::string, std::vector<GLint>> snapshot(const gl::Api& api)
{
    std::map<std::string, std::vector<GLint>> state;
    const auto ask = [&](const std::string& name, GLenum what) {
        std::vector<GLint> values(4, 0);
        api->GetIntegerv(what, values.data());
        state[name] = values;
    };
    for (const GLenum what : {GL_CURRENT_PROGRAM,
                              GL_VERTEX_ARRAY_BINDING,
                              GL_ARRAY_BUFFER_BINDING,
                              GL_ELEMENT_ARRAY_BUFFER_BINDING,
                              GL_COPY_READ_BUFFER,
                              GL_COPY_WRITE_BUFFER,
                              GL_PIXEL_PACK_BUFFER_BINDING,
                              GL_PIXEL_UNPACK_BUFFER_BINDING,
                              GL_UNIFORM_BUFFER_BINDING,
                              GL_DRAW_FRAMEBUFFER_BINDING,
                              GL_READ_FRAMEBUFFER_BINDING,
                              GL_RENDERBUFFER_BINDING,
                              GL_ACTIVE_TEXTURE,
                              GL_VIEWPORT,
                              GL_SCISSOR_BOX,
                              GL_COLOR_WRITEMASK,
                              GL_DEPTH_WRITEMASK,
                              GL_DEPTH_FUNC,
                              GL_STENCIL_FUNC,
                              GL_STENCIL_REF,
                              GL_STENCIL_WRITEMASK,
                              GL_CULL_FACE_MODE,
                              GL_FRONT_FACE,
                              GL_COLOR_CLEAR_VALUE,
                              GL_BLEND_SRC_RGB,
                              GL_BLEND_DST_RGB,
                              GL_BLEND_SRC_ALPHA,
                              GL_BLEND_DST_ALPHA,
                              GL_BLEND_EQUATION_RGB,
                              GL_BLEND_EQUATION_ALPHA,
                              GL_BLEND,
                              GL_DEPTH_TEST,
                              GL_CULL_FACE,
                              GL_SCISSOR_TEST,
                              GL_DITHER,
                              GL_STENCIL_TEST,
                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                              GL_SAMPLE_COVERAGE,
                              GL_POLYGON_OFFSET_FILL,
                              GL_RASTERIZER_DISCARD,
                              GL_PACK_ALIGNMENT,
                              GL_PACK_ROW_LENGTH,
                              GL_PACK_SKIP_ROWS,
                              GL_UNPACK_ALIGNMENT,
                              GL_UNPACK_ROW_LENGTH,
                              GL_UNPACK_SKIP_PIXELS,
                              GL_FRAGMENT_SHADER_DERIVATIVE_HINT,
                              GL_DRAW_BUFFER0,
                              GL_READ_BUFFER})
        ask(std::to_string(what), what);
    if (!api.isEs())
        for (const GLenum what : {GL_FRAMEBUFFER_SRGB, GL_COLOR_LOGIC_OP, GL_DEPTH_CLAMP, GL_PROGRAM_POINT_SIZE, GL_MULTISAMPLE})
            ask("desktop " + std::to_string(what), what);
    GLint unit = 0;
    api->GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    for (GLenum i = 0; i < 16; ++i) {
        api->ActiveTexture(GL_TEXTURE0 + i);
        ask("2D of unit " + std::to_string(i), GL_TEXTURE_BINDING_2D);
        ask("3D of unit " + std::to_string(i), GL_TEXTURE_BINDING_3D);
        ask("cube of unit " + std::to_string(i), GL_TEXTURE_BINDING_CUBE_MAP);
        ask("array of unit " + std::to_string(i), GL_TEXTURE_BINDING_2D_ARRAY);
        ask("sampler of unit " + std::to_string(i), GL_SAMPLER_BINDING);
    }
    api->ActiveTexture(static_cast<GLenum>(unit));
    return state;
}

} // namespace

TEST_CASE("host: all OpenGL state is as it was after every call", "[gl]")
{
    for (const auto& options : {desktop(), embedded()}) {
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        const gl::Api& api = context->api();
        CAPTURE(api.versionText());
        const gl::Texture2D flat(api, "host's", gl::TextureFormat::rgba8, 8, 8);
        const gl::Buffer buffer(api, "host's", 4096);
        const gl::VertexArray vertices(api, "host's");
        gl::Framebuffer framebuffer(api, "host's");
        framebuffer.attach(0, flat);
        for (const GLuint unit : {0u, 1u, 2u, 5u})
            flat.bindUnit(unit);
        api->BindVertexArray(vertices.name());
        api->BindBuffer(GL_ARRAY_BUFFER, buffer.name());
        api->BindBuffer(GL_PIXEL_PACK_BUFFER, buffer.name());
        api->BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.name());
        api->BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        for (const GLenum what : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST})
            api->Enable(what);
        api->Viewport(1, 2, 5, 4);
        api->Scissor(2, 2, 3, 3);
        api->ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
        api->PixelStorei(GL_UNPACK_ROW_LENGTH, 77);
        api->PixelStorei(GL_PACK_ALIGNMENT, 8);
        const auto before = snapshot(api);
        const auto unchanged = [&](const char* call) {
            CAPTURE(call);
            for (const auto& [name, values] : snapshot(api)) {
                CAPTURE(name);
                CHECK(values == before.at(name));
            }
            CHECK(api->GetError() == GL_NO_ERROR);
        };
        {
            Sky sky(SHOWMYSKY_TEST_MODEL, context->loader());
            unchanged("constructor");
            while (!sky.loadStep().done)
                unchanged("loadStep");
            unchanged("last loadStep");
            sky.setSettings(scene(100, 60));
            unchanged("setSettings");
            while (!sky.prepareStep().done) {
            }
            unchanged("prepareStep");
            sky.draw(panorama(), 64, 32);
            unchanged("draw");
            sky.draw(panorama(), 128, 64, 2);
            unchanged("draw, another size");
            CHECK(sky.readLuminance()[500].y > 0);
            unchanged("readLuminance");
            sky.pixelLuminance(3, 3);
            unchanged("pixelLuminance");
            sky.viewDirection(3, 3);
            unchanged("viewDirection");
            sky.pixelSpectralRadiance(3, 3);
            unchanged("pixelSpectralRadiance");
        }
        unchanged("destructor");
    }
}

TEST_CASE("host: several skies in one context and in two, destroyed in any order", "[gl]")
{
    auto first = gl::testing::context(desktop());
    if (!first)
        return;
    auto a = std::make_unique<Sky>(loadedSky(*first));
    auto b = std::make_unique<Sky>(loadedSky(*first));
    a->setSettings(scene(0, 30));
    b->setSettings(scene(0, 90));
    a->draw(panorama(), 64, 32);
    b->draw(panorama(), 64, 32);
    const auto ofA = a->readLuminance(), ofB = b->readLuminance();
    CHECK(ofA[1200].y > 5 * ofB[1200].y);
    a.reset();
    b->setSettings(scene(0, 30));
    b->draw(panorama(), 64, 32);
    CHECK(b->readLuminance()[1200].y == ofA[1200].y);

    auto second = std::make_unique<gl::HeadlessContext>(desktop());
    auto c = std::make_unique<Sky>(loadedSky(*second));
    c->setSettings(scene(0, 30));
    c->draw(panorama(), 64, 32);
    CHECK(c->readLuminance()[1200].y == ofA[1200].y);
    // The second context goes first; its sky was told.
    c->abandonContext();
    second.reset();
    CHECK_THROWS_AS(c->draw(panorama(), 64, 32), Error);
    CHECK(c->wavelengths().size() == b->wavelengths().size());
    c.reset();
    first->makeCurrent();
    b->setSettings(scene(0, 90));
    b->draw(panorama(), 64, 32);
    CHECK(b->readLuminance()[1200].y == ofB[1200].y);
}

TEST_CASE("host: nothing is drawn when nothing changed", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    sky.setSettings(scene(0, 30));
    CHECK(sky.draw(panorama(), 64, 32));
    CHECK_FALSE(sky.draw(panorama(), 64, 32));
    Camera other = panorama();
    other.yaw = 1;
    CHECK(sky.draw(other, 64, 32));
    sky.setSettings(scene(0, 31));
    CHECK(sky.draw(other, 64, 32));
    CHECK(sky.fetchesPerPixel() == 4);
    CHECK(sky.textureBytes() < 64u << 20);
}

TEST_CASE("host: loading and preparing report their progress", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky(SHOWMYSKY_TEST_MODEL, context->loader());
    CHECK_THROWS_AS(sky.wavelengths(), Error);
    double before = -1;
    for (Progress progress; !progress.done;) {
        progress = sky.loadStep();
        CHECK(progress.fraction > before);
        CHECK(progress.done == progress.activity.empty());
        before = progress.fraction;
    }
    sky.setSettings(scene(7000, 30));
    int steps = 0;
    while (!sky.prepareStep().done)
        ++steps;
    CHECK(steps > 3);
}

TEST_CASE("host: an error that the host left unread is dropped, whatever the call", "[gl]")
{
    for (const auto& options : {desktop(), embedded()}) {
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        const gl::Api& api = context->api();
        const auto leaveError = [&] { api->Enable(0xffff); };
        leaveError();
        Sky sky(SHOWMYSKY_TEST_MODEL, context->loader());
        leaveError();
        sky.loadAll();
        leaveError();
        CHECK(sky.draw(panorama(), 16, 8));
        leaveError();
        CHECK(sky.readLuminance().size() == 128);
        CHECK(api->GetError() == GL_NO_ERROR);
    }
}

TEST_CASE("host: directions of all projections, drawn and computed", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Options options;
    options.viewDirectionFunction = R"(
uniform vec3 axisToLookAt;
vec3 viewDirection(vec2 position) { return position.x < 32.0 ? axisToLookAt + vec3(0.0, 0.0, position.y) : vec3(0.0); }
)";
    Sky own = loadedSky(*context, options);
    own.setSettings(scene(0, 30));
    own.draw({}, 64, 32);
    GLint before = 0;
    context->api()->GetIntegerv(GL_CURRENT_PROGRAM, &before);
    context->api()->UseProgram(own.program());
    context->api()->Uniform3f(context->api()->GetUniformLocation(own.program(), "axisToLookAt"), 3, 0, 0);
    context->api()->UseProgram(static_cast<GLuint>(before));
    CHECK(own.draw({}, 64, 32)); // always, since the host's uniforms may have changed
    const auto direction = own.viewDirection(5, 3);
    CHECK(direction[0] == Approx(3 / std::hypot(3, 3.5)).margin(1e-6));
    CHECK(direction[2] == Approx(3.5 / std::hypot(3, 3.5)).margin(1e-6));
    CHECK(own.pixelLuminance(5, 3).y > 0);
    CHECK(own.pixelLuminance(40, 3).y == 0);
    CHECK(own.viewDirection(40, 3) == Vector{});

    // A texture of directions made from a built-in projection shows the same picture as that projection.
    Sky sky = loadedSky(*context);
    sky.setSettings(scene(100, 50));
    for (const auto projection : {Projection::equirectangular, Projection::perspective, Projection::fisheye}) {
        Camera camera{projection, 1.7, 0.4, 0.3, 0};
        sky.draw(camera, 60, 40);
        const auto expected = sky.readLuminance();
        std::vector<float> texels;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 60; ++x) {
                for (const double c : builtInDirection(camera, 60, 40, x + 0.5, y + 0.5))
                    texels.push_back(static_cast<float>(c));
                texels.push_back(0);
            }
        gl::Texture2D directions(context->api(), "directions", gl::TextureFormat::rgba32f, 60, 40);
        directions.upload(texels);
        camera.directionTexture = directions.name();
        sky.draw(camera, 60, 40);
        CHECK(quantile(differences(sky.readLuminance(), expected), 0.99) < 1e-4);
        CHECK(sky.viewDirection(7, 9)[1] == Approx(builtInDirection(camera, 60, 40, 7.5, 9.5)[1]).margin(1e-6));
    }
}

TEST_CASE("host: Sun and directions turned or mirrored together show the same sky, whatever the directions' lengths", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit;
    const int width = 32, height = 32;
    for (const double zenith : {0., 40., 90., 97.})
        for (const double altitude : {0., 2000., 300e3}) {
            CAPTURE(zenith, altitude);
            auto settings = scene(altitude, zenith);
            const double elevation = 90 * degree - settings.sun.zenithAngle;
            // Towards the Sun and away from it, zenith and nadir, each within units of the last place; the rest anywhere. Azimuths count from the Sun.
            std::vector<std::array<double, 2>> views; // azimuth, elevation
            for (const auto& [azimuth, height_] : {std::array{0., elevation}, std::array{180 * degree, -elevation},
                                                   std::array{0., 90 * degree}, std::array{0., -90 * degree}})
                for (int i = -8; i <= 8; ++i)
                    views.push_back({azimuth, std::clamp(height_ + i * 1.2e-7, -90 * degree, 90 * degree)});
            while (views.size() < width * height)
                views.push_back({360 * degree * unit(random), std::asin(2 * unit(random) - 1)});
            const auto drawn = [&](double turn, bool mirror, bool lengths) {
                settings.sun.azimuth = turn;
                sky.setSettings(settings);
                std::vector<float> texels;
                for (const auto& [fromSun, height_] : views) {
                    const double azimuth = turn + (mirror ? -fromSun : fromSun), size = lengths ? std::pow(10, 6 * unit(random) - 3) : 1;
                    for (const double c :
                         {std::cos(height_) * std::cos(azimuth), -std::cos(height_) * std::sin(azimuth), std::sin(height_), 0.})
                        texels.push_back(static_cast<float>(size * c));
                }
                gl::Texture2D directions(context->api(), "directions", gl::TextureFormat::rgba32f, width, height);
                directions.upload(texels);
                Camera camera;
                camera.directionTexture = directions.name();
                sky.draw(camera, width, height);
                return sky.readLuminance();
            };
            const auto expected = drawn(0, false, false);
            for (int i = 0; i < 10; ++i) {
                const auto picture = drawn(40 * unit(random) - 20, i % 2 == 1, i > 1);
                for (const auto& pixel : picture)
                    REQUIRE((std::isfinite(pixel.y) && pixel.y >= 0));
                CHECK(differences(picture, expected).back() < 1e-4); // roundings of directions
            }
        }
}

TEST_CASE("host: a model that isn't there, or vanishes", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky none("no/such/model", context->loader());
    CHECK_THROWS_AS(none.loadAll(), Error);

    namespace fs = std::filesystem;
    const fs::path copy = fs::temp_directory_path() / "showmysky-vanishing-model";
    fs::remove_all(copy);
    fs::copy(SHOWMYSKY_TEST_MODEL, copy, fs::copy_options::recursive);
    Sky sky(copy.string(), context->loader());
    sky.loadStep();
    Sky loaded(copy.string(), context->loader());
    loaded.loadAll();
    fs::remove_all(copy);
    CHECK_THROWS_AS(sky.loadAll(), Error);
    // From moments all is in memory; the textures are missed with a sentence, and the scene can be changed back.
    loaded.setSettings(scene(0, 30));
    CHECK(loaded.draw(panorama(), 32, 16));
    loaded.setSettings(scene(0, 30, Source::textures));
    try {
        loaded.draw(panorama(), 32, 16);
        FAIL("drew from textures that are gone");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::model);
    }
    loaded.setSettings(scene(0, 30));
    CHECK(loaded.draw(panorama(), 32, 16));
}

TEST_CASE("host: settings that can't be met are refused and leave the scene alone", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const auto good = scene(10, 30);
    sky.setSettings(good);
    const auto refused = [&](const std::function<void(SceneSettings&)>& spoil, ErrorKind kind) {
        SceneSettings settings = good;
        spoil(settings);
        try {
            sky.setSettings(settings);
            FAIL("accepted");
        } catch (const Error& error) {
            CHECK(error.kind() == kind);
            CHECK(std::string(error.what()).back() == '.');
        }
        CHECK(sky.settings().altitude == 10);
    };
    refused([](SceneSettings& s) { s.altitude = -1; }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.altitude = std::nan(""); }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.sun.zenithAngle = 4; }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.solarSpectrumFactors = {1, 2}; }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.layers.hiddenScatterers = {"glitter"}; }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.eclipse = EclipseMode::on, s.moon.distance = 6400e3; }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.eclipseOrders = 1; }, ErrorKind::settings);
    refused([](SceneSettings& s) { s.lightPollutionLuminance = -1; }, ErrorKind::settings);
    CHECK_THROWS_AS(sky.draw(panorama(), 0, 10), Error);
    CHECK_THROWS_AS(sky.draw({Projection::perspective, 3.2, 0, 0, 0}, 10, 10), Error);
    CHECK_THROWS_AS(sky.pixelLuminance(0, 0), Error);
}
