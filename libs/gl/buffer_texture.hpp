#pragma once

#include "gl/buffer.hpp"

namespace sky::gl {

/// Read-only view of a float buffer as texels: `samplerBuffer` in GLSL, `texelFetch(sampler, index)`.
/// On software drivers by far the cheapest way for scattered reads (docs/method, "what a load costs").
class BufferTexture : public Object
{
public:
    /// \param components 1 or 4 floats a texel
    /// throws GlError where the buffer has more than maxTexels
    BufferTexture(const Api& api, std::string label, const Buffer& buffer, int components = 4);
    /// Binds to texture unit `unit`, counted from 0, and leaves that unit active.
    void bindUnit(GLuint unit) const;
    /// Most texels that the driver lets such a view have.
    static std::size_t maxTexels(const Api& api);
};

} // namespace sky::gl
