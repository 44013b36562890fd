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

/// The nodes of a ray in the air: Sun by Sun, since neighbouring nodes look at the same levels.
///   coefficients  [node][lm][stride]
///   target        [node][sun][1 + term][stride]
SKY_WIDEST_VECTORS
void foldNodes(const FoldField& field, const ScatteredRays::FoldNode* nodes, int nodeCount, int degree, int bentDegree, int azimuthal,
               const float* coefficients, float* target)
{
    const int stride = field.stride, values = field.harmonics * stride;
    for (int sun = 0; sun < field.suns; ++sun)
        for (int k = 0; k < nodeCount; ++k) {
            const float* levels[4];
            for (int i = 0; i < 4; ++i)
                levels[i] = &field.moments[(std::size_t(nodes[k].level[i]) * field.suns + sun) * values];
            float* out = target + (k * field.suns + sun) * (azimuthal + 2) * stride;
            if (stride == 16) // the usual number of wavelengths: loops that the compiler can unroll
                physics::foldNode(levels, nodes[k].weight, nodes[k].between, coefficients + k * values, degree, bentDegree, azimuthal, 16,
                                  out);
            else
                physics::foldNode(levels, nodes[k].weight, nodes[k].between, coefficients + k * values, degree, bentDegree, azimuthal,
                                  stride, out);
        }
}

/// X, Y, Z, scotopic: the compiler's vector type.
using Four = float __attribute__((vector_size(16)));

/// The same node as luminance: `source` is its [sun][1 + term][stride], `target` its [sun][1 + term][4].
///   luminance  [wavelength][4]
///   weights    scratch, [wavelength]
SKY_WIDEST_VECTORS
void toLuminance(const float* __restrict source, const float* __restrict luminance, int suns, int rows, int stride,
                 Four* __restrict weights, float* __restrict target)
{
    for (int sun = 0; sun < suns; ++sun, source += rows * stride, target += rows * 4) {
        Four level{};
        for (int w = 0; w < stride; ++w) {
            const float mean = base::exp2Lane(source[w]);
            weights[w] =
                Four{mean, mean, mean, mean} * Four{luminance[w * 4], luminance[w * 4 + 1], luminance[w * 4 + 2], luminance[w * 4 + 3]};
            level += weights[w];
        }
        Four inverse{};
        for (int c = 0; c < 4; ++c) {
            const float sum = std::max(level[c], std::numeric_limits<float>::min());
            target[c] = std::log2(sum);
            inverse[c] = 1 / sum;
        }
        for (int m = 1; m < rows; ++m) {
            const float* __restrict term = source + m * stride;
            Four even{}, odd{}; // two sums, since one waits for itself; stride is a multiple of four
            for (int w = 0; w < stride; w += 2) {
                even += weights[w] * Four{term[w], term[w], term[w], term[w]};
                odd += weights[w + 1] * Four{term[w + 1], term[w + 1], term[w + 1], term[w + 1]};
            }
            const Four sum = (even + odd) * inverse;
            for (int c = 0; c < 4; ++c)
                target[m * 4 + c] = sum[c];
        }
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
///   to  [sun][1 + term][stride]
void foldGround(const FoldField& field, const float* reflectance, int rows, float* to)
{
    for (int sun = 0; sun < field.suns; ++sun, to += rows * field.stride) {
        std::fill_n(to, rows * field.stride, 0.F);
        std::copy_n(&field.ground[std::size_t(sun) * field.stride], field.stride, to);
        std::copy_n(reflectance, field.stride, to + field.stride);
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
    const std::size_t values = std::size_t(field.suns) * rows, fine = field.fineSuns.size() * rows * channels;
    base::parallel([&](int thread, int threads) {
        std::vector<float> coefficients(std::size_t(rays.nodes) * field.harmonics * stride), spectral((rays.nodes + 1) * values * stride),
            bright(luminance.empty() ? 0 : values * 4), means(channels), stations;
        std::vector<bool> sums; // of stations: not light of a single node
        std::vector<Four> weights(stride);
        for (int r = thread; r < count; r += threads) {
            const std::size_t firstNode = std::size_t(first + r) * rays.nodes;
            const Stations::Share* const shares = &rays.shares[std::size_t(first + r) * (rays.nodes + 1)];
            int lit = rays.nodes;
            while (lit > 0 && shares[lit - 1].seen == 0)
                --lit;
            foldDirections(rays, firstNode, lit, azimuthal, field.harmonics, stride, coefficients.data());
            foldNodes(field, &rays.folds[firstNode], lit, rays.degree, rays.bentDegree, azimuthal, coefficients.data(), spectral.data());
            if (shares[rays.nodes].seen > 0)
                foldGround(field, &rays.ground[std::size_t(first + r) * stride], rows, &spectral[rays.nodes * values * stride]);
            const int firstStation = rays.firstStation[first + r], stationCount = rays.firstStation[first + r + 1] - firstStation;
            const auto finish = [&](const float* station, int index) {
                refine(station, field.fineSuns, rows * channels, source + (firstStation - rays.firstStation[first] + index) * fine);
            };
            stations.assign(stationCount * values * channels, 0.F);
            sums.assign(stationCount, true);
            for (int k = 0; k <= rays.nodes; ++k) {
                const auto& share = shares[k];
                if (share.seen == 0)
                    continue;
                const float* node = &spectral[k * values * stride];
                if (!luminance.empty()) {
                    toLuminance(node, luminance.data()->data(), field.suns, rows, stride, weights.data(), bright.data());
                    node = bright.data();
                }
                if (share.alone) {
                    finish(node, share.station);
                    sums[share.station] = false;
                    continue;
                }
                float* const nearer = &stations[share.station * values * channels];
                if (share.nearer > 0)
                    addShare(node, field.suns, rows, channels, share.nearer, share.seen, means.data(), nearer);
                if (share.farther > 0)
                    addShare(node, field.suns, rows, channels, share.farther, share.seen, means.data(), nearer + values * channels);
            }
            for (int i = 0; i < stationCount; ++i)
                if (sums[i]) {
                    float* const station = &stations[i * values * channels];
                    toRatios(field.suns, rows, channels, means.data(), station);
                    finish(station, i);
                }
        }
    });
}

} // namespace sky::solver
