#pragma once

#include <array>

#include "gl/api.hpp"

namespace sky::gl {

/// Which way pixels go: from memory to textures (unpack) or back (pack).
enum class PixelTransfer { unpack, pack };

/// Neutral pixel-store state for one transfer: the host's row lengths and alignments are not ours, and are put back. Any
/// pixel buffer of the host is unbound meanwhile, since pointers would be read as offsets into it.
class PixelStoreScope
{
public:
    PixelStoreScope(const Api& api, PixelTransfer transfer);
    ~PixelStoreScope();
    PixelStoreScope(const PixelStoreScope&) = delete;
    PixelStoreScope& operator=(const PixelStoreScope&) = delete;

private:
    struct Parameter {
        GLenum name;
        GLint neutral;
        GLint before;
    };
    Api api_;
    GLenum bufferTarget_;
    GLint bufferBefore_ = 0;
    std::array<Parameter, 8> parameters_{};
    std::size_t count_ = 0;
};

} // namespace sky::gl
