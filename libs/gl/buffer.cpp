#include "gl/buffer.hpp"

#include <cstring>

#include "base/error.hpp"

namespace sky::gl {

// GL_COPY_WRITE_BUFFER serves edits: nothing that draws reads it, and GL 3.3 and ES 3.0 both have it.
Buffer::Buffer(const Api& context, std::string labelText, std::size_t byteCount, const void* data)
    : Object(context, Kind::buffer, std::move(labelText)), bytes_(byteCount)
{
    if (bytes_ == 0)
        throw RangeError("Buffer \"" + label() + "\": its size is 0 bytes; expected at least 1.");
    const Api& gl = api();
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, name());
    gl->BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes_), data, GL_DYNAMIC_COPY);
    applyLabel();
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, 0);
    checkErrors(gl, "allocating a buffer of " + std::to_string(bytes_) + " bytes", label());
}

void Buffer::checkRange(std::size_t count, std::size_t offset) const
{
    if (offset > bytes_ || count > bytes_ - offset)
        throw RangeError("Buffer \"" + label() + "\": bytes " + std::to_string(offset) + " to " + std::to_string(offset + count) +
                         " are outside its size, " + std::to_string(bytes_) + ".");
}

void Buffer::upload(const void* data, std::size_t count, std::size_t offset)
{
    checkRange(count, offset);
    if (count == 0)
        return;
    const Api& gl = api();
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, name());
    gl->BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(count), data);
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

void Buffer::rewrite(std::size_t count, const std::function<void(void*)>& fill)
{
    checkRange(count, 0);
    if (count == 0)
        return;
    const Api& gl = api();
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, name());
    void* const mapped =
        gl->MapBufferRange(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(count), GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (mapped)
        fill(mapped);
    const bool intact = mapped && gl->UnmapBuffer(GL_COPY_WRITE_BUFFER);
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, 0);
    if (!intact) {
        checkErrors(gl, "writing a buffer", label());
        throw GlError("writing a buffer (" + label() + "): the driver lost its content.");
    }
}

void Buffer::downloadTo(void* to, std::size_t count, std::size_t offset) const
{
    read(count, offset, [&](const void* from) { std::memcpy(to, from, count); });
}

void Buffer::read(std::size_t count, std::size_t offset, const std::function<void(const void*)>& use) const
{
    checkRange(count, offset);
    if (count == 0)
        return;
    const Api& gl = api();
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, name());
    // Mapping instead of glGetBufferSubData, which OpenGL ES lacks.
    const void* mapped =
        gl->MapBufferRange(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(count), GL_MAP_READ_BIT);
    if (mapped)
        use(mapped);
    const bool intact = mapped && gl->UnmapBuffer(GL_COPY_WRITE_BUFFER);
    gl->BindBuffer(GL_COPY_WRITE_BUFFER, 0);
    if (!intact) {
        checkErrors(gl, "reading a buffer back", label());
        throw GlError("reading a buffer back (" + label() + "): the driver lost its content.");
    }
}

void Buffer::bindStorage(GLuint binding) const { api()->BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name()); }
void Buffer::bindUniform(GLuint binding) const { api()->BindBufferBase(GL_UNIFORM_BUFFER, binding, name()); }

} // namespace sky::gl
