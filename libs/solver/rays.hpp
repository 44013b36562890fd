#pragma once
// Rays as the gather shaders read them. Geometry, density and transmittance are integrated here, in double (physics/ray.hpp);
// the GPU meets nodes and weights only, so nothing of planet scale is ever computed in float32.

#include "base/stop.hpp"
#include "gl/buffer_texture.hpp"
#include "physics/moments.hpp"
#include "physics/ray.hpp"
#include "physics/sun.hpp"
#include "solver/stations.hpp"
#include <vector>

namespace sky::solver {

/// Where a ray starts and how it counts.
struct RayStart {
    double altitude; ///< m
    double mu;
    bool hitsGround;
};

/// A storage buffer and its view as texels.
struct TexelBuffer {
    gl::Buffer buffer;
    gl::BufferTexture texture;
    TexelBuffer(const gl::Api& api, const std::string& label, const std::vector<float>& values, int components = 4);
    TexelBuffer(const gl::Api& api, const std::string& label, std::size_t vec4s);
};

/// Everything rays are traced through; wavelengths in sets of four, the last padded.
struct Scene {
    const physics::Medium& medium;
    const physics::Profile& profile;
    const physics::Optics& optics;
    const physics::SunTable& sun;
    base::StopRequest stop{}; ///< asked for every ray that is traced
    int sets() const { return (optics.wavelengths + 3) / 4; }
    int scatterers() const { return static_cast<int>(optics.scatterers.size()); }
};

/// Traces rays on all cores.
std::vector<physics::RayNodes> traceRays(const Scene& scene, const std::vector<RayStart>& starts, int nodes, physics::NodesFor nodesFor);

/// Rays for the light of the first event, in main memory.
struct DirectRayData {
    int count, nodes;
    std::vector<float>
        rayNodes; ///< [ray][node + ground][8]: sunScale, nuScale, horizon, inverse range; row, fraction, mu, hits ground (rays.glsl)
    std::vector<float> weights; ///< [ray][node][scatterer][padded wavelength]
    std::vector<float> ground;  ///< [ray][padded wavelength]: transmittance times albedo / pi
    /// \param field weights go with truncated phase functions (source iteration); otherwise with the exact ones, on which
    ///              optical depths stay scaled: the TMS correction (Nakajima & Tanaka 1988, J. Quant. Spectrosc. 40, 51)
    DirectRayData(const Scene& scene, const std::vector<RayStart>& starts, int nodes, bool field);
};

/// The same as solve/direct.comp reads them.
struct DirectRays {
    int count, nodes;
    TexelBuffer rayNodes, weights, ground;
    DirectRays(const gl::Api& api, const DirectRayData& data);
};

/// How light of later events is summed along rays.
struct ScatteredRaySettings {
    int nodes;
    double stationTolerance; ///< relative error that the gap between two stations may cost
    bool fromGround;         ///< whether light that the ground reflects into a ray counts
};

/// Rays for the light of later events: stations for scattered.comp, the rest for fold().
struct ScatteredRays {
    struct FoldNode {
        int level[4]; ///< altitude stencil in the grid of moments
        float weight[4];
        float between; ///< place between the two in the middle
    };
    int count, nodes, degree, bentDegree;
    std::vector<int> firstStation;       ///< [ray + 1]
    std::vector<Stations::Share> shares; ///< [ray][node + ground]
    TexelBuffer rays;                    ///< [ray]: first station, their number, mu at the start
    TexelBuffer stations;                ///< [station]: sunScale, nuScale, mu
    std::vector<FoldNode> folds;         ///< [ray][node]
    std::vector<float> coefficients;     ///< [ray][node][l][padded wavelength]: sum over scatterers of weight lambda_l
    std::vector<float> factors;          ///< [ray][node][lm]: zenith-angle factor of the harmonic
    std::vector<float> ground;           ///< [ray][padded wavelength]: transmittance times albedo / pi
    ScatteredRays(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const std::vector<RayStart>& starts,
                  const ScatteredRaySettings& settings);

private:
    ScatteredRays(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const std::vector<physics::RayNodes>& traced,
                  const ScatteredRaySettings& settings);
    ScatteredRays(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const std::vector<physics::RayNodes>& traced,
                  const std::vector<Stations>& chosen, int nodes);
};

} // namespace sky::solver
