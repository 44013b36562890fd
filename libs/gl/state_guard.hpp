#pragma once

#include <array>
#include <vector>

#include "gl/api.hpp"

namespace sky::gl {

/// How many binding points, counted from 0, a StateGuard saves.
struct GuardedBindings {
    int textureUnits = 16;
    int uniformBuffers = 8;
    int storageBuffers = 0; ///< saved from GL 4.3 on
    int imageUnits = 0;     ///< saved from GL 4.3 on
};

/// For drawing in a borrowed context. Saves all state that a renderer touches, makes it neutral (no blending, tests, culling,
/// clipping, logic operation or sRGB conversion; all colours written; no sampler objects; no program, pipeline or vertex
/// array), and puts all of it back at the end of the scope.
///
/// Errors that the host left unread are dropped at the start: OpenGL couldn't tell them from ours.
/// Pixel-store state is not here: each transfer saves it itself (PixelStoreScope).
class StateGuard
{
public:
    explicit StateGuard(const Api& api, const GuardedBindings& bindings = {});
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

private:
    struct TextureUnit {
        GLint texture2d = 0, texture3d = 0, sampler = 0;
    };
    struct IndexedBuffer {
        GLint buffer = 0;
        GLint64 start = 0, size = 0;
    };
    struct ImageUnit {
        GLint texture = 0, level = 0, layered = 0, layer = 0, access = 0, format = 0;
    };
    struct DrawBuffer {
        bool blend = false;
        std::array<GLint, 6> blending{}; // source and destination factors, equations: colour, alpha
        std::array<GLboolean, 4> mask{};
    };
    struct ViewportState {
        std::array<GLfloat, 4> box{};
        std::array<GLint, 4> scissorBox{};
        bool scissor = false;
    };

    void saveSwitches();
    void saveFixedFunction();
    void saveBindings(const GuardedBindings& wanted);
    void saveBuffers(GLenum target, GLenum query, GLenum start, GLenum size, int count, GLint& generic,
                     std::vector<IndexedBuffer>& indexed) const;
    void restoreBuffers(GLenum target, GLint generic, const std::vector<IndexedBuffer>& indexed) const;
    void restoreFixedFunction() const;
    void restoreBindings() const;

    Api api_;
    bool indexedBlend_, indexedFunctions_, indexedViewports_;
    std::vector<std::pair<GLenum, bool>> switches_;
    std::vector<DrawBuffer> drawBuffers_;
    std::vector<ViewportState> viewports_;
    std::array<GLfloat, 4> clearColor_{}, blendColor_{};
    GLboolean depthMask_ = GL_TRUE;
    std::array<GLint, 2> polygonMode_{};
    GLint program_ = 0, pipeline_ = 0, vertexArray_ = 0, drawFramebuffer_ = 0, readFramebuffer_ = 0, activeTexture_ = 0;
    GLint uniformBuffer_ = 0, storageBuffer_ = 0;
    std::array<GLint, 5> plainBuffers_{};
    std::vector<TextureUnit> textureUnits_;
    std::vector<IndexedBuffer> uniformBuffers_, storageBuffers_;
    std::vector<ImageUnit> imageUnits_;
};

} // namespace sky::gl
