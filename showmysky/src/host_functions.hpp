#pragma once
// What hosts get for shaders of their own: the text of shaders/render/host_functions.glsl, its textures and its uniforms.

#include "aerial.hpp"
#include "illuminance.hpp"
#include "painter.hpp"

namespace showmysky {

class HostFunctions
{
public:
    HostFunctions(const sky::gl::Api& api, int scatterers, sky::gl::TextureFormat format);

    /// The functions, without #version.
    static std::string source(int scatterers);

    /// True if a host's program asks for light or transmittance up to a point: without, none is computed.
    ///   throws  Error: it isn't a linked program
    bool asksForDistances(unsigned program) const;
    /// What stays the same until the scene changes.
    ///   aerial  null as long as no program asks for distances
    void set(const Aerial* aerial, const sky::physics::Planet& planet, double altitude, const Illuminance& light);
    /// Binds three textures, five where there are cities, from unit `firstUnit` on, and sets uniforms of a host's program.
    ///   throws  Error: there are too few units
    void bind(unsigned program, unsigned firstUnit, const Painter& painter) const;

    std::size_t textureBytes() const;

private:
    sky::gl::Api api_;
    sky::gl::Texture3D aerial_;
    Uniforms uniforms_;
};

} // namespace showmysky
