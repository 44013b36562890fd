#pragma once

#include <string>
#include <vector>

#include "gl/object.hpp"

namespace sky::gl {

enum class TextureFormat { r16f, rg16f, rgba16f, r32f, rg32f, rgba32f, rgba8 };
enum class Filter { nearest, linear };
enum class Wrap { clampToEdge, repeat };

int channels(TextureFormat format);
GLenum internalFormat(TextureFormat format);

/// Width, height and depth in texels; depth is 1 for 2D textures.
struct TextureSize {
    int width = 1, height = 1, depth = 1;
    std::size_t texels() const
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(depth);
    }
    bool operator==(const TextureSize&) const = default;
};

/// What 2D and 3D textures share. One level, no mipmaps. Made with linear filtering and clamping at the edges;
/// 32-bit floats start with nearest filtering in OpenGL ES where the driver can't filter them.
/// Making, uploading and changing a texture bind it to the active unit; its former binding is put back.
class Texture : public Object
{
public:
    const TextureSize& size() const { return size_; }
    TextureFormat format() const { return format_; }
    GLenum target() const { return target_; }

    /// The whole content: texels() x channels() floats, first texel at texture coordinate (0, 0, 0).
    void upload(const std::vector<float>& values);
    /// Slices `first` .. `first + count - 1` in depth: so much of a 3D texture.
    void uploadSlices(int first, int count, const float* values);
    std::vector<float> download() const;

    void setFilter(Filter filter);
    void setWrap(Wrap x, Wrap y, Wrap z = Wrap::clampToEdge);

    /// Binds to texture unit `unit`, counted from 0, and leaves that unit active.
    void bindUnit(GLuint unit) const;
    /// Binds as an image of compute shaders, all layers; access is GL_READ_ONLY, GL_WRITE_ONLY or GL_READ_WRITE. GL 4.3.
    void bindImage(GLuint unit, GLenum access) const;

protected:
    Texture(const Api& api, std::string label, GLenum target, TextureFormat format, TextureSize size);

private:
    template<class Action>
    void whileBound(Action&& action) const;

    GLenum target_;
    TextureFormat format_;
    TextureSize size_;
};

class Texture2D : public Texture
{
public:
    Texture2D(const Api& api, std::string label, TextureFormat format, int width, int height);
};

class Texture3D : public Texture
{
public:
    Texture3D(const Api& api, std::string label, TextureFormat format, int width, int height, int depth);
};

} // namespace sky::gl
