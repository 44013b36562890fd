#include "solver/lit_gather.hpp"
#include "base/lanes.hpp"
#include "base/parallel.hpp"
#include "sky_shaders.hpp"
#include "solver/dispatch.hpp"
#include <cstring>

namespace sky::solver {

namespace {

constexpr float toLog2 = 1.44269504f;
/// Less light than this is darkness, and its logarithm one from which exp2 gives zero.
constexpr float faintest = 1e-36f, dark = -200.f;

/// Two scatterers' X, Y, Z, scotopic: the compiler's vector type. No function with it as an argument is called across files.
#pragma GCC diagnostic ignored "-Wpsabi"
using Eight = float __attribute__((vector_size(32)));
struct alignas(32) Channels {
    Eight v;
};

/// One node for every elevation of the Sun there.
///   near, far   log2 of the transmittance at the table's altitudes on both sides, [elevation][wavelength]
///   weights     [pair of scatterers][wavelength]: weight of the scatterer times luminance
///   lit         [elevation][scatterer][4]
SKY_WIDEST_VECTORS
void sumNode(const float* __restrict near, const float* __restrict far, float fraction, const Channels* __restrict weights, int elevations,
             int wavelengths, int scatterers, float* __restrict light, float* __restrict lit)
{
    for (int e = 0; e < elevations; ++e, near += wavelengths, far += wavelengths, lit += scatterers * 4) {
        for (int w = 0; w < wavelengths; ++w)
            light[w] = base::exp2Lane(near[w] + fraction * (far[w] - near[w]));
        for (int i = 0; i < scatterers; i += 2) {
            const Channels* __restrict pair = weights + i / 2 * wavelengths;
            Eight sums[4]{}; // one would wait for itself; wavelengths are padded to a multiple of four
            for (int w = 0; w < wavelengths; w += 4)
                for (int k = 0; k < 4; ++k)
                    sums[k] += pair[w + k].v * light[w + k];
            const Channels sum{(sums[0] + sums[1]) + (sums[2] + sums[3])};
            std::memcpy(lit + i * 4, &sum, (i + 1 < scatterers ? 8 : 4) * sizeof(float));
        }
    }
}

/// X, Y, Z, scotopic to X / Y, log2 Y, Z / Y, scotopic / Y: one exponential brings all back. Where Y is none, so are the others.
SKY_WIDEST_VECTORS
void levelAndColour(const float* __restrict values, int count, float* __restrict result)
{
    for (int k = 0; k < count; ++k, values += 4, result += 4) {
        const bool lit = values[1] > faintest;
        const float y = lit ? values[1] : 1.F, inverse = 1 / y, logarithm = base::log2Lane(y);
        result[0] = values[0] * inverse;
        result[1] = lit ? logarithm : dark;
        result[2] = values[2] * inverse;
        result[3] = values[3] * inverse;
    }
}

} // namespace

LitGather::LitGather(const gl::Api& api, const Scene& scene, const std::vector<std::array<double, 4>>& luminance)
    : api_(api), scene_(scene),
      program_(gl::ProgramBuilder(api, shaders::source)
                   .compute("lit rays", "solve/lit.comp", {{"SCATTERERS", std::to_string(scene.scatterers())}, {"SETS", "1"}})),
      phases_(api, "phase functions", phaseTexels(scene, false)), luminance_(luminanceTexels(scene, luminance))
{
    for (const float depth : sunDepthTexels(scene))
        logTransmittance_.push_back(-toLog2 * depth);
}

/// lit  [ray of this dispatch][node][elevation][scatterer][4], by levelAndColour, without visible part of the disc and phase
void LitGather::sumWavelengths(const DirectRayData& rays, int first, int count, float* lit) const
{
    const int elevations = scene_.sun.elevationCount(), wavelengths = scene_.sets() * 4, scatterers = scene_.scatterers();
    base::parallel([&](int thread, int threads) {
        base::VectorsOf<Channels> channels(std::size_t(scatterers + 1) / 2 * wavelengths, Channels{});
        base::VectorsOf<float> light(wavelengths), sums(std::size_t(elevations) * scatterers * 4);
        for (int item = thread; item < count * rays.nodes; item += threads) {
            const int ray = first + item / rays.nodes, node = item % rays.nodes;
            const float* weights = &rays.weights[(std::size_t(ray) * rays.nodes + node) * scatterers * wavelengths];
            for (int i = 0; i < scatterers; ++i)
                for (int w = 0; w < wavelengths; ++w)
                    for (int c = 0; c < 4; ++c)
                        channels[i / 2 * wavelengths + w].v[i % 2 * 4 + c] = weights[i * wavelengths + w] * luminance_[w][c];
            const float* place = &rays.rayNodes[(std::size_t(ray) * (rays.nodes + 1) + node) * 8 + 4];
            const float* near = &logTransmittance_[std::size_t(place[0]) * elevations * wavelengths];
            sumNode(near, near + std::size_t(elevations) * wavelengths, place[1], channels.data(), elevations, wavelengths, scatterers,
                    light.data(), sums.data());
            levelAndColour(sums.data(), elevations * scatterers, lit + std::size_t(item) * sums.size());
        }
    });
}

void LitGather::gather(const DirectRayData& rays, const SunSamples& samples, Strides strides, const std::vector<bool>& withPhase,
                       gl::Buffer& results, const Breath& breath)
{
    const int elevations = scene_.sun.elevationCount();
    const std::size_t perRay = std::size_t(rays.nodes) * elevations * scene_.scatterers();
    const int chunk = raysTogether(api_, samples, rays.count, rays.nodes, perRay);
    if (!lit_ || litTexels_ < chunk * perRay) {
        lit_.reset();
        lit_.emplace(api_, "lit nodes", chunk * perRay);
        litTexels_ = chunk * perRay;
    }
    const TexelBuffer rayNodes(api_, "direct ray nodes", rays.rayNodes);
    bindSamples(program_, samples, strides, rays.nodes);
    bind(program_, "rayNodes", 2, rayNodes);
    bind(program_, "lit", 3, *lit_);
    bind(program_, "phases", 4, phases_);
    program_.set("totalSets", scene_.sets());
    bindScatterers(program_, scene_, withPhase, rays.count * samples.suns * samples.azimuths);
    results.bindStorage(0);
    const gl::Bound pass(program_);
    for (int first = 0; first < rays.count; first += chunk) {
        breath();
        const int count = std::min(chunk, rays.count - first);
        lit_->buffer.rewrite(count * perRay * 16, [&](void* to) { sumWavelengths(rays, first, count, static_cast<float*>(to)); });
        program_.set("firstRay", first);
        program_.dispatchOver(static_cast<unsigned>(samples.suns * samples.azimuths), static_cast<unsigned>(count));
        gl::memoryBarrier(api_);
        api_->Flush();
    }
    gl::checkErrors(api_, "lit gather");
}

} // namespace sky::solver
