#include "context_for_tests.hpp"

#include <map>
#include <memory>

#include "gl/buffer.hpp"
#include "gl/framebuffer.hpp"
#include "gl/state_guard.hpp"
#include "gl/texture.hpp"

using namespace sky;

namespace {

/// What the context can be asked for, by name; enough numbers for the longest answer.
std::map<std::string, std::vector<GLint>> snapshot(const gl::Api& api)
{
    std::map<std::string, std::vector<GLint>> state;
    const auto ask = [&](const std::string& name, GLenum what) {
        std::vector<GLint> values(4, 0);
        api->GetIntegerv(what, values.data());
        state[name] = values;
    };
    const std::map<std::string, GLenum> names{{"program", GL_CURRENT_PROGRAM},
                                              {"vertex array", GL_VERTEX_ARRAY_BINDING},
                                              {"array buffer", GL_ARRAY_BUFFER_BINDING},
                                              {"copy write", GL_COPY_WRITE_BUFFER},
                                              {"uniform", GL_UNIFORM_BUFFER_BINDING},
                                              {"draw", GL_DRAW_FRAMEBUFFER_BINDING},
                                              {"read", GL_READ_FRAMEBUFFER_BINDING},
                                              {"unit", GL_ACTIVE_TEXTURE},
                                              {"viewport", GL_VIEWPORT},
                                              {"scissor box", GL_SCISSOR_BOX},
                                              {"mask", GL_COLOR_WRITEMASK},
                                              {"depth mask", GL_DEPTH_WRITEMASK},
                                              {"clear", GL_COLOR_CLEAR_VALUE},
                                              {"source", GL_BLEND_SRC_RGB},
                                              {"destination", GL_BLEND_DST_ALPHA},
                                              {"equation", GL_BLEND_EQUATION_RGB},
                                              {"blend", GL_BLEND},
                                              {"depth", GL_DEPTH_TEST},
                                              {"cull", GL_CULL_FACE},
                                              {"scissor", GL_SCISSOR_TEST},
                                              {"dither", GL_DITHER},
                                              {"stencil", GL_STENCIL_TEST}};
    for (const auto& [name, what] : names)
        ask(name, what);
    GLint unit = 0;
    api->GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    for (GLenum i = 0; i < 4; ++i) {
        api->ActiveTexture(GL_TEXTURE0 + i);
        ask("2D " + std::to_string(i), GL_TEXTURE_BINDING_2D);
        ask("3D " + std::to_string(i), GL_TEXTURE_BINDING_3D);
        ask("sampler " + std::to_string(i), GL_SAMPLER_BINDING);
    }
    api->ActiveTexture(static_cast<GLenum>(unit));
    GLint64 start = 0, size = 0;
    api->GetInteger64i_v(GL_UNIFORM_BUFFER_START, 2, &start);
    api->GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, 2, &size);
    state["uniform range"] = {static_cast<GLint>(start), static_cast<GLint>(size)};
    return state;
}

} // namespace

TEST_CASE("state guard: a host's state is as it was, in desktop GL and in ES", "[gl]")
{
    for (const bool es : {false, true}) {
        gl::HeadlessOptions options;
        if (es)
            options.version = {3, 0, true};
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        const gl::Api& api = context->api();
        CAPTURE(es);
        // A host that left nothing at its default.
        const gl::Texture2D flat(api, "flat", gl::TextureFormat::rgba8, 2, 2);
        const gl::Texture3D solid(api, "solid", gl::TextureFormat::rgba8, 2, 2, 2);
        const gl::Buffer buffer(api, "buffer", 4096);
        gl::Framebuffer framebuffer(api, "framebuffer");
        framebuffer.attach(0, flat);
        const gl::VertexArray vertices(api, "vertices");
        GLuint sampler = 0;
        api->GenSamplers(1, &sampler);
        flat.bindUnit(1);
        api->BindSampler(1, sampler);
        solid.bindUnit(3);
        api->BindBufferRange(GL_UNIFORM_BUFFER, 2, buffer.name(), 1024, 256);
        api->BindBuffer(GL_ARRAY_BUFFER, buffer.name());
        api->BindBuffer(GL_COPY_WRITE_BUFFER, buffer.name());
        api->BindVertexArray(vertices.name());
        api->BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        for (const GLenum what : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST})
            api->Enable(what);
        api->Disable(GL_DITHER);
        api->BlendFuncSeparate(GL_ONE, GL_SRC_COLOR, GL_DST_COLOR, GL_ONE);
        api->BlendEquation(GL_FUNC_SUBTRACT);
        api->Viewport(1, 2, 30, 40);
        api->Scissor(3, 4, 5, 6);
        api->ColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
        api->ClearColor(1.0f, 0.0f, 1.0f, 0.0f);
        const auto before = snapshot(api);
        {
            const gl::StateGuard guard(api);
            CHECK(snapshot(api) != before);
            CHECK(api->IsEnabled(GL_BLEND) == GL_FALSE);
            CHECK(api->IsEnabled(GL_SCISSOR_TEST) == GL_FALSE);
            gl::Texture2D ours(api, "ours", gl::TextureFormat::rgba8, 4, 4);
            gl::Framebuffer target(api, "target");
            target.attach(0, ours);
            api->BindFramebuffer(GL_FRAMEBUFFER, target.name());
            for (GLuint unit = 0; unit < 4; ++unit)
                ours.bindUnit(unit);
            buffer.bindUniform(2);
            vertices.drawFullScreenTriangle();
            while (api->GetError() != GL_NO_ERROR) {
            } // drawing without a program is an error here; only the state counts
            api->Enable(GL_BLEND);
            api->BlendFunc(GL_ZERO, GL_ZERO);
            api->BlendEquation(GL_MAX);
            api->Viewport(0, 0, 4, 4);
            api->Scissor(0, 0, 1, 1);
            api->ClearColor(0.0f, 1.0f, 0.0f, 1.0f);
        }
        for (const auto& [name, values] : snapshot(api)) {
            CAPTURE(name);
            CHECK(values == before.at(name));
        }
        gl::checkErrors(api, "test");
        api->DeleteSamplers(1, &sampler);
    }
}

TEST_CASE("state guard: a unit whose texture was deleted meanwhile stays empty, without an error", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Api& api = context->api();
    auto texture = std::make_unique<gl::Texture2D>(api, "replaced", gl::TextureFormat::rgba8, 2, 2);
    texture->bindUnit(3);
    {
        const gl::StateGuard guard(api);
        texture.reset();
    }
    GLint bound = -1;
    api->ActiveTexture(GL_TEXTURE3);
    api->GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    CHECK(bound == 0);
    CHECK(api->GetError() == GL_NO_ERROR);
}
