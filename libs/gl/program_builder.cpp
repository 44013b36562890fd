#include <algorithm>

#include "base/error.hpp"
#include "gl/program.hpp"

namespace sky::gl {

namespace {

GLenum shaderType(ShaderStage stage)
{
    switch (stage) {
    case ShaderStage::vertex: return GL_VERTEX_SHADER;
    case ShaderStage::fragment: return GL_FRAGMENT_SHADER;
    default: return GL_COMPUTE_SHADER;
    }
}

/// A shader lives until its program is linked.
class Shader
{
public:
    Shader(const Api& api, ShaderStage stage) : api_(api), name_(api_->CreateShader(shaderType(stage))) {}
    ~Shader() { api_->DeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    GLuint name() const { return name_; }

    void compile(const ShaderText& shader, const std::string& label) const
    {
        const GLchar* text = shader.text.data();
        const auto length = static_cast<GLint>(shader.text.size());
        api_->ShaderSource(name_, 1, &text, &length);
        api_->CompileShader(name_);
        api_.label(GL_SHADER, name_, label);
        GLint compiled = GL_FALSE;
        api_->GetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (compiled)
            return;
        GLint logLength = 0;
        api_->GetShaderiv(name_, GL_INFO_LOG_LENGTH, &logLength);
        std::string log(static_cast<std::size_t>(std::max(logLength, 0)), '\0');
        GLsizei written = 0;
        if (logLength > 0)
            api_->GetShaderInfoLog(name_, logLength, &written, log.data());
        log.resize(static_cast<std::size_t>(written));
        throwCompileError(shader, label, log);
    }

private:
    const Api& api_;
    GLuint name_;
};

void link(const Program& program)
{
    const Api& gl = program.api();
    gl->LinkProgram(program.name());
    GLint linked = GL_FALSE;
    gl->GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked)
        return;
    GLint logLength = 0;
    gl->GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &logLength);
    std::string log(static_cast<std::size_t>(std::max(logLength, 0)), '\0');
    GLsizei written = 0;
    if (logLength > 0)
        gl->GetProgramInfoLog(program.name(), logLength, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    throw GlError("Program \"" + program.label() + "\" can't be linked: " + (log.empty() ? "no reason is given." : log));
}

} // namespace

Program ProgramBuilder::build(const ProgramSource& source) const
{
    const bool isCompute =
        std::any_of(source.stages.begin(), source.stages.end(), [](const auto& stage) { return stage.stage == ShaderStage::compute; });
    if (isCompute && !api_.hasCompute())
        throw GlError("Program \"" + source.label + "\" needs compute shaders, OpenGL 4.3; this context is \"" + api_.versionText() +
                      "\".");
    std::string version = source.version;
    if (version.empty())
        version = api_.isEs() ? "300 es" : isCompute ? "430 core" : "330 core";

    Program program(api_, source.label);
    for (const ProgramSource::Stage& stage : source.stages) {
        const ShaderText text = expandShader(source_, stage.path, version, source.defines, source.snippets);
        const Shader shader(api_, stage.stage);
        shader.compile(text, source.label + ": " + stage.path);
        // Deleting an attached shader only marks it; it goes with its program.
        api_->AttachShader(program.name(), shader.name());
    }
    link(program);
    if (isCompute)
        api_->GetProgramiv(program.name(), GL_COMPUTE_WORK_GROUP_SIZE, program.workGroupSize_.data());
    checkErrors(api_, "building a program", source.label);
    return program;
}

Program ProgramBuilder::compute(const std::string& label, const std::string& path, std::vector<Define> defines,
                                std::vector<Snippet> snippets) const
{
    return build({label, {{ShaderStage::compute, path}}, std::move(defines), std::move(snippets)});
}

Program ProgramBuilder::graphics(const std::string& label, const std::string& vertexPath, const std::string& fragmentPath,
                                 std::vector<Define> defines, std::vector<Snippet> snippets) const
{
    return build(
        {label, {{ShaderStage::vertex, vertexPath}, {ShaderStage::fragment, fragmentPath}}, std::move(defines), std::move(snippets)});
}

} // namespace sky::gl
