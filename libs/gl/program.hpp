#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gl/framebuffer.hpp"
#include "gl/object.hpp"
#include "gl/shader_text.hpp"
#include "gl/texture.hpp"

namespace sky::gl {

/// A linked program; made by ProgramBuilder.
///
/// Uniforms are set by name, with the program bound or not. A name that the program doesn't use is ignored, because drivers
/// drop unused uniforms; a value of the wrong type is an OpenGL error that checkErrors reports.
class Program : public Object
{
public:
    bool has(std::string_view uniform) const { return location(uniform) >= 0; }

    void set(std::string_view uniform, float value);
    void set(std::string_view uniform, int value);
    void set(std::string_view uniform, unsigned value);
    void set(std::string_view uniform, const std::array<float, 2>& value);
    void set(std::string_view uniform, const std::array<float, 3>& value);
    void set(std::string_view uniform, const std::array<float, 4>& value);
    void set(std::string_view uniform, const std::array<int, 2>& value);
    void set(std::string_view uniform, const std::array<int, 3>& value);
    void set(std::string_view uniform, const std::array<int, 4>& value);
    /// Elements of `uniform float name[]`, `vec4 name[]`, or a mat3 by columns.
    void setFloats(std::string_view uniform, std::span<const float> values);
    void setVec4s(std::string_view uniform, std::span<const std::array<float, 4>> values);
    void setMat3(std::string_view uniform, const std::array<float, 9>& columns);

    /// Binds the texture to unit `unit` and tells the sampler so.
    void setTexture(std::string_view sampler, GLuint unit, const Texture& texture);
    /// Connects a uniform block or a storage block to a binding point. Storage blocks need GL 4.3.
    void setUniformBlock(std::string_view block, GLuint binding);

    /// Runs a compute program on x * y * z work groups; call memoryBarrier before reading what it wrote.
    ///   throws RangeError where a count is above the driver's limit
    void dispatch(unsigned x, unsigned y = 1, unsigned z = 1) const;
    /// As many work groups as cover x * y * z invocations; the shader leaves out those beyond.
    void dispatchOver(unsigned x, unsigned y = 1, unsigned z = 1) const;
    /// local_size_x, y, z of a compute program; zeros for others.
    const std::array<int, 3>& workGroupSize() const { return workGroupSize_; }

private:
    friend class ProgramBuilder;
    Program(const Api& api, std::string label);

    GLint location(std::string_view uniform) const;
    template<class Setter>
    void whileUsed(Setter&& setter) const;
    template<class Setter>
    void setUniform(std::string_view uniform, Setter&& setter) const;

    mutable std::map<std::string, GLint, std::less<>> locations_;
    std::array<int, 3> workGroupSize_{};
};

enum class ShaderStage { vertex, fragment, compute };

/// What a program is made of.
struct ProgramSource {
    std::string label;
    struct Stage {
        ShaderStage stage;
        std::string path;
    };
    std::vector<Stage> stages;
    std::vector<Define> defines{};
    std::vector<Snippet> snippets{};
    std::string version{}; ///< what follows #version; empty: 430 core for compute, 330 core, or 300 es, as the context is
};

/// Makes programs from shader files with #include; see expandShader.
class ProgramBuilder
{
public:
    ProgramBuilder(const Api& api, SourceProvider source) : api_(api), source_(std::move(source)) {}

    /// throws AtmoError  a description's block doesn't compile: file, line and column of the description, the driver's words
    ///        GlError    any other failure, with `file:line: message` of our shader files; or work groups above the limits
    Program build(const ProgramSource& source) const;

    Program compute(const std::string& label, const std::string& path, std::vector<Define> defines = {},
                    std::vector<Snippet> snippets = {}) const;
    Program graphics(const std::string& label, const std::string& vertexPath, const std::string& fragmentPath,
                     std::vector<Define> defines = {}, std::vector<Snippet> snippets = {}) const;

private:
    Api api_;
    SourceProvider source_;
};

/// A program, or a framebuffer with its viewport, bound for a scope: `gl::Bound pass{program};`. The former binding returns.
class Bound
{
public:
    explicit Bound(const Program& program);
    explicit Bound(const Framebuffer& framebuffer);
    ~Bound();
    Bound(const Bound&) = delete;
    Bound& operator=(const Bound&) = delete;

private:
    Api api_;
    bool isProgram_;
    GLint before_ = 0, readBefore_ = 0;
    std::array<GLint, 4> viewportBefore_{};
};

} // namespace sky::gl
