#include "gl/texture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "gl/framebuffer.hpp"
#include "gl/pixel_store.hpp"

namespace sky::gl {

namespace {

struct FormatTraits {
    GLenum internal, external;
    int channels;
};

const FormatTraits& traits(TextureFormat format)
{
    static constexpr FormatTraits table[] = {
        {GL_R16F, GL_RED, 1}, {GL_RG16F, GL_RG, 2},     {GL_RGBA16F, GL_RGBA, 4}, {GL_R32F, GL_RED, 1},
        {GL_RG32F, GL_RG, 2}, {GL_RGBA32F, GL_RGBA, 4}, {GL_RGBA8, GL_RGBA, 4},
    };
    return table[static_cast<int>(format)];
}

GLenum bindingQuery(GLenum target) { return target == GL_TEXTURE_3D ? GL_TEXTURE_BINDING_3D : GL_TEXTURE_BINDING_2D; }

bool is32Bit(TextureFormat format)
{
    return format == TextureFormat::r32f || format == TextureFormat::rg32f || format == TextureFormat::rgba32f;
}

std::vector<std::uint8_t> toBytes(const float* values, std::size_t count)
{
    std::vector<std::uint8_t> bytes(count);
    std::transform(values, values + count, bytes.begin(),
                   [](float v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f)); });
    return bytes;
}

} // namespace

int channels(TextureFormat format) { return traits(format).channels; }
GLenum internalFormat(TextureFormat format) { return traits(format).internal; }

template<class Action>
void Texture::whileBound(Action&& action) const
{
    GLint before = 0;
    api()->GetIntegerv(bindingQuery(target_), &before);
    api()->BindTexture(target_, name());
    action();
    api()->BindTexture(target_, static_cast<GLuint>(before));
}

Texture::Texture(const Api& context, std::string labelText, GLenum target, TextureFormat format, TextureSize size)
    : Object(context, Kind::texture, std::move(labelText)), target_(target), format_(format), size_(size)
{
    const Api& gl = api();
    const int largest = target == GL_TEXTURE_3D ? gl.limits().texture3dSize : gl.limits().textureSize;
    for (const int side : {size.width, size.height, size.depth})
        if (side < 1 || side > largest)
            throw RangeError("Texture \"" + label() + "\": a side of " + std::to_string(side) + " texels; this driver allows 1 to " +
                             std::to_string(largest) + ".");
    whileBound([&] {
        const FormatTraits& t = traits(format_);
        const GLenum type = format_ == TextureFormat::rgba8 ? GL_UNSIGNED_BYTE : GL_FLOAT;
        const PixelStoreScope pixelStore(gl, PixelTransfer::unpack); // with the host's buffer bound, null is an offset
        if (target_ == GL_TEXTURE_3D)
            gl->TexImage3D(target_, 0, static_cast<GLint>(t.internal), size_.width, size_.height, size_.depth, 0, t.external, type,
                           nullptr);
        else
            gl->TexImage2D(target_, 0, static_cast<GLint>(t.internal), size_.width, size_.height, 0, t.external, type, nullptr);
        gl->TexParameteri(target_, GL_TEXTURE_BASE_LEVEL, 0);
        gl->TexParameteri(target_, GL_TEXTURE_MAX_LEVEL, 0);
        applyLabel();
    });
    const bool filterable = !gl.isEs() || !is32Bit(format_) || gl->OES_texture_float_linear;
    setFilter(filterable ? Filter::linear : Filter::nearest);
    setWrap(Wrap::clampToEdge, Wrap::clampToEdge, Wrap::clampToEdge);
    checkErrors(gl, "allocating a texture", label());
}

void Texture::upload(const std::vector<float>& values)
{
    const std::size_t expected = size_.texels() * static_cast<std::size_t>(channels(format_));
    if (values.size() != expected)
        throw RangeError("Texture \"" + label() + "\": " + std::to_string(values.size()) + " values given; it holds " +
                         std::to_string(expected) + ".");
    uploadSlices(0, size_.depth, values.data());
}

void Texture::uploadSlices(int first, int count, const float* values)
{
    if (first < 0 || count < 0 || first > size_.depth - count)
        throw RangeError("Texture \"" + label() + "\": slices " + std::to_string(first) + " to " + std::to_string(first + count - 1) +
                         " are outside 0 to " + std::to_string(size_.depth - 1) + ".");
    const Api& gl = api();
    const FormatTraits& t = traits(format_);
    const void* data = values;
    GLenum type = GL_FLOAT;
    std::vector<std::uint8_t> bytes;
    if (format_ == TextureFormat::rgba8) { // ES takes bytes only
        bytes = toBytes(values, TextureSize{size_.width, size_.height, count}.texels() * 4);
        data = bytes.data();
        type = GL_UNSIGNED_BYTE;
    }
    whileBound([&] {
        const PixelStoreScope pixelStore(gl, PixelTransfer::unpack);
        if (target_ == GL_TEXTURE_3D)
            gl->TexSubImage3D(target_, 0, 0, 0, first, size_.width, size_.height, count, t.external, type, data);
        else
            gl->TexSubImage2D(target_, 0, 0, 0, size_.width, size_.height, t.external, type, data);
    });
}

std::vector<float> Texture::download() const
{
    const Api& gl = api();
    const auto used = static_cast<std::size_t>(channels(format_));
    std::vector<float> values(size_.texels() * used);
    const PixelStoreScope pixelStore(gl, PixelTransfer::pack);
    if (!gl.isEs()) {
        whileBound([&] { gl->GetTexImage(target_, 0, traits(format_).external, GL_FLOAT, values.data()); });
        checkErrors(gl, "reading a texture back", label());
        return values;
    }
    // OpenGL ES reads through a framebuffer, slice by slice, always four channels.
    Framebuffer reader(gl, label() + " read-back");
    const std::size_t sliceTexels = static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
    for (int slice = 0; slice < size_.depth; ++slice) {
        reader.attach(0, *this, slice);
        const std::vector<float> rgba = reader.readPixels(0, format_ == TextureFormat::rgba8);
        for (std::size_t i = 0; i < sliceTexels * used; ++i)
            values[static_cast<std::size_t>(slice) * sliceTexels * used + i] = rgba[i / used * 4 + i % used];
    }
    return values;
}

void Texture::setFilter(Filter filter)
{
    const GLint value = filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
    whileBound([&] {
        api()->TexParameteri(target_, GL_TEXTURE_MIN_FILTER, value);
        api()->TexParameteri(target_, GL_TEXTURE_MAG_FILTER, value);
    });
}

void Texture::setWrap(Wrap x, Wrap y, Wrap z)
{
    const auto value = [](Wrap wrap) { return wrap == Wrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE; };
    whileBound([&] {
        api()->TexParameteri(target_, GL_TEXTURE_WRAP_S, value(x));
        api()->TexParameteri(target_, GL_TEXTURE_WRAP_T, value(y));
        if (target_ == GL_TEXTURE_3D)
            api()->TexParameteri(target_, GL_TEXTURE_WRAP_R, value(z));
    });
}

void Texture::bindUnit(GLuint unit) const
{
    api()->ActiveTexture(GL_TEXTURE0 + unit);
    api()->BindTexture(target_, name());
}

void Texture::bindImage(GLuint unit, GLenum access) const
{
    const GLboolean layered = target_ == GL_TEXTURE_3D ? GL_TRUE : GL_FALSE;
    api()->BindImageTexture(unit, name(), 0, layered, 0, access, traits(format_).internal);
}

Texture2D::Texture2D(const Api& context, std::string labelText, TextureFormat format, int width, int height)
    : Texture(context, std::move(labelText), GL_TEXTURE_2D, format, {width, height, 1})
{
}

Texture3D::Texture3D(const Api& context, std::string labelText, TextureFormat format, int width, int height, int depth)
    : Texture(context, std::move(labelText), GL_TEXTURE_3D, format, {width, height, depth})
{
}

} // namespace sky::gl
