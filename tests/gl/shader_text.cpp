#include <catch2/catch.hpp>

#include "gl/shader_text.hpp"

using namespace sky;
using Catch::Matchers::Contains;

namespace {

std::string_view files(std::string_view path)
{
    if (path == "main.comp")
        return "// first\n#include \"a.glsl\"\n  #  include \"b.glsl\" // again a\nvoid main() {}\n";
    if (path == "a.glsl")
        return "float a();\n";
    if (path == "b.glsl")
        return "#include \"a.glsl\"\nfloat b();";
    if (path == "comment.comp")
        return "/*\n#include \"missing.glsl\"\n*/\nvoid main() {}\n";
    if (path == "missing.comp")
        return "\n#include \"missing.glsl\"\n";
    if (path == "self.comp")
        return "#include \"self.comp\"\nvoid main() {}\n";
    if (path == "user.comp")
        return "#include \"user:density\"\nvoid main() {}\n";
    return {};
}

gl::Snippet block(const std::string& text) { return {"density", text, "earth.atmo", 10}; }

std::string failure(const std::string& text)
{
    try {
        gl::expandShader(files, "user.comp", "430 core", {}, {block(text)});
    } catch (const AtmoError& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("includes: each file once, with the lines of its own")
{
    const gl::ShaderText shader = gl::expandShader(files, "main.comp", "430 core", {{"N", "3"}, {"M", "(N + 1)"}}, {});
    CHECK(shader.text == "#version 430 core\n#define N 3\n#define M (N + 1)\n"
                         "// first\nfloat a();\nfloat b();\nvoid main() {}\n");
    std::vector<std::string> places;
    for (const gl::ShaderText::Line& line : shader.lines)
        places.push_back(shader.origins.at(static_cast<std::size_t>(line.origin)).file + ":" + std::to_string(line.line));
    CHECK(places == std::vector<std::string>{"<defines of main.comp>:1", "<defines of main.comp>:2", "<defines of main.comp>:3",
                                             "main.comp:1", "a.glsl:1", "b.glsl:2", "main.comp:4"});
}

TEST_CASE("includes: none inside comments, no endless loop, a missing file names the line that wants it")
{
    CHECK_NOTHROW(gl::expandShader(files, "comment.comp", "430 core", {}, {}));
    CHECK_NOTHROW(gl::expandShader(files, "self.comp", "430 core", {}, {}));
    CHECK_THROWS_WITH(gl::expandShader(files, "missing.comp", "430 core", {}, {}),
                      "missing.comp:2: there is no shader file \"missing.glsl\".");
    CHECK_THROWS_WITH(gl::expandShader(files, "user.comp", "430 core", {}, {}), Contains("no block is given"));
}

TEST_CASE("OpenGL ES: precision follows the version")
{
    CHECK_THAT(gl::expandShader(files, "a.glsl", "300 es", {}, {}).text, Catch::StartsWith("#version 300 es\nprecision highp float;\n"));
}

TEST_CASE("a description's block: keeps its lines, and can't disturb what is around it")
{
    const gl::ShaderText shader = gl::expandShader(files, "user.comp", "430 core", {}, {block("return 1.0; \\")});
    CHECK_THAT(shader.text, Contains("\nreturn 1.0; \\\n\nvoid main() {}\n"));
    REQUIRE(shader.lines.size() == 4);
    CHECK(shader.lines[1].line == 10);

    CHECK_THAT(failure("a(\n  {1;\n"), Contains("earth.atmo:11:3: this bracket is never closed; expected \"}\""));
    CHECK_THAT(failure("a);\n"), Contains("earth.atmo:10:2: this \")\" closes nothing"));
    CHECK_THAT(failure("a;\n\n /* b\n"), Contains("earth.atmo:12:2: this comment is never closed"));
    CHECK_THAT(failure("#include \"a.glsl\"\n"), Contains("earth.atmo:10:1: \"#include\" can't be used"));
    CHECK_THAT(failure("x;\n # line 3\n"), Contains("earth.atmo:11:2: \"#line\" can't be used"));
    CHECK(failure("return (1.0); // ) not code {\n/* nor ] this */") == "no error");
}

TEST_CASE("driver messages: Mesa, NVIDIA, AMD and their relatives")
{
    struct Row {
        const char* log;
        int source, line, column;
        bool error;
        const char* text;
    };
    const Row rows[] = {
        {"3:12(5): error: `foo' undeclared", 3, 12, 5, true, "`foo' undeclared"},
        {"0:7(1): warning: unused", 0, 7, 1, false, "warning: unused"},
        {"2(34) : error C1008: undefined variable \"foo\"", 2, 34, 0, true, "error C1008: undefined variable \"foo\""},
        {"2(3) : warning C7050: maybe", 2, 3, 0, false, "warning C7050: maybe"},
        {"ERROR: 4:56: 'foo' : undeclared identifier", 4, 56, 0, true, "'foo' : undeclared identifier"},
        {"WARNING: 0:1: extension", 0, 1, 0, false, "extension"},
        {"error: linking failed", -1, 0, 0, true, "linking failed"},
        {"ERROR: 2 compilation errors.  No code generated.", -1, 0, 0, true, "2 compilation errors.  No code generated."},
        {"99999999999:1(1): error: x", -1, 0, 0, false, "99999999999:1(1): error: x"},
    };
    for (const Row& row : rows) {
        CAPTURE(row.log);
        const auto messages = gl::parseDriverLog(std::string(row.log) + "\r\n");
        REQUIRE(messages.size() == 1);
        CHECK(messages[0].source == row.source);
        CHECK(messages[0].line == row.line);
        CHECK(messages[0].column == row.column);
        CHECK(messages[0].error == row.error);
        CHECK(messages[0].text == row.text);
    }
    CHECK(gl::parseDriverLog("").empty());
}
