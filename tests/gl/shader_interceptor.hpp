#pragma once
// A step between us and the driver: puts functions into every shader that are worse than the driver's.

#include "gl/context.hpp"
#include <string>
#include <utility>

namespace sky::gl::testing {

/// One at a time: OpenGL's functions have no place for a pointer of ours.
class ShaderInterceptor
{
public:
    /// \param prelude GLSL that goes into every shader, before its first line of code
    explicit ShaderInterceptor(std::string prelude) : prelude_(std::move(prelude)) { active() = this; }
    ~ShaderInterceptor() { active() = nullptr; }
    ShaderInterceptor(const ShaderInterceptor&) = delete;
    ShaderInterceptor& operator=(const ShaderInterceptor&) = delete;

    /// Stands from now on before the driver of a context of ours...
    void standBefore(HeadlessContext& context)
    {
        auto& functions = const_cast<GladGLContext&>(*context.api().operator->());
        shaderSource_ = std::exchange(functions.ShaderSource, &giveSource);
    }

    /// ... or of one that is borrowed through a loader.
    Loader loader(Loader driver)
    {
        shaderSource_ = reinterpret_cast<PFNGLSHADERSOURCEPROC>(driver("glShaderSource"));
        return [driver = std::move(driver)](const char* name) {
            return std::string_view(name) == "glShaderSource" ? reinterpret_cast<void*>(&giveSource) : driver(name);
        };
    }

    int shaders() const { return shaders_; }

private:
    static ShaderInterceptor*& active()
    {
        static ShaderInterceptor* it = nullptr;
        return it;
    }

    static void GLAD_API_PTR giveSource(GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths)
    {
        ShaderInterceptor& self = *active();
        std::string text;
        for (GLsizei i = 0; i < count; ++i)
            text += lengths && lengths[i] >= 0 ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : texts[i];
        // #version and ES's precisions come first.
        std::size_t start = 0;
        while (text.compare(start, 8, "#version") == 0 || text.compare(start, 9, "precision") == 0)
            start = text.find('\n', start) + 1;
        text.insert(start, self.prelude_);
        const GLchar* whole = text.data();
        const auto length = static_cast<GLint>(text.size());
        self.shaderSource_(shader, 1, &whole, &length);
        ++self.shaders_;
    }

    std::string prelude_;
    PFNGLSHADERSOURCEPROC shaderSource_ = nullptr;
    int shaders_ = 0;
};

} // namespace sky::gl::testing
