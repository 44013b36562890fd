#include "solver/gather.hpp"
#include "base/angles.hpp"
#include "sky_shaders.hpp"
#include "solver/dispatch.hpp"
#include <algorithm>
#include <cmath>

namespace sky::solver {

std::vector<std::array<float, 4>> luminanceTexels(const Scene& scene, const std::vector<std::array<double, 4>>& luminance)
{
    std::vector<std::array<float, 4>> values(luminance.empty() ? 0 : scene.sets() * 4);
    for (std::size_t w = 0; w < luminance.size(); ++w)
        for (std::size_t c = 0; c < 4; ++c)
            values[w][c] = static_cast<float>(luminance[w][c]);
    return values;
}

std::vector<float> sunDepthTexels(const Scene& scene)
{
    const int sets = scene.sets(), wavelengths = scene.optics.wavelengths;
    const auto& depths = scene.sun.opticalDepths();
    std::vector<float> values(depths.size() / wavelengths * sets * 4, 0.F);
    for (std::size_t i = 0; i < depths.size() / wavelengths; ++i)
        for (int w = 0; w < wavelengths; ++w)
            values[i * sets * 4 + w] = static_cast<float>(depths[i * wavelengths + w]);
    return values;
}

std::vector<float> phaseTexels(const Scene& scene, bool field)
{
    using base::pi;
    const int sets = scene.sets(), wavelengths = scene.optics.wavelengths, degree = scene.optics.degree;
    const std::size_t rows = field ? degree + 1 : scene.medium.scatteringAngles.size();
    std::vector<float> values(scene.scatterers() * rows * sets * 4, 0.F);
    for (int i = 0; i < scene.scatterers(); ++i) {
        const int s = scene.optics.scatterers[i];
        for (std::size_t row = 0; row < rows; ++row)
            for (int w = 0; w < wavelengths; ++w)
                values[(i * rows + row) * sets * 4 + w] =
                    static_cast<float>(field ? (2. * double(row) + 1) / (4 * pi) * scene.optics.moment(s, static_cast<int>(row), w)
                                             : scene.medium.species[s].phaseFunction[row * wavelengths + w]);
    }
    return values;
}

namespace {

/// Sets of wavelengths that one dispatch carries along: more would spill registers and compile for ever.
constexpr int mostSets = 4;
int setsTogether(const Scene& scene) { return std::min(mostSets, scene.sets()); }

std::vector<gl::Define> definesOf(const Scene& scene, const std::vector<std::array<double, 4>>& luminance)
{
    std::vector<gl::Define> defines{{"SETS", std::to_string(setsTogether(scene))},
                                    {"DEGREE", std::to_string(scene.optics.degree)},
                                    {"SCATTERERS", std::to_string(scene.scatterers())}};
    if (!luminance.empty())
        defines.push_back({"LUMINANCE", "1"});
    return defines;
}

/// Chooses the sets of a dispatch of the direct gather.
void setSets(gl::Program& program, const Scene& scene, int first, const std::vector<std::array<double, 4>>& luminance)
{
    program.set("firstSet", first);
    program.set("totalSets", scene.sets());
    if (luminance.empty())
        return;
    std::vector<std::array<float, 4>> values(setsTogether(scene) * 4);
    for (std::size_t w = 0; w < values.size() && first * 4 + w < luminance.size(); ++w)
        for (int c = 0; c < 4; ++c)
            values[w][c] = static_cast<float>(luminance[first * 4 + w][c]);
    program.setVec4s("luminance", values);
}

std::vector<gl::Define> directDefines(const Scene& scene, DirectGather::Purpose purpose,
                                      const std::vector<std::array<double, 4>>& luminance)
{
    auto defines = definesOf(scene, luminance);
    if (purpose != DirectGather::Purpose::table)
        defines.push_back({"FIELD", "1"});
    if (purpose == DirectGather::Purpose::groundField)
        defines.push_back({"GROUND_ONLY", "1"});
    if (purpose == DirectGather::Purpose::fieldLight)
        defines.push_back({"LIGHT_APART", "1"});
    return defines;
}

/// [azimuth][azimuth of the light]: from values at few midpoints of 0..pi to many, by the series of cosines through them.
std::vector<float> azimuthWeights(int from, int to)
{
    using base::pi;
    std::vector<float> weights;
    for (int k = 0; k < to; ++k)
        for (int j = 0; j < from; ++j) {
            double sum = 1;
            for (int m = 1; m < from; ++m)
                sum += 2 * std::cos(m * pi * (k + 0.5) / to) * std::cos(m * pi * (j + 0.5) / from);
            weights.push_back(static_cast<float>(sum / from));
        }
    return weights;
}

} // namespace

SunSamples::SunSamples(const gl::Api& api, const std::vector<float>& sunValues, const std::vector<float>& azimuthValues)
    : suns(static_cast<int>(sunValues.size())), azimuths(static_cast<int>(azimuthValues.size())),
      sunCosines(api, "Sun cosines", sunValues, 1), azimuthCosines(api, "azimuth cosines", azimuthValues, 1)
{
}

DirectGather::DirectGather(const gl::Api& api, const Scene& scene, Purpose purpose, const std::vector<std::array<double, 4>>& luminance)
    : api_(api), scene_(scene),
      program_(
          gl::ProgramBuilder(api, shaders::source).compute("direct gather", "solve/direct.comp", directDefines(scene, purpose, luminance))),
      luminance_(luminance), sunDepths_(api, "sunlight optical depths", sunDepthTexels(scene)),
      phases_(api, "phase functions", phaseTexels(scene, purpose != Purpose::table))
{
}

void DirectGather::gather(const DirectRays& rays, const SunSamples& samples, Strides strides, const std::vector<bool>& withPhase,
                          gl::Buffer& results, const Breath& breath)
{
    bindSamples(program_, samples, strides, rays.nodes);
    bind(program_, "rayNodes", 2, rays.rayNodes);
    bind(program_, "sunDepths", 3, sunDepths_);
    bind(program_, "weights", 4, rays.weights);
    bind(program_, "ground", 5, rays.ground);
    bind(program_, "phases", 6, phases_);
    bindScatterers(program_, scene_, withPhase, rays.count * samples.suns * samples.azimuths);
    results.bindStorage(0);
    const gl::Bound pass(program_);
    forChunksOf(rays.count, std::size_t(samples.suns) * samples.azimuths * rays.nodes, [&](int first, int count) {
        breath();
        program_.set("firstRay", first);
        for (int set = 0; set < scene_.sets(); set += setsTogether(scene_)) {
            setSets(program_, scene_, set, luminance_);
            program_.dispatchOver(static_cast<unsigned>(samples.suns * samples.azimuths), static_cast<unsigned>(count));
            gl::memoryBarrier(api_);
        }
        api_->Flush();
    });
    gl::memoryBarrier(api_);
    gl::checkErrors(api_, "direct gather");
}

PhaseGather::PhaseGather(const gl::Api& api, const Scene& scene, const int lightAzimuths, const int azimuths)
    : api_(api), scene_(scene), lightAzimuths_(lightAzimuths),
      program_(gl::ProgramBuilder(api, shaders::source).compute("phase gather", "solve/phase.comp", definesOf(scene, {}))),
      phases_(api, "phase functions", phaseTexels(scene, true)),
      azimuthWeights_(api, "azimuth weights", azimuthWeights(lightAzimuths, azimuths), 1)
{
}

void PhaseGather::gather(const DirectRays& rays, const SunSamples& samples, Strides strides, const gl::Buffer& light, gl::Buffer& results,
                         const Breath& breath)
{
    bindSamples(program_, samples, strides, rays.nodes);
    bind(program_, "rayNodes", 2, rays.rayNodes);
    bind(program_, "phases", 3, phases_);
    bind(program_, "azimuthWeights", 4, azimuthWeights_);
    program_.set("lightAzimuths", lightAzimuths_);
    program_.set("rays", rays.count);
    results.bindStorage(0);
    light.bindStorage(1);
    const gl::Bound pass(program_);
    forChunksOf(rays.count, std::size_t(samples.suns) * samples.azimuths * lightAzimuths_, [&](int first, int count) {
        breath();
        program_.set("firstRay", first);
        for (int set = 0; set < scene_.sets(); set += setsTogether(scene_)) {
            setSets(program_, scene_, set, {});
            program_.dispatchOver(static_cast<unsigned>(samples.suns * samples.azimuths), static_cast<unsigned>(count));
            gl::memoryBarrier(api_);
        }
        api_->Flush();
    });
    gl::memoryBarrier(api_);
    gl::checkErrors(api_, "phase gather");
}

ScatteredGather::ScatteredGather(const gl::Api& api, const Scene& scene, const std::vector<std::array<double, 4>>& luminance)
    : api_(api), scene_(scene), sets_(luminance.empty() ? scene.sets() : 1), setsTogether_(std::min(mostSets, sets_)),
      program_(gl::ProgramBuilder(api, shaders::source)
                   .compute("scattered gather", "solve/scattered.comp", {{"SETS", std::to_string(setsTogether_)}})),
      luminance_(luminanceTexels(scene, luminance))
{
}

void ScatteredGather::gather(const ScatteredRays& rays, const FoldField& field, const int azimuthal, const SunSamples& samples,
                             Strides strides, gl::Buffer& results, const Breath& breath)
{
    bindSamples(program_, samples, strides, rays.nodes);
    bind(program_, "rayNodes", 2, rays.stations);
    bind(program_, "rays", 4, rays.rays);
    program_.set("fieldSuns", field.fineSunCount());
    program_.set("terms", azimuthal + 1);
    program_.set("sunAxisOfField", field.sunAxis);

    const std::size_t perStation = std::size_t(field.fineSunCount()) * (azimuthal + 2) * sets_;
    const std::size_t most = stationsTogether(api_, samples, rays, perStation);
    if (!source_ || sourceTexels_ < most * perStation) {
        source_.reset();
        source_.emplace(api_, "ray sources", most * perStation);
        sourceTexels_ = most * perStation;
    }
    bind(program_, "source", 3, *source_);
    results.bindStorage(0);
    const gl::Bound pass(program_);
    const auto& starts = rays.firstStation;
    for (int first = 0, count = 0; first < rays.count; first += count) {
        breath();
        const auto beyond = std::upper_bound(starts.begin() + first + 1, starts.end(), starts[first] + static_cast<int>(most));
        count = static_cast<int>(beyond - starts.begin()) - 1 - first;
        source_->buffer.rewrite(std::size_t(starts[first + count] - starts[first]) * perStation * 16,
                                [&](void* to) { fold(field, rays, first, count, azimuthal, luminance_, static_cast<float*>(to)); });
        program_.set("firstRay", first);
        program_.set("firstStation", starts[first]);
        program_.set("totalSets", sets_);
        for (int set = 0; set < sets_; set += setsTogether_) {
            program_.set("firstSet", set);
            program_.dispatchOver(static_cast<unsigned>(samples.suns * samples.azimuths), static_cast<unsigned>(count));
            gl::memoryBarrier(api_);
        }
        api_->Flush();
    }
    gl::memoryBarrier(api_);
    gl::checkErrors(api_, "scattered gather");
}

} // namespace sky::solver
