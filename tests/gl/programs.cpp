#include "context_for_tests.hpp"

#include "gl/program.hpp"

using namespace sky;
using Catch::Matchers::Contains;

namespace {

std::string_view files(std::string_view path)
{
    if (path == "nested.comp")
        return "layout(local_size_x = 1) in;\n#include \"outer.glsl\"\nvoid main() {}\n";
    if (path == "outer.glsl")
        return "#include \"inner.glsl\"\nfloat outer() { return inner(); }\n";
    if (path == "inner.glsl")
        return "// a comment\nfloat inner() {\n    return undefinedName;\n}\n";
    if (path == "after.comp")
        return "layout(local_size_x = 1) in;\n#include \"good.glsl\"\nvoid main() {\n    undefinedName = 1.0;\n}\n";
    if (path == "good.glsl")
        return "float good() { return 1.0; }\n\n\n\n";
    if (path == "user.comp")
        return "layout(local_size_x = 1) in;\n"
               "layout(std430, binding = 0) buffer Out { float result; };\n"
               "float density(float altitude) {\n"
               "#include \"user:density\"\n"
               "}\n"
               "void main() { result = density(1.0); }\n";
    if (path == "triangle.vert")
        return "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }\n";
    if (path == "colour.frag")
        return "uniform vec4 colour;\nout vec4 result;\nvoid main() { result = colour; }\n";
    if (path == "unlinkable.frag")
        return "float elsewhere();\nout vec4 result;\nvoid main() { result = vec4(elsewhere()); }\n";
    return {};
}

template<class Exception>
std::string failure(const gl::HeadlessContext& context, const std::string& path, const std::vector<gl::Snippet>& snippets = {})
{
    try {
        gl::ProgramBuilder(context.api(), files).compute("program", path, {}, snippets);
    } catch (const Exception& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("compile errors: name the file and line, in and after includes", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    CHECK_THAT(failure<GlError>(*context, "nested.comp"), Contains("inner.glsl:3: ") && Contains("undefinedName"));
    CHECK_THAT(failure<GlError>(*context, "after.comp"), Contains("after.comp:4: ") && Contains("undefinedName"));
}

TEST_CASE("compile errors: a description's block is reported at its own line", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Snippet bad{"density", "    float scale = 8.0;\n    return exp(-altitud / scale);\n", "earth.atmo", 42};
    const std::string message = failure<AtmoError>(*context, "user.comp", {bad});
    CHECK_THAT(message, Catch::StartsWith("earth.atmo:43") && Contains("altitud") && Contains("\n        return exp(-altitud / scale);"));

    gl::Snippet host = bad;
    host.fromDescription = false;
    CHECK_THAT(failure<GlError>(*context, "user.comp", {host}), Contains("earth.atmo:43: "));

    const gl::Snippet good{"density", "    return altitude; // h\xC3\xB6he", "earth.atmo", 42};
    CHECK(failure<Error>(*context, "user.comp", {good}) == "no error");
}

TEST_CASE("link errors: name the program", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::ProgramBuilder builder(context->api(), files);
    CHECK_THROWS_WITH(builder.graphics("sky pass", "triangle.vert", "unlinkable.frag"), Contains("\"sky pass\""));
}

TEST_CASE("drawing: a full-screen triangle fills every texel, in desktop GL and in ES", "[gl]")
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
        CAPTURE(api.versionText());
        gl::Program program = gl::ProgramBuilder(api, files).graphics("fill", "triangle.vert", "colour.frag");
        CHECK(program.has("colour"));
        CHECK_FALSE(program.has("color"));
        gl::Texture2D target(api, "target", gl::TextureFormat::rgba32f, 5, 3);
        gl::Framebuffer framebuffer(api, "framebuffer");
        framebuffer.attach(0, target);
        const gl::VertexArray vertices(api, "no vertices");
        program.set("colour", std::array<float, 4>{0.25f, 2.0f, -1.0f, 1e4f}); // exact in float32
        {
            const gl::Bound drawing{framebuffer};
            const gl::Bound pass{program};
            vertices.drawFullScreenTriangle();
        }
        GLint bound = -1;
        api->GetIntegerv(GL_CURRENT_PROGRAM, &bound);
        CHECK(bound == 0);
        api->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
        CHECK(bound == 0);

        const std::vector<float> pixels = target.download();
        REQUIRE(pixels.size() == 60);
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            CHECK(pixels[i] == 0.25f);
            CHECK(pixels[i + 1] == 2.0f);
            CHECK(pixels[i + 2] == -1.0f);
            CHECK(pixels[i + 3] == 1e4f);
        }
        gl::checkErrors(api, "test");
    }
}
