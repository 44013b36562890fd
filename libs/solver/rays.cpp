#include "solver/rays.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace sky::solver {

namespace {

using base::pi;

/// A buffer must not be empty: OpenGL has no views of nothing.
std::vector<float> orOneTexel(std::vector<float> values)
{
    if (values.empty())
        values.assign(4, 0.F);
    return values;
}

std::vector<float> groundTexels(const Scene& scene, const std::vector<physics::RayNodes>& rays)
{
    std::vector<float> values(rays.size() * scene.sets() * 4, 0.F);
    for (std::size_t r = 0; r < rays.size(); ++r)
        for (int w = 0; w < scene.optics.wavelengths; ++w)
            values[r * scene.sets() * 4 + w] = static_cast<float>(rays[r].groundTransmittance[w] * scene.medium.groundAlbedo[w] / pi);
    return values;
}

} // namespace

TexelBuffer::TexelBuffer(const gl::Api& api, const std::string& label, const std::vector<float>& values, int components)
    : buffer(api, label, orOneTexel(values)), texture(api, label, buffer, components)
{
}

TexelBuffer::TexelBuffer(const gl::Api& api, const std::string& label, std::size_t vec4s)
    : buffer(api, label, vec4s * 4 * sizeof(float)), texture(api, label, buffer)
{
}

std::vector<physics::RayNodes> traceRays(const Scene& scene, const std::vector<RayStart>& starts, int nodes, physics::NodesFor nodesFor)
{
    std::vector<physics::RayNodes> rays(starts.size());
    base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(scene.profile, scene.optics);
        for (std::size_t i = thread; i < starts.size(); i += threads) {
            base::stopIfAsked(scene.stop);
            rays[i] = tracer.trace(starts[i].altitude, starts[i].mu, nodes, starts[i].hitsGround, nodesFor);
        }
    });
    return rays;
}

DirectRayData::DirectRayData(const Scene& scene, const std::vector<RayStart>& starts, int nodeCount, bool field)
    : count(static_cast<int>(starts.size())), nodes(nodeCount)
{
    const auto rays = traceRays(scene, starts, nodeCount, physics::NodesFor::Sunlight);
    const int sets = scene.sets(), scatterers = scene.scatterers(), wavelengths = scene.optics.wavelengths;
    rayNodes.resize(rays.size() * (nodeCount + 1) * 8);
    weights.resize(rays.size() * nodeCount * scatterers * sets * 4);
    const auto pack = [&](std::size_t r) {
        const auto& ray = rays[r];
        for (int k = 0; k <= nodeCount; ++k) {
            const auto& node = k < nodeCount ? ray.nodes[k] : ray.ground;
            const double h = k < nodeCount ? node.altitude : 0;
            float* to = &rayNodes[(r * (nodeCount + 1) + k) * 8];
            const double horizon = scene.sun.horizon(h);
            const auto [row, fraction] = k < nodeCount ? scene.sun.row(h) : scene.sun.groundRow();
            const double range = std::asinh((pi / 2 - horizon + scene.medium.sunAngularRadius) / scene.sun.elevationScale());
            const double values[8]{node.sunScale, node.nuScale, horizon, 1 / range,
                                   double(row),   fraction,     node.mu, ray.hitsGround ? 1. : 0.};
            std::copy(std::begin(values), std::end(values), to);
        }
        for (int k = 0; k < nodeCount; ++k)
            for (int i = 0; i < scatterers; ++i)
                for (int w = 0; w < wavelengths; ++w)
                    weights[((r * nodeCount + k) * scatterers + i) * sets * 4 + w] =
                        static_cast<float>(ray.weights[(k * scatterers + i) * wavelengths + w] /
                                           (field ? 1 : 1 - scene.optics.truncation[scene.optics.scatterers[i] * wavelengths + w]));
    };
    base::parallel([&](int thread, int threads) {
        for (std::size_t r = thread; r < rays.size(); r += threads)
            pack(r);
    });
    ground = groundTexels(scene, rays);
}

DirectRays::DirectRays(const gl::Api& api, const DirectRayData& data)
    : count(data.count), nodes(data.nodes), rayNodes(api, "direct ray nodes", data.rayNodes), weights(api, "direct weights", data.weights),
      ground(api, "direct ground", data.ground)
{
}

namespace {

/// Angle of the Sun over which scattered light bends by as much as itself, at its worst in twilight: part of the angles that the grid of
/// the moments resolves about the horizon, which go with the planet's dip. On Earth 0.9 degrees.
double bendOf(const physics::MomentGrid& grid) { return 0.165 * pi / 2 / std::sinh(grid.sunScale()); }

std::vector<Stations> stationsOf(const Scene& scene, const physics::MomentGrid& grid, const std::vector<physics::RayNodes>& rays,
                                 const ScatteredRaySettings& settings)
{
    std::vector<Stations> result;
    for (const auto& ray : rays)
        result.emplace_back(ray, scene.medium.groundAlbedo, settings.fromGround, bendOf(grid), settings.stationTolerance);
    return result;
}

std::vector<int> firstStations(const std::vector<Stations>& stations)
{
    std::vector<int> first{0};
    for (const auto& s : stations)
        first.push_back(first.back() + static_cast<int>(s.places.size()));
    return first;
}

std::vector<float> rayTexels(const std::vector<physics::RayNodes>& rays, const std::vector<int>& firstStation)
{
    std::vector<float> values;
    for (std::size_t r = 0; r < rays.size(); ++r)
        values.insert(values.end(), {static_cast<float>(firstStation[r]), static_cast<float>(firstStation[r + 1] - firstStation[r]),
                                     static_cast<float>(rays[r].nodes.front().mu), 0.F});
    return values;
}

std::vector<float> stationTexels(const std::vector<Stations>& stations)
{
    std::vector<float> values;
    for (const auto& s : stations)
        for (const auto& place : s.places)
            values.insert(values.end(),
                          {static_cast<float>(place.sunScale), static_cast<float>(place.nuScale), static_cast<float>(place.mu), 0.F});
    return values;
}

} // namespace

ScatteredRays::ScatteredRays(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const std::vector<RayStart>& starts,
                             const ScatteredRaySettings& settings)
    : ScatteredRays(api, scene, grid, traceRays(scene, starts, settings.nodes, physics::NodesFor::Field), settings)
{
}

ScatteredRays::ScatteredRays(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid,
                             const std::vector<physics::RayNodes>& traced, const ScatteredRaySettings& settings)
    : ScatteredRays(api, scene, grid, traced, stationsOf(scene, grid, traced, settings), settings.nodes)
{
}

ScatteredRays::ScatteredRays(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid,
                             const std::vector<physics::RayNodes>& traced, const std::vector<Stations>& chosen, int nodeCount)
    : count(static_cast<int>(traced.size())), nodes(nodeCount), degree(scene.optics.degree), bentDegree(physics::bentDegree(scene.optics)),
      firstStation(firstStations(chosen)), rays(api, "scattered rays", rayTexels(traced, firstStation)),
      stations(api, "stations", stationTexels(chosen)), folds(traced.size() * nodeCount), ground(groundTexels(scene, traced))
{
    const auto& optics = scene.optics;
    const int stride = scene.sets() * 4, scatterers = scene.scatterers(), wavelengths = optics.wavelengths;
    const int terms = degree + 1, harmonics = physics::harmonicCount(degree);
    for (const auto& s : chosen)
        shares.insert(shares.end(), s.shares.begin(), s.shares.end());
    coefficients.resize(traced.size() * nodeCount * terms * stride);
    factors.resize(traced.size() * nodeCount * harmonics);
    base::parallel([&](int thread, int threads) {
        std::vector<double> zenithal(harmonics);
        for (std::size_t r = thread; r < traced.size(); r += threads)
            for (int k = 0; k < nodeCount; ++k) {
                const std::size_t at = r * nodeCount + k;
                const auto& ray = traced[r];
                const auto stencil = grid.altitudeStencil(ray.nodes[k].altitude);
                for (int i = 0; i < 4; ++i) {
                    folds[at].level[i] = stencil.index[i];
                    folds[at].weight[i] = static_cast<float>(stencil.weight[i]);
                }
                folds[at].between = static_cast<float>(stencil.between);
                physics::harmonicFactors(degree, ray.nodes[k].mu, zenithal.data());
                for (int lm = 0; lm < harmonics; ++lm)
                    factors[at * harmonics + lm] = static_cast<float>(zenithal[lm]);
                for (int i = 0; i < scatterers; ++i)
                    for (int l = 0; l < terms; ++l)
                        for (int w = 0; w < wavelengths; ++w)
                            coefficients[(at * terms + l) * stride + w] += static_cast<float>(
                                ray.weights[(k * scatterers + i) * wavelengths + w] * optics.moment(optics.scatterers[i], l, w));
            }
    });
}

} // namespace sky::solver
