#include "context_for_tests.hpp"

#include <numeric>
#include <utility>

#include "gl/buffer_texture.hpp"
#include "gl/framebuffer.hpp"
#include "gl/texture.hpp"

using namespace sky;
using gl::TextureFormat;

namespace {

std::vector<float> ramp(std::size_t count)
{
    std::vector<float> values(count);
    std::iota(values.begin(), values.end(), 0.0f);
    return values;
}

} // namespace

TEST_CASE("textures: what goes up comes down, in every float format, in desktop GL and in ES", "[gl]")
{
    for (const bool es : {false, true}) {
        gl::HeadlessOptions options;
        if (es)
            options.version = {3, 0, true};
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        const gl::Api& api = context->api();
        if (es && !api->EXT_color_buffer_float)
            continue;
        // A host's odd pixel-store state must not matter.
        api->PixelStorei(GL_UNPACK_ROW_LENGTH, 99);
        api->PixelStorei(GL_PACK_ALIGNMENT, 8);
        for (const TextureFormat format : {TextureFormat::r16f, TextureFormat::rg16f, TextureFormat::rgba16f, TextureFormat::r32f,
                                           TextureFormat::rg32f, TextureFormat::rgba32f}) {
            CAPTURE(es, static_cast<int>(format));
            const auto n = static_cast<std::size_t>(gl::channels(format));
            // Integers below 2048 are exact even in half floats.
            gl::Texture2D flat(api, "flat", format, 3, 5);
            flat.upload(ramp(15 * n));
            CHECK(flat.download() == ramp(15 * n));
            gl::Texture3D solid(api, "solid", format, 3, 2, 4);
            solid.upload(ramp(24 * n));
            CHECK(solid.download() == ramp(24 * n));
            const std::vector<float> slice(6 * n, 1000.0f);
            solid.uploadSlices(2, 1, slice.data());
            std::vector<float> expected = ramp(24 * n);
            std::copy(slice.begin(), slice.end(), expected.begin() + static_cast<std::ptrdiff_t>(12 * n));
            CHECK(solid.download() == expected);
        }
        gl::Texture2D bytes(api, "bytes", TextureFormat::rgba8, 1, 1);
        bytes.upload({0.0f, 0.2f, 1.0f, 7.0f});
        const std::vector<float> read = bytes.download();
        CHECK(read[0] == 0.0f);
        CHECK(read[1] == Approx(0.2f).epsilon(1e-6)); // 0.2 is 51 / 255; the division may round
        CHECK(read[2] == 1.0f);
        CHECK(read[3] == 1.0f); // clamped
        GLint rowLength = 0;
        api->GetIntegerv(GL_UNPACK_ROW_LENGTH, &rowLength);
        CHECK(rowLength == 99);
        gl::checkErrors(api, "test");
    }
}

TEST_CASE("objects: wrong sizes are refused before the driver sees them", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Api& api = context->api();
    CHECK_THROWS_AS(gl::Texture2D(api, "empty", TextureFormat::r32f, 0, 4), RangeError);
    CHECK_THROWS_AS(gl::Texture2D(api, "huge", TextureFormat::r32f, 1 << 30, 1), RangeError);
    gl::Texture2D texture(api, "texture", TextureFormat::r32f, 2, 2);
    CHECK_THROWS_AS(texture.upload(ramp(5)), RangeError);
    CHECK_THROWS_AS(texture.uploadSlices(1, 1, nullptr), RangeError);
    CHECK_THROWS_AS(gl::Buffer(api, "empty", 0), RangeError);
    gl::Buffer buffer(api, "buffer", ramp(4));
    CHECK_THROWS_AS(buffer.upload(ramp(2), 12), RangeError);
    CHECK_NOTHROW(buffer.upload(ramp(2), 8));
    CHECK(buffer.download() == std::vector<float>{0.0f, 1.0f, 0.0f, 1.0f});
}

TEST_CASE("objects: moved, they are freed once; destroyed, their names are free", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Api& api = context->api();
    GLuint first = 0, second = 0;
    {
        gl::Buffer a(api, "a", ramp(1));
        first = a.name();
        gl::Buffer b = std::move(a);
        CHECK(b.name() == first);
        CHECK(b.label() == "a");
        CHECK(a.name() == 0); // NOLINT(bugprone-use-after-move): this is what is tested
        gl::Buffer c(api, "c", ramp(2));
        second = c.name();
        c = std::move(b);
        CHECK(c.name() == first);
        CHECK(api->IsBuffer(second) == GL_FALSE);
        CHECK(c.download() == ramp(1));
    }
    CHECK(api->IsBuffer(first) == GL_FALSE);
}

TEST_CASE("objects: carry their labels to the driver's debugger", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Api& api = context->api();
    const gl::Buffer buffer(api, "moments, order 2", ramp(1));
    const gl::Framebuffer framebuffer(api, "sky view");
    char label[64]{};
    api->GetObjectLabel(GL_BUFFER, buffer.name(), sizeof label, nullptr, label);
    CHECK(std::string(label) == "moments, order 2");
    api->GetObjectLabel(GL_FRAMEBUFFER, framebuffer.name(), sizeof label, nullptr, label);
    CHECK(std::string(label) == "sky view");
    gl::checkErrors(api, "test");
}

namespace {

PFNGLGETINTEGERVPROC driversGetInteger = nullptr;

void GLAD_API_PTR smallLimit(GLenum what, GLint* value)
{
    driversGetInteger(what, value);
    if (what == GL_MAX_TEXTURE_BUFFER_SIZE)
        *value = 1000;
}

} // namespace

TEST_CASE("buffer textures: a driver that shows shaders less of a buffer than they need is refused", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Api& api = context->api();
    auto& functions = const_cast<GladGLContext&>(*api.operator->());
    driversGetInteger = std::exchange(functions.GetIntegerv, &smallLimit);
    const gl::Buffer whole(api, "whole", ramp(4000)), more(api, "more", ramp(4004));
    CHECK_NOTHROW(gl::BufferTexture(api, "view", whole));
    CHECK_THROWS_WITH(gl::BufferTexture(api, "view", more),
                      Catch::Contains("\"more\" has 1001 texels") && Catch::Contains("more than 1000"));
    CHECK_THROWS_AS(gl::BufferTexture(api, "view", whole, 1), GlError);
}
