#pragma once
// What the gathers' dispatches have in common.

#include "gl/program.hpp"
#include "solver/gather.hpp"
#include <algorithm>
#include <array>
#include <string>

namespace sky::solver {

/// Work of one dispatch, in node visits: some tens of milliseconds on two cores, far below any watchdog on a GPU.
constexpr std::size_t visitsPerDispatch = 1 << 21;
/// What is prepared for the rays of one dispatch.
constexpr std::size_t sourceBytes = std::size_t(4) << 20;

inline void bind(gl::Program& program, const char* name, int unit, const TexelBuffer& texels)
{
    program.set(name, unit);
    texels.texture.bindUnit(static_cast<GLuint>(unit));
}

/// Uniforms of shaders/solve/rays.glsl.
inline void bindSamples(gl::Program& program, const SunSamples& samples, Strides strides, int nodes)
{
    bind(program, "sunCosines", 0, samples.sunCosines);
    bind(program, "azimuthCosines", 1, samples.azimuthCosines);
    program.set("suns", samples.suns);
    program.set("azimuths", samples.azimuths);
    program.set("nodes", nodes);
    program.set("strides", std::array<int, 3>{strides.ray, strides.sun, strides.azimuth});
}

/// Uniforms that direct.comp and lit.comp share. Each scatterer's results are a block of `texels`.
inline void bindScatterers(gl::Program& program, const Scene& scene, const std::vector<bool>& withPhase, int texels)
{
    program.set("elevations", scene.sun.elevationCount());
    program.set("elevationScale", static_cast<float>(scene.sun.elevationScale()));
    program.set("sunRadius", static_cast<float>(scene.medium.sunAngularRadius));
    program.set("angles", static_cast<int>(scene.medium.scatteringAngles.size()));
    for (std::size_t i = 0; i < withPhase.size(); ++i) {
        program.set("withPhase[" + std::to_string(i) + "]", withPhase[i] ? 1 : 0);
        program.set("resultOffsets[" + std::to_string(i) + "]", static_cast<int>(i) * texels);
    }
}

/// Splits rays among dispatches: act(first ray, how many).
template<class Action>
void forChunksOf(int rays, std::size_t visitsPerRay, Action&& act)
{
    const int chunk = static_cast<int>(std::clamp<std::size_t>(visitsPerDispatch / visitsPerRay, 1, 4096));
    for (int first = 0; first < rays; first += chunk)
        act(first, std::min(chunk, rays - first));
}

/// Rays of one dispatch, for which `vec4sPerRay` are prepared each.
inline int raysTogether(const gl::Api& api, const SunSamples& samples, int rays, int nodes, std::size_t vec4sPerRay)
{
    const std::size_t visits = std::size_t(samples.suns) * samples.azimuths * nodes;
    const std::size_t fitting = std::min(sourceBytes / 16, gl::BufferTexture::maxTexels(api)) / vec4sPerRay;
    return static_cast<int>(std::min<std::size_t>(std::max<std::size_t>(1, std::min(fitting, visitsPerDispatch / visits)), rays));
}

/// Likewise stations, of one ray at least.
inline std::size_t stationsTogether(const gl::Api& api, const SunSamples& samples, const ScatteredRays& rays, std::size_t vec4sPerStation)
{
    const std::size_t fitting = std::min(sourceBytes / 16, gl::BufferTexture::maxTexels(api)) / vec4sPerStation;
    const std::size_t visits = visitsPerDispatch / (std::size_t(samples.suns) * samples.azimuths);
    return std::min<std::size_t>(std::max<std::size_t>(rays.nodes + 1, std::min(fitting, visits)), rays.firstStation.back());
}

} // namespace sky::solver
