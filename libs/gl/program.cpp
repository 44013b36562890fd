#include "gl/program.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace sky::gl {

Program::Program(const Api& context, std::string labelText) : Object(context, Kind::program, std::move(labelText)) { applyLabel(); }

GLint Program::location(std::string_view uniform) const
{
    const auto known = locations_.find(uniform);
    if (known != locations_.end())
        return known->second;
    const std::string text(uniform);
    const GLint found = api()->GetUniformLocation(name(), text.c_str());
    locations_.emplace(text, found);
    return found;
}

// glProgramUniform would be shorter, but GL 3.3 and ES 3.0 lack it.
template<class Action>
void Program::whileUsed(Action&& action) const
{
    const Api& gl = api();
    GLint before = 0;
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &before);
    const bool change = static_cast<GLuint>(before) != name();
    if (change)
        gl->UseProgram(name());
    action();
    if (change)
        gl->UseProgram(static_cast<GLuint>(before));
}

template<class Setter>
void Program::setUniform(std::string_view uniform, Setter&& setter) const
{
    const GLint place = location(uniform);
    if (place >= 0)
        whileUsed([&] { setter(api(), place); });
}

void Program::set(std::string_view uniform, float value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform1f(at, value); });
}
void Program::set(std::string_view uniform, int value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform1i(at, value); });
}
void Program::set(std::string_view uniform, unsigned value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform1ui(at, value); });
}
void Program::set(std::string_view uniform, const std::array<float, 2>& value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform2fv(at, 1, value.data()); });
}
void Program::set(std::string_view uniform, const std::array<float, 3>& value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform3fv(at, 1, value.data()); });
}
void Program::set(std::string_view uniform, const std::array<float, 4>& value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform4fv(at, 1, value.data()); });
}
void Program::set(std::string_view uniform, const std::array<int, 2>& value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform2iv(at, 1, value.data()); });
}
void Program::set(std::string_view uniform, const std::array<int, 3>& value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform3iv(at, 1, value.data()); });
}
void Program::set(std::string_view uniform, const std::array<int, 4>& value)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform4iv(at, 1, value.data()); });
}
void Program::setFloats(std::string_view uniform, std::span<const float> values)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->Uniform1fv(at, static_cast<GLsizei>(values.size()), values.data()); });
}
void Program::setVec4s(std::string_view uniform, std::span<const std::array<float, 4>> values)
{
    setUniform(uniform, [&](const Api& gl, GLint at) {
        gl->Uniform4fv(at, static_cast<GLsizei>(values.size()), values.empty() ? nullptr : values.front().data());
    });
}
void Program::setMat3(std::string_view uniform, const std::array<float, 9>& columns)
{
    setUniform(uniform, [&](const Api& gl, GLint at) { gl->UniformMatrix3fv(at, 1, GL_FALSE, columns.data()); });
}

void Program::setTexture(std::string_view sampler, GLuint unit, const Texture& texture)
{
    texture.bindUnit(unit);
    set(sampler, static_cast<int>(unit));
}

void Program::setUniformBlock(std::string_view block, GLuint binding)
{
    const Api& gl = api();
    const std::string text(block);
    const GLuint uniformBlock = gl->GetUniformBlockIndex(name(), text.c_str());
    if (uniformBlock != GL_INVALID_INDEX)
        gl->UniformBlockBinding(name(), uniformBlock, binding);
    if (!gl.hasCompute())
        return;
    const GLuint storageBlock = gl->GetProgramResourceIndex(name(), GL_SHADER_STORAGE_BLOCK, text.c_str());
    if (storageBlock != GL_INVALID_INDEX)
        gl->ShaderStorageBlockBinding(name(), storageBlock, binding);
}

void Program::dispatch(unsigned x, unsigned y, unsigned z) const
{
    if (workGroupSize_[0] == 0)
        throw GlError("Program \"" + label() + "\" has no compute stage and can't be dispatched.");
    const std::array<unsigned, 3> groups{x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int most = api().limits().workGroupCount[axis];
        if (groups[axis] > static_cast<unsigned>(most))
            throw RangeError("Program \"" + label() + "\": " + std::to_string(groups[axis]) + " work groups along " + "xyz"[axis] +
                             "; this driver allows 0 to " + std::to_string(most) + ".");
    }
    whileUsed([&] { api()->DispatchCompute(x, y, z); });
}

void Program::dispatchOver(unsigned x, unsigned y, unsigned z) const
{
    const auto groups = [&](unsigned count, std::size_t axis) {
        const auto size = static_cast<unsigned>(std::max(workGroupSize_[axis], 1));
        return count / size + (count % size != 0 ? 1u : 0u);
    };
    dispatch(groups(x, 0), groups(y, 1), groups(z, 2));
}

Bound::Bound(const Program& program) : api_(program.api()), isProgram_(true)
{
    api_->GetIntegerv(GL_CURRENT_PROGRAM, &before_);
    api_->UseProgram(program.name());
}

Bound::Bound(const Framebuffer& framebuffer) : api_(framebuffer.api()), isProgram_(false)
{
    api_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before_);
    api_->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &readBefore_);
    api_->GetIntegerv(GL_VIEWPORT, viewportBefore_.data());
    api_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    api_->Viewport(0, 0, framebuffer.width(), framebuffer.height());
}

Bound::~Bound()
{
    if (!api_.alive())
        return;
    if (isProgram_) {
        api_->UseProgram(static_cast<GLuint>(before_));
        return;
    }
    api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before_));
    api_->BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(readBefore_));
    api_->Viewport(viewportBefore_[0], viewportBefore_[1], viewportBefore_[2], viewportBefore_[3]);
}

} // namespace sky::gl
