#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gl/object.hpp"

namespace sky::gl {

/// Memory of the GPU: a storage buffer (SSBO), a uniform block (UBO), vertices.
class Buffer : public Object
{
public:
    /// throws GlError where the driver has no memory left, RangeError where bytes is zero
    Buffer(const Api& api, std::string label, std::size_t bytes, const void* data = nullptr);
    template<class T>
    Buffer(const Api& api, std::string label, std::span<const T> values) : Buffer(api, std::move(label), values.size_bytes(), values.data())
    {
    }
    template<class T>
    Buffer(const Api& api, std::string label, const std::vector<T>& values) : Buffer(api, std::move(label), std::span<const T>(values))
    {
    }

    std::size_t bytes() const { return bytes_; }

    /// Replaces `count` bytes from `offset` on; the rest stays.
    void upload(const void* data, std::size_t count, std::size_t offset = 0);
    template<class T>
    void upload(const std::vector<T>& values, std::size_t offset = 0)
    {
        upload(values.data(), values.size() * sizeof(T), offset);
    }

    /// Throws the content away and lets `fill` write the first `count` bytes in place: no copy where the driver shares memory.
    void rewrite(std::size_t count, const std::function<void(void*)>& fill);
    /// Waits for the GPU and shows `use` its `count` bytes from `offset` on: no copy where the driver shares memory.
    void read(std::size_t count, std::size_t offset, const std::function<void(const void*)>& use) const;
    /// Waits for the GPU and copies `count` bytes from `offset` on to `to`.
    void downloadTo(void* to, std::size_t count, std::size_t offset = 0) const;
    /// Waits for the GPU and returns the whole content.
    std::vector<float> download() const { return downloadAs<float>(); }
    template<class T>
    std::vector<T> downloadAs() const
    {
        std::vector<T> values(bytes_ / sizeof(T));
        downloadTo(values.data(), values.size() * sizeof(T));
        return values;
    }

    void bindStorage(GLuint binding) const; ///< needs GL 4.3
    void bindUniform(GLuint binding) const;

private:
    void checkRange(std::size_t count, std::size_t offset) const;
    std::size_t bytes_;
};

} // namespace sky::gl
