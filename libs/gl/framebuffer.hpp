#pragma once

#include <vector>

#include "gl/texture.hpp"

namespace sky::gl {

/// A set of textures to draw into. Edits put the host's framebuffer bindings back.
class Framebuffer : public Object
{
public:
    Framebuffer(const Api& api, std::string label);

    /// Draws to colour output `index` go to `texture`, slice `slice` of it if it is 3D. Checked for completeness.
    ///   throws GlError that names the framebuffer and what is wrong with it
    void attach(int index, const Texture& texture, int slice = 0);

    /// width x height x 4 floats of colour output `index`, bottom row first. Waits for the GPU.
    ///   bytes  the attachment is an 8-bit one: OpenGL ES reads those as bytes only
    std::vector<float> readPixels(int index, bool bytes = false) const;

    int width() const { return width_; }
    int height() const { return height_; }

private:
    int width_ = 0, height_ = 0;
    std::vector<GLenum> outputs_;
};

/// Attributes of vertices. The core profile wants one even to draw a triangle made in the shader.
class VertexArray : public Object
{
public:
    VertexArray(const Api& api, std::string label);
    /// Draws one triangle that covers the viewport; its vertex shader makes the corners from gl_VertexID (0, 1, 2).
    /// Leaves no vertex array bound.
    void drawFullScreenTriangle() const;
};

} // namespace sky::gl
