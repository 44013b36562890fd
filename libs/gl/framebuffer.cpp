#include "gl/framebuffer.hpp"

#include <algorithm>
#include <cstdint>

#include "base/error.hpp"
#include "gl/pixel_store.hpp"

namespace sky::gl {

namespace {

const char* completenessName(GLenum status)
{
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT: return "an attachment can't be drawn to (format not supported?)";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT: return "nothing is attached";
    case GL_FRAMEBUFFER_UNSUPPORTED: return "the driver doesn't support this combination of formats";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE: return "the attachments differ in samples";
    default: return "it is incomplete";
    }
}

/// Binds a framebuffer for drawing and reading, and puts the former ones back.
class BindingScope
{
public:
    BindingScope(const Api& api, GLuint name) : api_(api)
    {
        api_->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
        api_->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
        api_->BindFramebuffer(GL_FRAMEBUFFER, name);
    }
    ~BindingScope()
    {
        api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
        api_->BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    }
    BindingScope(const BindingScope&) = delete;
    BindingScope& operator=(const BindingScope&) = delete;

private:
    const Api& api_;
    GLint draw_ = 0, read_ = 0;
};

} // namespace

Framebuffer::Framebuffer(const Api& context, std::string labelText) : Object(context, Kind::framebuffer, std::move(labelText))
{
    const BindingScope binding(api(), name());
    applyLabel();
}

void Framebuffer::attach(int index, const Texture& texture, int slice)
{
    const Api& gl = api();
    const BindingScope binding(gl, name());
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index);
    if (texture.target() == GL_TEXTURE_3D)
        gl->FramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture.name(), 0, slice);
    else
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
    outputs_.resize(std::max(outputs_.size(), static_cast<std::size_t>(index) + 1), GL_NONE);
    outputs_[static_cast<std::size_t>(index)] = attachment;
    gl->DrawBuffers(static_cast<GLsizei>(outputs_.size()), outputs_.data());
    width_ = texture.size().width;
    height_ = texture.size().height;
    const GLenum status = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
    checkErrors(gl, "attaching \"" + texture.label() + "\" to a framebuffer", label());
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw GlError("Framebuffer \"" + label() + "\" with texture \"" + texture.label() + "\": " + completenessName(status) + ".");
}

std::vector<float> Framebuffer::readPixels(int index, bool bytes) const
{
    const Api& gl = api();
    const BindingScope binding(gl, name());
    const PixelStoreScope pixelStore(gl, PixelTransfer::pack);
    gl->ReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index));
    std::vector<float> values(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4);
    if (bytes) {
        std::vector<std::uint8_t> raw(values.size());
        gl->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, raw.data());
        std::transform(raw.begin(), raw.end(), values.begin(), [](std::uint8_t v) { return static_cast<float>(v) / 255.0f; });
    } else {
        gl->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, values.data());
    }
    checkErrors(gl, "reading pixels back", label());
    return values;
}

VertexArray::VertexArray(const Api& context, std::string labelText) : Object(context, Kind::vertexArray, std::move(labelText))
{
    api()->BindVertexArray(name());
    applyLabel();
    api()->BindVertexArray(0);
}

void VertexArray::drawFullScreenTriangle() const
{
    api()->BindVertexArray(name());
    api()->DrawArrays(GL_TRIANGLES, 0, 3);
    api()->BindVertexArray(0);
}

} // namespace sky::gl
