#include "photometry_gather.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include "physics/shadow_edge.hpp"
#include <algorithm>
#include <array>
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
    const Block* corners[4];       ///< [sun][lm][block] at four altitudes, the first of four Suns
    std::ptrdiff_t sun;            ///< from one Sun to the next
    std::ptrdiff_t middle;         ///< from the first to the two in the middle
    std::array<float, 16> weights; ///< [altitude][sun]
    std::array<float, 4> straight; ///< [altitude][sun], of the four in the middle
    std::array<float, 4> altitude; ///< weights of the stencil, whose place between the middle two is `between`
    std::array<float, 4> suns;     ///< weights
    float between;
    const float* harmonics; ///< [lm][node], Y_lm of the ray's direction
    int nodes;
    const Block* scattering; ///< [scatterer][block]
};

/// The logarithm of the mean.
SKY_INLINE Lanes logarithmAt(const FieldNode& n, const physics::LogarithmBetween<float>& logarithm, int block)
{
    Lanes sum = all(0);
    for (int j = 0; j < 4; ++j) {
        const std::ptrdiff_t at = block + j * n.sun;
        sum += n.suns[j] * logarithm(n.corners[0][at].v, n.corners[1][at].v, n.corners[2][at].v, n.corners[3][at].v);
    }
    return sum;
}

/// Between sixteen neighbours.
SKY_INLINE Lanes interpolated(const FieldNode& n, int at)
{
    Lanes even = all(0), odd = all(0);
    for (int i = 0; i < 4; ++i) {
        const Block* corner = n.corners[i] + at;
        even += n.weights[4 * i] * corner[0].v + n.weights[4 * i + 2] * corner[2 * n.sun].v;
        odd += n.weights[4 * i + 1] * corner[n.sun].v + n.weights[4 * i + 3] * corner[3 * n.sun].v;
    }
    return even + odd;
}

/// Between the four neighbours in the middle.
SKY_INLINE Lanes interpolatedStraight(const FieldNode& n, int at)
{
    const Block *low = n.corners[1] + at + n.middle, *high = n.corners[2] + at + n.middle;
    return (n.straight[0] * low[0].v + n.straight[1] * low[n.sun].v) + (n.straight[2] * high[0].v + n.straight[3] * high[n.sun].v);
}

SKY_WIDEST_VECTORS
void addField(const FieldNode& from, int degree, int bentDegree, int scatterers, int blocks, const Block* lambda, Block* byDegree,
              Block* sum)
{
    const FieldNode n = from; // whose fields no store below can change
    const physics::LogarithmBetween<float> between(n.altitude.data(), n.between, n.corners[0] == n.corners[1], 1);
    for (int b = 0; b < blocks; ++b) {
        const Lanes logarithm = logarithmAt(n, between, b);
        byDegree[0].v = all(n.harmonics[0]);
        int lm = 1;
        for (int l = 1; l <= bentDegree; ++l) {
            Lanes towards = all(0);
            for (int m = 0; m <= l; ++m, ++lm)
                towards += n.harmonics[lm * n.nodes] * interpolated(n, lm * blocks + b);
            byDegree[l].v = towards;
        }
        for (int l = bentDegree + 1; l <= degree; ++l) {
            Lanes towards = all(0);
            for (int m = 0; m <= l; ++m, ++lm)
                towards += n.harmonics[lm * n.nodes] * interpolatedStraight(n, lm * blocks + b);
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

/// For each node the horizon, and the length of the axis over which the Sun rises above it.
///   radius, ground  of the planet as sunlight meets it, and the altitude of that, m
SKY_WIDEST_VECTORS
void findHorizons(double radius, double ground, int count, const double* altitudes, float sunRadius, float elevationScale, float* horizons,
                  float* axisScales)
{
    for (int k = 0; k < count; ++k) {
        const double h = altitudes[k] > ground ? altitudes[k] - ground : 0, far = std::sqrt(h * (h + 2 * radius));
        horizons[k] = -sky::base::arcsineLane(static_cast<float>(far / (radius + h)));
        const float x = (static_cast<float>(pi / 2) - horizons[k] + sunRadius) / elevationScale;
        axisScales[k] = 1 / sky::base::log2Lane(x + std::sqrt(x * x + 1));
    }
}

/// For each node how high the Sun stands, and where that is on the axis: asinh by its logarithm.
SKY_WIDEST_VECTORS
void findSuns(const NodeSet& set, FastScratch& scratch, float muSun, float nu, float sunRadius, float elevationScale)
{
    const float *const sunScales = set.sunScales.data(), *const nuScales = set.nuScales.data(), *const horizons = scratch.horizons.data(),
                       *const axisScales = scratch.axisScales.data();
    float *const above = scratch.above.data(), *const places = scratch.places.data();
    for (int k = 0; k < set.count(); ++k) {
        above[k] = sky::base::arcsineLane(sunScales[k] * muSun + nuScales[k] * nu) - horizons[k];
        const float lifted = above[k] + sunRadius, x = lifted > 0 ? lifted / elevationScale : 0.f;
        const float place = sky::base::log2Lane(x + std::sqrt(x * x + 1)) * axisScales[k];
        places[k] = place < 1 ? place : 1.f;
    }
}

/// For each node how high the Sun stands, and the harmonics towards the eye in azimuth from it.
SKY_WIDEST_VECTORS
void findHarmonics(const NodeSet& set, FastScratch& scratch, int degree, float muSun, float nu)
{
    const int count = set.count();
    const float *const sunScales = set.sunScales.data(), *const nuScales = set.nuScales.data(), *const mu = set.mu.data();
    float *const elevations = scratch.elevations.data(), *const cosines = scratch.cosines.data();
    float *const multiples = scratch.multiples.data(), *const before = scratch.beforeThem.data();
    for (int k = 0; k < count; ++k) {
        const float raised = sunScales[k] * muSun + nuScales[k] * nu, sun = raised < -1 ? -1.f : raised > 1 ? 1.f : raised;
        const float squares = (1 - mu[k] * mu[k]) * (1 - sun * sun);
        const float cosine = squares > 1e-12f ? (nu - mu[k] * sun) / std::sqrt(squares) : 1.f;
        elevations[k] = sky::base::arcsineLane(sun);
        before[k] = cosines[k] = cosine < -1 ? -1.f : cosine > 1 ? 1.f : cosine;
        multiples[k] = 1;
    }
    const float* const factors = scratch.factors.data();
    float* const harmonics = scratch.harmonics.data();
    for (int m = 0; m <= degree; ++m) {
        for (int l = m; l <= degree; ++l)
            for (int k = 0, at = physics::harmonicIndex(l, m) * count; k < count; ++k)
                harmonics[at + k] = factors[at + k] * multiples[k];
        for (int k = 0; k < count; ++k) {
            const float next = 2 * cosines[k] * multiples[k] - before[k];
            before[k] = multiples[k];
            multiples[k] = next;
        }
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

Effort forShadows(Effort effort, const physics::Profile& profile, const double sunRadius)
{
    effort.singleNodes = profile.forShadows(effort.singleNodes, sunRadius);
    return effort;
}

} // namespace

// Opposite to a sharp peak the degrees nearly cancel: what is taken as straight there was 70 % of the light.
FastGather::FastGather(const physics::Medium& medium, const physics::Optics& optics, const physics::SunTable& sun,
                       const physics::Moments* moments, const Effort& effort, const physics::Aureole* aureole)
    : optics_(optics), sun_(sun), moments_(moments),
      aureole_(aureole && aureole->any() ? aureole : nullptr), planet_{medium.planetRadius, medium.topOfAtmosphere},
      profile_(physics::Profile(medium, effort.profileTolerance).withShellsUnderEdges()),
      folder_(profile_, optics, forShadows(effort, profile_, medium.sunAngularRadius)), wavelengths_(optics.wavelengths),
      blocks_(folder_.blocks()), scatterers_(folder_.scatterers()), degree_(optics.degree),
      bentDegree_(physics::truncates(optics) ? optics.degree : physics::bentDegree(optics)), sunRadius_(medium.sunAngularRadius),
      angles_(medium.scatteringAngles)
{
    const auto& depths = sun.opticalDepths();
    depth_ = toBlocks(depths.data(), depths.size() / wavelengths_, wavelengths_);
    if (moments) {
        const auto values = moments->withSunBeyondZenith();
        field_ = toBlocks(values.data(), values.size() / wavelengths_, wavelengths_);
        // Four Suns in a row are read, where the grid has but two and the one beyond the zenith too.
        field_.resize(field_.size() + static_cast<std::size_t>(physics::harmonicCount(degree_)) * blocks_, Block{all(0)});
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
    const int suns = ray.single.count();
    scratch.sunRows.clear();
    for (const double altitude : ray.single.altitudes) {
        const auto [row, share] = sun_.row(altitude);
        scratch.sunRows.push_back({row, static_cast<float>(share)});
    }
    for (auto* numbers : {&scratch.horizons, &scratch.axisScales, &scratch.above, &scratch.places})
        numbers->resize(suns);
    const double ground = sun_.sunlessAltitude();
    findHorizons(planet_.radius + ground, ground, suns, ray.single.altitudes.data(), static_cast<float>(sunRadius_),
                 static_cast<float>(sun_.elevationScale()), scratch.horizons.data(), scratch.axisScales.data());
    if (!moments_)
        return;
    const int nodes = ray.multiple.count(), harmonics = physics::harmonicCount(degree_);
    scratch.fieldRows.clear();
    for (const double altitude : ray.multiple.altitudes)
        scratch.fieldRows.push_back(moments_->grid.altitudeStencil(altitude));
    for (auto* numbers : {&scratch.elevations, &scratch.cosines, &scratch.multiples, &scratch.beforeThem})
        numbers->resize(nodes);
    scratch.factors.resize(nodes * harmonics);
    scratch.harmonics.resize(nodes * harmonics);
    physics::harmonicFactors(degree_, ray.multiple.mu.data(), nodes, scratch.factors.data());
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

void FastGather::addAureole(const double altitude, const double muSun, const double nu, FastScratch& scratch) const
{
    const double angle = std::acos(std::clamp(nu, -1., 1.));
    if (!scratch.tracer)
        scratch.tracer.emplace(profile_, optics_, 2);
    aureole_->depths(*scratch.tracer, altitude, muSun, angle, scratch.columns, scratch.peakDepths);
    auto& factors = scratch.aureole;
    for (int i = 0; i < scatterers_; ++i) {
        factors.assign(wavelengths_, 1.);
        aureole_->multiply(optics_.scatterers[i], angle, scratch.peakDepths, factors.data());
        for (int w = 0; w < wavelengths_; ++w)
            scratch.phase[i * blocks_ + w / count].v[w % count] *= static_cast<float>(factors[w]);
    }
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

void FastGather::gatherSingle(FastScratch& scratch, const double altitude, const double muSun, const double nu, const bool exact) const
{
    const NodeSet& set = scratch.ray.single;
    findSuns(set, scratch, static_cast<float>(muSun), static_cast<float>(nu), static_cast<float>(sunRadius_),
             static_cast<float>(sun_.elevationScale()));
    const int elevations = sun_.elevationCount(), count = set.count();
    SunNode nodes[64];
    const auto above = [&scratch](int node) { return double(scratch.above[node]); };
    scratch.lit.assign(scatterers_ * blocks_, Block{all(0)});
    for (int from = 0; from < count; from += 64) {
        const int part = std::min(64, count - from);
        for (int j = 0; j < part; ++j) {
            const int node = from + j;
            const auto& row = scratch.sunRows[node];
            const float u = scratch.places[node] * static_cast<float>(elevations - 1);
            const int k = std::min(static_cast<int>(u), elevations - 2);
            const Block* low = &depth_[(static_cast<std::size_t>(row.row) * elevations + k) * blocks_];
            const double next = above(node + 1 < count ? node + 1 : count - 2), before = node > 0 ? above(node - 1) : next;
            nodes[j] = {low, low + elevations * blocks_, u - static_cast<float>(k), row.share,
                        static_cast<float>(physics::visibleAlong(before, above(node), next, sunRadius_))};
        }
        addSunlight(nodes, part, scatterers_, blocks_, &set.weights[static_cast<std::size_t>(from) * scatterers_ * blocks_],
                    scratch.lit.data());
    }
    scratch.phase.resize(scatterers_ * blocks_, Block{all(0)});
    if (exact) {
        exactPhase(nu, scratch);
        if (aureole_)
            addAureole(altitude, muSun, nu, scratch);
    } else {
        truncatedPhase(nu, scratch);
    }
    for (int i = 0; i < scatterers_; ++i)
        for (int b = 0; b < blocks_; ++b)
            scratch.sum[b].v += scratch.lit[i * blocks_ + b].v * scratch.phase[i * blocks_ + b].v;
}

void FastGather::gatherMultiple(FastScratch& scratch, const double muSun, const double nu) const
{
    const NodeSet& set = scratch.ray.multiple;
    const auto& grid = moments_->grid;
    const int harmonics = physics::harmonicCount(degree_), suns = grid.sunCount() + 1;
    findHarmonics(set, scratch, degree_, static_cast<float>(muSun), static_cast<float>(nu));
    scratch.byDegree.resize(degree_ + 1, Block{all(0)});
    FieldNode field;
    field.sun = static_cast<std::ptrdiff_t>(harmonics) * blocks_;
    field.nodes = set.count();
    for (int k = 0; k < field.nodes; ++k) {
        const auto sun = grid.sunStencil(grid.sunPosition(double(scratch.elevations[k])));
        // Four neighbours in a row: at the lowest Sun the first, which has no weight, stands at the end instead.
        const int first = std::max(sun.index[1] - 1, 0), ahead = first - (sun.index[1] - 1);
        field.middle = (1 - ahead) * field.sun;
        const auto& altitudes = scratch.fieldRows[k];
        for (int i = 0; i < 4; ++i) {
            field.altitude[i] = static_cast<float>(altitudes.weight[i]);
            field.suns[i] = static_cast<float>(sun.weight[(i + ahead) % 4]);
            field.corners[i] = &field_[(static_cast<std::size_t>(altitudes.index[i]) * suns + first) * harmonics * blocks_];
            for (int j = 0; j < 4; ++j)
                field.weights[4 * i + j] = static_cast<float>(altitudes.weight[i] * sun.weight[(j + ahead) % 4]);
        }
        const float up = static_cast<float>(altitudes.between), on = static_cast<float>(sun.between);
        field.between = up;
        field.straight = {(1 - up) * (1 - on), (1 - up) * on, up * (1 - on), up * on};
        field.harmonics = &scratch.harmonics[k];
        field.scattering = &set.weights[k * scatterers_ * blocks_];
        addField(field, degree_, bentDegree_, scatterers_, blocks_, lambda_.data(), scratch.byDegree.data(), scratch.sum.data());
    }
}

void FastGather::radiance(FastScratch& scratch, const double altitude, const double mu, const double muSun, const double nu,
                          const Parts& parts, double* const result) const
{
    trace(scratch, altitude, mu);
    prepare(scratch);
    scratch.sum.assign(blocks_, Block{all(0)});
    const bool scatters = scatterers_ > 0; // smoke has no phase functions to be asked
    if (parts.single && scatters)
        gatherSingle(scratch, altitude, muSun, nu, parts.exactPhase);
    if (parts.multiple && moments_ && scatters)
        gatherMultiple(scratch, muSun, nu);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = double(scratch.sum[w / count].v[w % count]);
}

} // namespace showmysky
