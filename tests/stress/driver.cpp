// What drivers did to other programs: refuse shaders that one of them took, reset after a long dispatch, hide NaN. docs/stress.md

#include "../solver/support.hpp"
#include "showmysky/sky.hpp"
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <regex>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

/// What the program asked of the driver, kept by functions that stand before the driver's own.
struct Witness {
    PFNGLSHADERSOURCEPROC shaderSource = nullptr;
    PFNGLGETSHADERIVPROC getShader = nullptr;
    PFNGLDISPATCHCOMPUTEPROC dispatch = nullptr;
    PFNGLFINISHPROC finish = nullptr;
    std::map<std::string, std::string> shaders; ///< text to kind: "vert", "frag" or "comp"
    double longestDispatch = 0;                 ///< s of processor time
    int dispatches = 0;
} witness;

void GLAD_API_PTR keepSource(GLuint shader, GLsizei count, const GLchar* const* text, const GLint* length)
{
    GLint kind = 0;
    witness.getShader(shader, GL_SHADER_TYPE, &kind);
    REQUIRE(count == 1);
    witness.shaders[std::string(*text, static_cast<std::size_t>(*length))] = kind == GL_VERTEX_SHADER     ? "vert"
                                                                             : kind == GL_FRAGMENT_SHADER ? "frag"
                                                                                                          : "comp";
    witness.shaderSource(shader, count, text, length);
}

void GLAD_API_PTR timeDispatch(GLuint x, GLuint y, GLuint z)
{
    witness.finish();
    const std::clock_t start = std::clock(); // of all threads: other programs on the machine don't count
    witness.dispatch(x, y, z);
    witness.finish();
    witness.longestDispatch = std::max(witness.longestDispatch, double(std::clock() - start) / CLOCKS_PER_SEC);
    ++witness.dispatches;
}

/// Puts the witness before the functions of a context of ours.
void watch(gl::HeadlessContext& context)
{
    auto& functions = const_cast<GladGLContext&>(*context.api().operator->());
    witness = {functions.ShaderSource, functions.GetShaderiv, functions.DispatchCompute, functions.Finish, {}, 0, 0};
    functions.ShaderSource = keepSource;
    functions.DispatchCompute = timeDispatch;
}

/// The same for a host's loader.
gl::Loader watched(const gl::Loader& loader)
{
    witness = {};
    witness.shaderSource = reinterpret_cast<PFNGLSHADERSOURCEPROC>(loader("glShaderSource"));
    witness.getShader = reinterpret_cast<PFNGLGETSHADERIVPROC>(loader("glGetShaderiv"));
    return [loader](const char* name) {
        return std::string(name) == "glShaderSource" ? reinterpret_cast<decltype(loader(name))>(keepSource) : loader(name);
    };
}

/// Khronos' own front end takes every shader that was kept.
void checkShaders(const std::string& what)
{
    const Scratch scratch;
    std::filesystem::create_directories(scratch.path);
    int number = 0;
    for (const auto& [text, kind] : witness.shaders) {
        const auto file = scratch.path / (std::to_string(number++) + "." + kind), log = scratch.path / "log";
        std::ofstream(file) << text;
        const int code = std::system(("glslangValidator '" + file.string() + "' > '" + log.string() + "' 2>&1").c_str());
        std::ifstream said(log);
        INFO(what << ", " << kind << ": " << std::string(std::istreambuf_iterator<char>(said), {}));
        CHECK(code == 0);
    }
    CHECK(number > 1);
}

/// Every layer is asked for and drawn, from both sources of light.
void draw(const gl::HeadlessContext& context)
{
    showmysky::Sky sky(SHOWMYSKY_TEST_MODEL, watched(context.loader()), {});
    sky.loadAll();
    for (const auto source : {showmysky::Source::moments, showmysky::Source::textures}) {
        showmysky::SceneSettings scene;
        scene.source = source;
        scene.sun.zenithAngle = 1;
        sky.setSettings(scene);
        sky.draw(showmysky::Camera{}, 32, 32);
    }
}

} // namespace

TEST_CASE("every shader of a computation passes the front end of Khronos", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0) {
        WARN("skipped: glslangValidator (Debian: glslang-tools) is not installed");
        return;
    }
    watch(*context);
    SceneText scene;
    scene.species += SceneText::dust() + scene.absorber();
    const Run run(*context, scene.parse());
    checkShaders("computation");
}

TEST_CASE("every shader of a picture passes the front end of Khronos, in desktop GL and in ES", "[gl]")
{
    if (std::system("glslangValidator --version > /dev/null 2>&1") != 0) {
        WARN("skipped: glslangValidator (Debian: glslang-tools) is not installed");
        return;
    }
    for (const bool embedded : {false, true}) {
        gl::HeadlessOptions options;
        options.version = embedded ? gl::Version{3, 0, true} : gl::Version{3, 3, false};
        auto context = gl::testing::context(options);
        if (!context)
            return;
        draw(*context);
        checkShaders(embedded ? "picture, OpenGL ES" : "picture, OpenGL");
    }
}

TEST_CASE("four times the texels, and still no dispatch that a watchdog would mind", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    watch(*context);
    SceneText scene;
    scene.views = "128";
    scene.azimuths = "16";
    scene.suns = "64";
    scene.altitudes = "2";
    scene.species += SceneText::dust();
    const Run run(*context, scene.parse());
    CHECK(witness.dispatches > 10);
    CHECK(witness.longestDispatch < 1); // desktops end what takes two seconds; this is a software driver's processor time
}

TEST_CASE("a computation in a context that watches its user: no error, no warning", "[gl]")
{
    std::vector<std::string> messages;
    gl::HeadlessOptions options;
    options.debug = gl::DebugOutput::on;
    options.debugSink = [&](const std::string& message) { messages.push_back(message); };
    auto context = gl::testing::context(options);
    if (!context)
        return;
    SceneText scene;
    scene.species += SceneText::dust();
    const Run run(*context, scene.parse());
    checkValues(run.model);
    INFO((messages.empty() ? std::string() : messages.front()));
    CHECK(messages.empty());
}

TEST_CASE("shaders use no function whose overflow or NaN is left to the driver")
{
    int files = 0;
    const std::regex forbidden(R"(\b(tanh|sinh|cosh|acos|asin|atan|isnan|isinf|inversesqrt)\s*\()");
    const std::regex power(R"(\bpow\s*\((?!max\s*\(|vec4\(max\s*\(|linear\b))"); // its base is held above zero
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SKY_SOURCE_DIR "/shaders")) {
        if (!entry.is_regular_file())
            continue;
        ++files;
        std::ifstream file(entry.path());
        for (std::string line; std::getline(file, line);) {
            line = line.substr(0, line.find("//"));
            INFO(entry.path().filename() << ": " << line);
            CHECK_FALSE(std::regex_search(line, forbidden));
            CHECK_FALSE(std::regex_search(line, power));
        }
    }
    CHECK(files > 10);
}
