#include "solver/field.hpp"
#include "base/lanes.hpp"
#include "base/parallel.hpp"
#include "physics/field_fold.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace sky::solver {

namespace {

constexpr double toLog2 = 1.44269504088896340736;
/// What a thread folds at a time: half of a common second cache.
constexpr std::size_t cachedFloats = std::size_t(1) << 18;

/// X, Y, Z, scotopic: the compiler's vector type.
using Four = float __attribute__((vector_size(16)));

/// One node under one Sun as luminance: `source` is its [1 + term][stride], `target` its [1 + term][4].
///   means, weights  scratch, [wavelength]
[[gnu::always_inline]] inline void toLuminance(const float* __restrict source, const Four* __restrict luminance, int rows, int stride,
                                               float* __restrict means, Four* __restrict weights, float* __restrict target)
{
    for (int w = 0; w < stride; ++w)
        means[w] = base::exp2Lane(source[w]);
    Four level{};
    for (int w = 0; w < stride; ++w) {
        weights[w] = means[w] * luminance[w];
        level += weights[w];
    }
    Four inverse{};
    for (int c = 0; c < 4; ++c) {
        const float sum = std::max(level[c], std::numeric_limits<float>::min());
        target[c] = base::log2Lane(sum);
        inverse[c] = 1 / sum;
    }
    for (int m = 1; m < rows; ++m) {
        const float* __restrict term = source + m * stride;
        Four sums[4]{}; // one would wait for itself; stride is a multiple of four
        for (int w = 0; w < stride; w += 4)
            for (int k = 0; k < 4; ++k)
                sums[k] += weights[w + k] * term[w + k];
        const Four sum = ((sums[0] + sums[1]) + (sums[2] + sums[3])) * inverse;
        for (int c = 0; c < 4; ++c)
            target[m * 4 + c] = sum[c];
    }
}

/// A node of a ray, waiting to be folded.
struct Pending {
    const ScatteredRays::FoldNode* place;
    const float* coefficients; ///< [lm][stride]
    float* target;             ///< [sun][1 + term][channel]
};

/// How deep and into what nodes are folded.
struct FoldSettings {
    int degree, bentDegree, azimuthal;
    const Four* luminance; ///< [padded wavelength]; null: spectral
};

/// The nodes of several rays in the air: Sun by Sun, since they look at the same levels.
SKY_WIDEST_VECTORS
void foldNodes(const FoldField& field, const std::vector<Pending>& nodes, const FoldSettings& settings)
{
    const int stride = field.stride, rows = settings.azimuthal + 2;
    const std::size_t values = std::size_t(field.harmonics) * stride;
    base::VectorsOf<float> spectrum(std::size_t(rows) * stride), means(stride);
    base::VectorsOf<Four> weights(stride);
    for (int sun = 0; sun < field.suns; ++sun)
        for (const Pending& node : nodes) {
            const float* levels[4];
            for (int i = 0; i < 4; ++i)
                levels[i] = &field.moments[(std::size_t(node.place->level[i]) * field.suns + sun) * values];
            float* const out = settings.luminance ? spectrum.data() : node.target + std::size_t(sun) * rows * stride;
            if (stride == 16) // the usual number of wavelengths: loops that the compiler can unroll
                physics::foldNode(levels, node.place->weight, node.place->between, node.coefficients, settings.degree, settings.bentDegree,
                                  settings.azimuthal, 16, out);
            else
                physics::foldNode(levels, node.place->weight, node.place->between, node.coefficients, settings.degree, settings.bentDegree,
                                  settings.azimuthal, stride, out);
            if (settings.luminance)
                toLuminance(out, settings.luminance, rows, stride, means.data(), weights.data(), node.target + std::size_t(sun) * rows * 4);
        }
}

/// From the field's Suns to the fine ones: both [sun][values].
SKY_WIDEST_VECTORS
void refine(const float* __restrict source, const std::vector<physics::Stencil>& suns, int values, float* __restrict target)
{
    for (const auto& sun : suns) {
        const float* __restrict a = source + sun.index[0] * values, * __restrict b = source + sun.index[1] * values;
        const float* __restrict c = source + sun.index[2] * values, * __restrict d = source + sun.index[3] * values;
        const auto wa = static_cast<float>(sun.weight[0]), wb = static_cast<float>(sun.weight[1]), wc = static_cast<float>(sun.weight[2]),
                   wd = static_cast<float>(sun.weight[3]);
        for (int i = 0; i < values; ++i)
            target[i] = wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i];
        target += values;
    }
}

/// What depends on the ray alone: `coefficients` [node][lm][stride].
void foldDirections(const ScatteredRays& rays, std::size_t firstNode, int nodes, int azimuthal, int harmonics, int stride,
                    float* coefficients)
{
    for (int k = 0; k < nodes; ++k, coefficients += harmonics * stride) {
        const float* c = &rays.coefficients[(firstNode + k) * (rays.degree + 1) * stride];
        const float* p = &rays.factors[(firstNode + k) * harmonics];
        for (int l = 0; l <= rays.degree; ++l)
            for (int m = 0; m <= std::min(l, azimuthal); ++m) {
                const int lm = physics::harmonicIndex(l, m);
                for (int w = 0; w < stride; ++w)
                    coefficients[lm * stride + w] = c[l * stride + w] * p[lm];
            }
    }
}

/// What the ground throws into a ray: the same in all azimuths.
///   target  [sun][1 + term][channel]
void foldGround(const FoldField& field, const float* reflectance, int rows, const Four* luminance, float* target)
{
    const int stride = field.stride, channels = luminance ? 4 : stride;
    base::VectorsOf<float> spectrum(std::size_t(rows) * stride, 0.F), means(stride);
    base::VectorsOf<Four> weights(stride);
    std::copy_n(reflectance, stride, &spectrum[stride]);
    for (int sun = 0; sun < field.suns; ++sun, target += rows * channels) {
        std::copy_n(&field.ground[std::size_t(sun) * stride], stride, spectrum.data());
        if (luminance)
            toLuminance(spectrum.data(), luminance, rows, stride, means.data(), weights.data(), target);
        else
            std::copy(spectrum.begin(), spectrum.end(), target);
    }
}

/// Adds a part of a node's light to a station: both [sun][row][channel], the node's as logarithm of the mean and terms relative to
/// it, the station's as sums.
///   seen   what the node's mean counts in the station's
///   means  scratch, [channel]
SKY_WIDEST_VECTORS
void addShare(const float* __restrict node, int suns, int rows, int channels, float part, float seen, float* __restrict means,
              float* __restrict station)
{
    for (int sun = 0; sun < suns; ++sun, node += rows * channels, station += rows * channels) {
        for (int c = 0; c < channels; ++c) {
            means[c] = part * base::exp2Lane(node[c]);
            station[c] += seen * means[c];
        }
        for (int m = 1; m < rows; ++m)
            for (int c = 0; c < channels; ++c)
                station[m * channels + c] += means[c] * node[m * channels + c];
    }
}

/// Sums to logarithms and ratios.
SKY_WIDEST_VECTORS
void toRatios(int suns, int rows, int channels, float* __restrict inverse, float* __restrict station)
{
    for (int sun = 0; sun < suns; ++sun, station += rows * channels) {
        for (int c = 0; c < channels; ++c) {
            const float mean = std::max(station[c], std::numeric_limits<float>::min());
            inverse[c] = 1 / mean;
            station[c] = base::log2Lane(mean);
        }
        for (int m = 1; m < rows; ++m)
            for (int c = 0; c < channels; ++c)
                station[m * channels + c] *= inverse[c];
    }
}

} // namespace

FoldField::FoldField(const physics::Moments& m, const int refinement)
{
    const auto& grid = m.grid;
    suns = grid.sunCount() + 1;
    harmonics = physics::harmonicCount(m.degree);
    stride = (m.wavelengths + 3) / 4 * 4;
    sunAxis = {static_cast<float>(grid.sunScale()), static_cast<float>(std::sinh(grid.sunScale())), static_cast<float>(grid.vLowest())};
    moments.assign(std::size_t(grid.altitudeCount()) * suns * harmonics * stride, 0.F);
    ground.assign(std::size_t(suns) * stride, 0.F);
    const auto values = m.withSunBeyondZenith();
    for (std::size_t row = 0; row < values.size() / m.wavelengths; ++row)
        for (int w = 0; w < m.wavelengths; ++w)
            moments[row * stride + w] = static_cast<float>(values[row * m.wavelengths + w] * (row % harmonics == 0 ? toLog2 : 1));
    for (int sun = 0; sun < suns; ++sun)
        for (int w = 0; w < m.wavelengths; ++w)
            ground[std::size_t(sun) * stride + w] =
                static_cast<float>(std::log2(std::max(m.groundIrradiance[grid.sunAsHigh(sun) * m.wavelengths + w], physics::darkness)));
    for (int f = 0; f <= (grid.sunCount() - 1) * refinement; ++f)
        fineSuns.push_back(grid.sunStencil(double(f) / refinement));
}

void fold(const FoldField& field, const ScatteredRays& rays, const int first, const int count, const int azimuthal,
          const std::vector<std::array<float, 4>>& luminance, float* const source)
{
    const int rows = azimuthal + 2, stride = field.stride, channels = luminance.empty() ? stride : 4;
    const std::size_t values = std::size_t(field.suns) * rows * channels, fine = field.fineSuns.size() * rows * channels;
    const std::size_t perRay = (rays.nodes + 1) * values, coefficientsPerRay = std::size_t(rays.nodes) * field.harmonics * stride;
    // As many rays together as leave room for the field's levels in the second cache.
    const int together = static_cast<int>(std::clamp<std::size_t>(cachedFloats / (perRay + coefficientsPerRay), 1, 8));
    base::VectorsOf<Four> colours;
    for (const auto& [x, y, z, scotopic] : luminance)
        colours.push_back(Four{x, y, z, scotopic});
    const FoldSettings settings{rays.degree, rays.bentDegree, azimuthal, colours.empty() ? nullptr : colours.data()};
    base::parallel([&](int thread, int threads) {
        base::VectorsOf<float> coefficients(together * coefficientsPerRay), folded(together * perRay), means(channels), stations;
        std::vector<bool> sums; // of stations: not light of a single node
        std::vector<Pending> pending;
        const auto addStations = [&](int r, const float* nodes) {
            const Stations::Share* const shares = &rays.shares[std::size_t(r) * (rays.nodes + 1)];
            const int firstStation = rays.firstStation[r], stationCount = rays.firstStation[r + 1] - firstStation;
            const auto finish = [&](const float* station, int index) {
                refine(station, field.fineSuns, rows * channels, source + (firstStation - rays.firstStation[first] + index) * fine);
            };
            stations.assign(stationCount * values, 0.F);
            sums.assign(stationCount, true);
            for (int k = 0; k <= rays.nodes; ++k, nodes += values) {
                const auto& share = shares[k];
                if (share.seen == 0)
                    continue;
                if (share.alone) {
                    finish(nodes, share.station);
                    sums[share.station] = false;
                    continue;
                }
                float* const nearer = &stations[share.station * values];
                if (share.nearer > 0)
                    addShare(nodes, field.suns, rows, channels, share.nearer, share.seen, means.data(), nearer);
                if (share.farther > 0)
                    addShare(nodes, field.suns, rows, channels, share.farther, share.seen, means.data(), nearer + values);
            }
            for (int i = 0; i < stationCount; ++i)
                if (sums[i]) {
                    float* const station = &stations[i * values];
                    toRatios(field.suns, rows, channels, means.data(), station);
                    finish(station, i);
                }
        };
        for (int begin = first + thread * together; begin < first + count; begin += threads * together) {
            const int end = std::min(begin + together, first + count);
            pending.clear();
            for (int r = begin; r < end; ++r) {
                const Stations::Share* const shares = &rays.shares[std::size_t(r) * (rays.nodes + 1)];
                const std::size_t firstNode = std::size_t(r) * rays.nodes;
                float* const own = &coefficients[(r - begin) * coefficientsPerRay];
                float* const target = &folded[(r - begin) * perRay];
                int lit = rays.nodes;
                while (lit > 0 && shares[lit - 1].seen == 0)
                    --lit;
                foldDirections(rays, firstNode, lit, azimuthal, field.harmonics, stride, own);
                for (int k = 0; k < lit; ++k)
                    pending.push_back({&rays.folds[firstNode + k], own + std::size_t(k) * field.harmonics * stride, target + k * values});
                if (shares[rays.nodes].seen > 0)
                    foldGround(field, &rays.ground[std::size_t(r) * stride], rows, settings.luminance, target + rays.nodes * values);
            }
            foldNodes(field, pending, settings);
            for (int r = begin; r < end; ++r)
                addStations(r, &folded[(r - begin) * perRay]);
        }
    });
}

} // namespace sky::solver
