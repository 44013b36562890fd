#include "photometry_gather.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

using namespace lanes;
namespace physics = sky::physics;

namespace {

using sky::base::pi;

/// Sunlight at one node, added to what is scattered there: optical depth bilinear between four table entries.
struct SunNode {
    const Block *low, *high; ///< [2][block], two elevations at two altitudes
    float x, y, visible;
};

SKY_WIDEST_VECTORS
void addSunlight(const SunNode* nodes, int count, int scatterers, int blocks, const Block* weights, Block* lit)
{
    for (int k = 0; k < count; ++k, weights += scatterers * blocks) {
        const SunNode& n = nodes[k];
        if (n.visible <= 0)
            continue;
        const float w00 = (1 - n.y) * (1 - n.x), w01 = (1 - n.y) * n.x, w10 = n.y * (1 - n.x), w11 = n.y * n.x;
        for (int b = 0; b < blocks; ++b) {
            const Lanes tau = w00 * n.low[b].v + w01 * n.low[blocks + b].v + w10 * n.high[b].v + w11 * n.high[blocks + b].v;
            const Lanes light = n.visible * exponential(-tau);
            for (int i = 0; i < scatterers; ++i)
                lit[i * blocks + b].v += weights[i * blocks + b].v * light;
        }
    }
}

/// The field at one node, scattered towards the eye.
struct FieldNode {
    const Block* corners[16]; ///< [lm][block] each
    float weights[16];
    const float* harmonics;  ///< [lm], Y_lm of the ray's direction
    const Block* scattering; ///< [scatterer][block]
};

SKY_WIDEST_VECTORS
void addField(const FieldNode& n, int degree, int scatterers, int blocks, const Block* lambda, Block* byDegree, Block* sum)
{
    for (int b = 0; b < blocks; ++b) {
        Lanes logarithm = all(0);
        for (int j = 0; j < 16; ++j)
            logarithm += n.weights[j] * n.corners[j][b].v;
        byDegree[0].v = all(n.harmonics[0]);
        for (int l = 1, lm = 1; l <= degree; ++l) {
            Lanes towards = all(0);
            for (int m = 0; m <= l; ++m, ++lm) {
                Lanes a = all(0), c = all(0);
                const int at = lm * blocks + b;
                for (int j = 0; j < 16; j += 2) {
                    a += n.weights[j] * n.corners[j][at].v;
                    c += n.weights[j + 1] * n.corners[j + 1][at].v;
                }
                towards += n.harmonics[lm] * (a + c);
            }
            byDegree[l].v = towards;
        }
        Lanes light = all(0);
        for (int i = 0; i < scatterers; ++i) {
            Lanes scattered = all(0);
            for (int l = 0; l <= degree; ++l)
                scattered += lambda[(i * (degree + 1) + l) * blocks + b].v * byDegree[l].v;
            light += scattered * n.scattering[i * blocks + b].v;
        }
        sum[b].v += exponential(logarithm) * light;
    }
}

SKY_WIDEST_VECTORS
void interpolatePhase(const Block* low, const Block* high, float x, bool logarithmic, int blocks, Block* result)
{
    for (int b = 0; b < blocks; ++b) {
        const Lanes value = (1 - x) * low[b].v + x * high[b].v;
        result[b].v = logarithmic ? exponential(value) : value;
    }
}

} // namespace

FastGather::FastGather(const physics::Medium& medium, const physics::Optics& optics, const physics::SunTable& sun,
                       const physics::Moments* moments, const Effort& effort)
    : sun_(sun), moments_(moments), planet_{medium.planetRadius, medium.topOfAtmosphere}, profile_(medium, effort.profileTolerance),
      folder_(profile_, optics, effort), wavelengths_(optics.wavelengths), blocks_(folder_.blocks()), scatterers_(folder_.scatterers()),
      degree_(optics.degree), sunRadius_(medium.sunAngularRadius), angles_(medium.scatteringAngles)
{
    const auto& depths = sun.opticalDepths();
    depth_ = toBlocks(depths.data(), depths.size() / wavelengths_, wavelengths_);
    if (moments) {
        const auto values = moments->withSunBeyondZenith();
        field_ = toBlocks(values.data(), values.size() / wavelengths_, wavelengths_);
    }
    for (const int s : optics.scatterers) {
        const auto rows = toBlocks(&optics.moments[s * (degree_ + 1) * wavelengths_], degree_ + 1, wavelengths_);
        lambda_.insert(lambda_.end(), rows.begin(), rows.end());
        const auto& phase = medium.species[s].phaseFunction;
        logarithmic_.push_back(std::all_of(phase.begin(), phase.end(), [](double p) { return p > 1e-30; }));
    }
    std::vector<double> row(wavelengths_);
    for (std::size_t a = 0; a < angles_.size(); ++a)
        for (int i = 0; i < scatterers_; ++i) {
            const int s = optics.scatterers[i];
            for (int w = 0; w < wavelengths_; ++w) {
                const double p = medium.species[s].phaseFunction[a * wavelengths_ + w] / (1 - optics.truncation[s * wavelengths_ + w]);
                row[w] = logarithmic_[i] ? std::log(p) : p;
            }
            const auto values = toBlocks(row.data(), 1, wavelengths_);
            phase_.insert(phase_.end(), values.begin(), values.end());
        }
}

/// What the nodes of a new ray need and the Sun doesn't change.
void FastGather::prepare(FastScratch& scratch) const
{
    const FastRay& ray = scratch.ray;
    if (scratch.prepared == ray.version)
        return;
    scratch.prepared = ray.version;
    scratch.sunRows.clear();
    for (const auto& node : ray.single.nodes) {
        const auto [row, y] = sun_.row(node.altitude);
        const double horizon = physics::horizonElevation(planet_, node.altitude), range = pi / 2 - horizon + sunRadius_;
        scratch.sunRows.push_back({row, static_cast<float>(y), horizon, 1 / std::asinh(range / sun_.elevationScale())});
    }
    if (!moments_)
        return;
    scratch.fieldRows.clear();
    const int harmonics = physics::harmonicCount(degree_);
    scratch.factors.resize(ray.multiple.nodes.size() * harmonics);
    for (std::size_t k = 0; k < ray.multiple.nodes.size(); ++k) {
        const auto& node = ray.multiple.nodes[k];
        scratch.fieldRows.push_back(moments_->grid.altitudeStencil(node.altitude));
        physics::harmonicFactors(degree_, node.mu, &scratch.factors[k * harmonics]);
    }
}

void FastGather::exactPhase(const double nu, FastScratch& scratch) const
{
    const double angle = std::acos(std::clamp(nu, -1., 1.));
    const auto above = std::upper_bound(angles_.begin(), angles_.end(), angle) - angles_.begin();
    const auto k = std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(angles_.size()) - 1) - 1;
    const float x = static_cast<float>(std::clamp((angle - angles_[k]) / (angles_[k + 1] - angles_[k]), 0., 1.));
    for (int i = 0; i < scatterers_; ++i)
        interpolatePhase(&phase_[(k * scatterers_ + i) * blocks_], &phase_[((k + 1) * scatterers_ + i) * blocks_], x, logarithmic_[i],
                         blocks_, &scratch.phase[i * blocks_]);
}

void FastGather::truncatedPhase(const double nu, FastScratch& scratch) const
{
    std::vector<double> polynomials(degree_ + 1);
    physics::legendre(degree_, nu, polynomials.data());
    for (int i = 0; i < scatterers_; ++i)
        for (int b = 0; b < blocks_; ++b) {
            Lanes p = all(0);
            for (int l = 0; l <= degree_; ++l)
                p += static_cast<float>((2 * l + 1) / (4 * pi) * polynomials[l]) * lambda_[(i * (degree_ + 1) + l) * blocks_ + b].v;
            scratch.phase[i * blocks_ + b].v = p;
        }
}

void FastGather::gatherSingle(FastScratch& scratch, const double muSun, const double nu, const bool exact) const
{
    const NodeSet& set = scratch.ray.single;
    const int elevations = sun_.elevationCount(), count = static_cast<int>(set.nodes.size());
    SunNode nodes[64];
    scratch.lit.assign(scatterers_ * blocks_, Block{all(0)});
    for (int from = 0; from < count; from += 64) {
        const int part = std::min(64, count - from);
        for (int j = 0; j < part; ++j) {
            const auto& node = set.nodes[from + j];
            const auto& row = scratch.sunRows[from + j];
            const double elevation = std::asin(std::clamp(node.sunScale * muSun + node.nuScale * nu, -1., 1.));
            const double above = elevation - row.horizon;
            const double x = std::max(0., above + sunRadius_) / sun_.elevationScale();
            const double u = std::min(1., std::log(x + std::sqrt(x * x + 1)) * row.scale) * (elevations - 1);
            const int k = std::min(static_cast<int>(u), elevations - 2);
            const Block* low = &depth_[(static_cast<std::size_t>(row.row) * elevations + k) * blocks_];
            nodes[j] = {low, low + elevations * blocks_, static_cast<float>(u - k), row.share,
                        static_cast<float>(physics::visibleDiscFraction(above, sunRadius_))};
        }
        addSunlight(nodes, part, scatterers_, blocks_, &set.weights[static_cast<std::size_t>(from) * scatterers_ * blocks_],
                    scratch.lit.data());
    }
    scratch.phase.resize(scatterers_ * blocks_, Block{all(0)});
    if (exact)
        exactPhase(nu, scratch);
    else
        truncatedPhase(nu, scratch);
    for (int i = 0; i < scatterers_; ++i)
        for (int b = 0; b < blocks_; ++b)
            scratch.sum[b].v += scratch.lit[i * blocks_ + b].v * scratch.phase[i * blocks_ + b].v;
}

void FastGather::gatherMultiple(FastScratch& scratch, const double muSun, const double nu) const
{
    const NodeSet& set = scratch.ray.multiple;
    const auto& grid = moments_->grid;
    const int harmonics = physics::harmonicCount(degree_), suns = grid.sunCount() + 1;
    scratch.byDegree.resize(degree_ + 1, Block{all(0)});
    std::vector<float>& towards = scratch.harmonics;
    towards.resize(harmonics);
    for (std::size_t k = 0; k < set.nodes.size(); ++k) {
        const auto& node = set.nodes[k];
        const double muSunNode = std::clamp(node.sunScale * muSun + node.nuScale * nu, -1., 1.);
        const auto sun = grid.sunStencil(grid.sunPosition(std::asin(muSunNode)));
        const double sines = std::sqrt(std::max(0., (1 - node.mu * node.mu) * (1 - muSunNode * muSunNode)));
        const double cosine = sines > 1e-12 ? std::clamp((nu - node.mu * muSunNode) / sines, -1., 1.) : 1.;
        double chebyshev = 1, previous = cosine; // cos(m phi), cos((m-1) phi)
        for (int m = 0; m <= degree_; ++m) {
            for (int l = m; l <= degree_; ++l)
                towards[physics::harmonicIndex(l, m)] =
                    static_cast<float>(chebyshev * scratch.factors[k * harmonics + physics::harmonicIndex(l, m)]);
            const double next = 2 * cosine * chebyshev - previous;
            previous = chebyshev;
            chebyshev = next;
        }
        FieldNode field;
        const auto& altitudes = scratch.fieldRows[k];
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                field.corners[4 * i + j] =
                    &field_[(static_cast<std::size_t>(altitudes.index[i]) * suns + sun.index[j]) * harmonics * blocks_];
                field.weights[4 * i + j] = static_cast<float>(altitudes.weight[i] * sun.weight[j]);
            }
        field.harmonics = towards.data();
        field.scattering = &set.weights[k * scatterers_ * blocks_];
        addField(field, degree_, scatterers_, blocks_, lambda_.data(), scratch.byDegree.data(), scratch.sum.data());
    }
}

void FastGather::radiance(FastScratch& scratch, const double altitude, const double mu, const double muSun, const double nu,
                          const Parts& parts, double* const result) const
{
    trace(scratch, altitude, mu);
    prepare(scratch);
    scratch.sum.assign(blocks_, Block{all(0)});
    if (parts.single)
        gatherSingle(scratch, muSun, nu, parts.exactPhase);
    if (parts.multiple && moments_)
        gatherMultiple(scratch, muSun, nu);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = double(scratch.sum[w / count].v[w % count]);
}

} // namespace showmysky
