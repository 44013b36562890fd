#include "context_for_tests.hpp"

#include "gl/buffer.hpp"
#include "gl/program.hpp"

using namespace sky;

namespace {

std::string_view shaderFiles(std::string_view path)
{
    if (path == "squares.comp")
        return "layout(local_size_x = 32) in;\n"
               "layout(std430, binding = 0) buffer Squares { float squares[]; };\n"
               "uniform float scale;\n"
               "#include \"lib/square.glsl\"\n"
               "#include \"lib/square.glsl\"\n"
               "void main() {\n"
               "    uint i = gl_GlobalInvocationID.x;\n"
               "    if (i < uint(COUNT)) squares[i] = scale * square(float(i));\n"
               "}\n";
    if (path == "lib/square.glsl")
        return "float square(float x) { return x * x; }\n";
    return {};
}

} // namespace

TEST_CASE("compute program: writes scaled squares into a storage buffer", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::ProgramBuilder builder(context->api(), shaderFiles);
    gl::Program program = builder.compute("squares", "squares.comp", {{"COUNT", "100"}});
    CHECK(program.workGroupSize() == std::array<int, 3>{32, 1, 1});

    const gl::Buffer buffer(context->api(), "squares", std::vector<float>(128, -1.0f));
    buffer.bindStorage(0);
    program.set("scale", 0.5f);
    program.dispatchOver(100);
    gl::memoryBarrier(context->api());
    const std::vector<float> result = buffer.download();
    gl::checkErrors(context->api(), "test");

    REQUIRE(result.size() == 128);
    for (std::size_t i = 0; i < 128; ++i) {
        const float x = static_cast<float>(i);
        // Small integers and halves are exact in float32.
        CHECK(result[i] == (i < 100 ? 0.5f * x * x : -1.0f));
    }
}

TEST_CASE("compute program: too many work groups are refused with the limit", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Program program = gl::ProgramBuilder(context->api(), shaderFiles).compute("squares", "squares.comp", {{"COUNT", "1"}});
    const auto limit = static_cast<unsigned>(context->api().limits().workGroupCount[1]);
    CHECK(limit >= 65535); // the minimum of OpenGL 4.3
    CHECK_THROWS_AS(program.dispatch(1, limit + 1), RangeError);
}
