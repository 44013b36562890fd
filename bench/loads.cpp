// What a load costs in a compute shader, by where the data lies: why tables are buffer textures (docs/method, 8).
//
//   bench_loads        prints nanoseconds per vec4, all cores together, best of five

#include "base/error.hpp"
#include "gl/buffer_texture.hpp"
#include "gl/context.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"
#include <chrono>
#include <cstdio>
#include <string>

using namespace sky;

namespace {

constexpr int texels = 3600, invocations = 1 << 17, loads = 256;

const char* const frame = R"(layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Storage { vec4 storageData[]; };
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; };
layout(std140, binding = 0) uniform Block { vec4 blockData[3600]; };
layout(binding = 0) uniform samplerBuffer texelBuffer;
layout(binding = 1) uniform sampler2D picture;
void main()
{
    uint id = gl_GlobalInvocationID.x;
    int start = int((id * 7u) % 1000u);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 4; ++j) {
            int k = start + 15 * i + j;
            sum = sum * 0.9 + LOAD;
        }
    results[id] = sum;
}
)";

double nanoseconds(const gl::Api& api, const std::string& load)
{
    const auto source = [](std::string_view) { return std::string_view(frame); };
    const auto program = gl::ProgramBuilder(api, source).compute("load", "load.comp", {{"LOAD", load}});
    const gl::Bound pass(program);
    double best = 1e30;
    program.dispatch(1);
    api->Finish();
    for (int run = 0; run < 5; ++run) {
        const auto begin = std::chrono::steady_clock::now();
        program.dispatch(invocations / 64);
        api->Finish();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return best / invocations / loads * 1e9;
}

} // namespace

int main()
{
    try {
        gl::HeadlessContext context;
        const gl::Api& api = context.api();
        const std::vector<float> values(texels * 4, 1.F);
        const gl::Buffer data(api, "data", values), results(api, "results", invocations * 16);
        const gl::BufferTexture view(api, "view", data);
        gl::Texture2D picture(api, "picture", gl::TextureFormat::rgba32f, 60, 60);
        picture.upload(values);
        data.bindStorage(0);
        results.bindStorage(1);
        data.bindUniform(0);
        view.bindUnit(0);
        picture.bindUnit(1);
        std::printf("%s\n", api.renderer().c_str());
        const std::pair<const char*, const char*> kinds[] = {
            {"no load", "vec4(float(k))"},
            {"samplerBuffer", "texelFetch(texelBuffer, k)"},
            {"uniform block", "blockData[k]"},
            {"storage buffer", "storageData[k]"},
            {"2D texture, one texel", "texelFetch(picture, ivec2(k % 60, i % 60), 0)"},
            {"2D texture, filtered", "textureLod(picture, vec2(float(k) * 1e-3, float(j) * 0.1), 0.0)"}};
        for (const auto& [name, load] : kinds)
            std::printf("%-22s %5.2f ns per vec4\n", name, nanoseconds(api, load));
    } catch (const Error& error) {
        std::fprintf(stderr, "bench_loads: %s\n", error.what());
        return 1;
    }
}
