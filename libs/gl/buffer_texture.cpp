#include "gl/buffer_texture.hpp"

#include "base/error.hpp"

namespace sky::gl {

BufferTexture::BufferTexture(const Api& api, std::string label, const Buffer& buffer, const int components)
    : Object(api, Kind::texture, std::move(label))
{
    // Beyond its limit a driver reads zeros, and says nothing.
    const std::size_t texels = buffer.bytes() / (static_cast<std::size_t>(components) * sizeof(float)), most = maxTexels(api);
    if (texels > most)
        throw GlError("The table \"" + buffer.label() + "\" has " + std::to_string(texels) +
                      " texels, but this driver's shaders can't see more than " + std::to_string(most) +
                      " of a buffer. Choose another device, or a lower quality.");
    GLint before = 0;
    api->GetIntegerv(GL_TEXTURE_BINDING_BUFFER, &before);
    api->BindTexture(GL_TEXTURE_BUFFER, name());
    api->TexBuffer(GL_TEXTURE_BUFFER, components == 4 ? GL_RGBA32F : GL_R32F, buffer.name());
    applyLabel();
    api->BindTexture(GL_TEXTURE_BUFFER, static_cast<GLuint>(before));
}

void BufferTexture::bindUnit(const GLuint unit) const
{
    api()->ActiveTexture(GL_TEXTURE0 + unit);
    api()->BindTexture(GL_TEXTURE_BUFFER, name());
}

std::size_t BufferTexture::maxTexels(const Api& api)
{
    GLint texels = 65536;
    api->GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return static_cast<std::size_t>(texels);
}

} // namespace sky::gl
