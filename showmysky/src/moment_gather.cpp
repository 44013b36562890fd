#include "moment_gather.hpp"

#include "base/angles.hpp"
#include "base/lanes.hpp"
#include "base/parallel.hpp"
#include "physics/air_entry.hpp"
#include "physics/field_fold.hpp"
#include "physics/harmonics.hpp"
#include "physics/shadow_edge.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::pi;
constexpr float toLog2 = 1.44269504f;

/// depth[w] interpolated in a table of sunlight at `near` (two elevations, two rows), to visible exp(-depth).
SKY_WIDEST_VECTORS
void transmit(const float* __restrict near, const float* __restrict far, float x, float y, float visible, int stride,
              float* __restrict result)
{
    for (int w = 0; w < stride; ++w) {
        const float below = near[w] + x * (near[stride + w] - near[w]);
        const float above = far[w] + x * (far[stride + w] - far[w]);
        result[w] = visible * sky::base::exp2Lane(-toLog2 * (below + y * (above - below)));
    }
}

SKY_WIDEST_VECTORS
void addProducts(const float* __restrict weights, const float* __restrict light, int scatterers, int stride, float* __restrict sums)
{
    for (int i = 0; i < scatterers; ++i)
        for (int w = 0; w < stride; ++w)
            sums[i * stride + w] += weights[i * stride + w] * light[w];
}

/// One node of the field at one Sun.
SKY_WIDEST_VECTORS
void foldField(const float* const levels[4], const float weights[4], float between, const float* coefficients, int degree, int bentDegree,
               int stride, float* out)
{
    physics::foldNode(levels, weights, between, coefficients, degree, bentDegree, degree, stride, out);
}

/// Adds 2^level sum_m cos(m phi) term_m, all interpolated between four Suns.
SKY_WIDEST_VECTORS
void addNode(const float* const suns[4], const float weights[4], const float* waves, int degree, int stride, float* __restrict radiance)
{
    const float *a = suns[0], *b = suns[1], *c = suns[2], *d = suns[3];
    for (int w = 0; w < stride; ++w) {
        const float level = weights[0] * a[w] + weights[1] * b[w] + weights[2] * c[w] + weights[3] * d[w];
        float sum = 0;
        for (int m = 0; m <= degree; ++m) {
            const int at = (m + 1) * stride + w;
            sum += waves[m] * (weights[0] * a[at] + weights[1] * b[at] + weights[2] * c[at] + weights[3] * d[at]);
        }
        radiance[w] += sky::base::exp2Lane(level) * sum;
    }
}

float clampedSine(float x) { return std::clamp(x, -1.f, 1.f); }

} // namespace

MomentGather::MomentGather(const Atmosphere& atmosphere, const Phases& phases, const physics::Moments* moments,
                           const physics::SunTable& sun, double sunAngularRadius)
    : atmosphere_(atmosphere), phases_(phases), moments_(moments), sun_(sun), sunRadius_(static_cast<float>(sunAngularRadius)),
      stride_((atmosphere.wavelengths() + 3) / 4 * 4), scatterers_(atmosphere.scatterers()), degree_(moments ? moments->degree : 0),
      bentDegree_(std::min(degree_, physics::bentDegree(atmosphere.optics))), suns_(moments ? moments->grid.sunCount() + 1 : 0)
{
    const int wavelengths = atmosphere.wavelengths();
    const auto& depths = sun.opticalDepths();
    sunDepths_.assign(depths.size() / static_cast<std::size_t>(wavelengths) * static_cast<std::size_t>(stride_), 0.f);
    for (std::size_t i = 0; i < depths.size(); ++i) {
        const auto count = static_cast<std::size_t>(wavelengths);
        sunDepths_[i / count * static_cast<std::size_t>(stride_) + i % count] = static_cast<float>(depths[i]);
    }
    if (!moments)
        return;
    groundField_.assign(static_cast<std::size_t>(suns_ * 2 * stride_), 1.f);
    for (int j = 0; j < suns_; ++j)
        for (int w = 0; w < wavelengths; ++w)
            groundField_[static_cast<std::size_t>(j * 2 * stride_ + w)] = static_cast<float>(std::log2(std::max(
                moments->groundIrradiance[static_cast<std::size_t>(moments->grid.sunAsHigh(j) * wavelengths + w)], physics::darkness)));
    const int harmonics = physics::harmonicCount(degree_);
    const auto values = moments->withSunBeyondZenith();
    const std::size_t rows = values.size() / static_cast<std::size_t>(wavelengths);
    field_.assign(rows * static_cast<std::size_t>(stride_), 0.f);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t w = 0; w < static_cast<std::size_t>(wavelengths); ++w)
            field_[row * static_cast<std::size_t>(stride_) + w] =
                static_cast<float>(values[row * static_cast<std::size_t>(wavelengths) + w] *
                                   (row % static_cast<std::size_t>(harmonics) == 0 ? static_cast<double>(toLog2) : 1.));
}

void MomentGather::setAltitude(double altitude)
{
    if (altitude == altitude_)
        return;
    altitude_ = altitude;
    sines_ = viewSines(atmosphere_.planet(), altitude, halfViews);
    rays_.assign(2 * halfViews, Ray{});
    traced_ = 0;
}

MomentGather::Node MomentGather::nodeOf(const physics::RayNodes::Node& node) const
{
    Node result;
    result.sunScale = static_cast<float>(node.sunScale);
    result.nuScale = static_cast<float>(node.nuScale);
    result.mu = static_cast<float>(node.mu);
    const double horizon = sun_.horizon(node.altitude);
    const double range = pi / 2 - horizon + static_cast<double>(sunRadius_);
    result.horizon = static_cast<float>(horizon);
    result.inverseRange = static_cast<float>(1 / std::asinh(range / sun_.elevationScale()));
    const auto row = sun_.row(node.altitude);
    result.sunRow = row.index;
    result.sunRowShare = static_cast<float>(row.fraction);
    if (moments_)
        result.level = moments_->grid.altitudeStencil(node.altitude);
    return result;
}

void MomentGather::trace(int index, physics::RayTracer& tracer) const
{
    Ray& ray = rays_[static_cast<std::size_t>(index)];
    const auto& planet = atmosphere_.planet();
    const int wavelengths = atmosphere_.wavelengths();
    ray.ground = index >= halfViews;
    const auto entry = enterAir(planet, altitude_, sines_[static_cast<std::size_t>(index)]);
    if (!entry)
        return;
    ray.lit = true;
    const int nodes = atmosphere_.profile.forShadows(singleNodes, static_cast<double>(sunRadius_));
    const auto single = tracer.trace(entry->altitude, entry->mu, nodes, ray.ground);
    for (const auto& node : single.nodes)
        ray.single.push_back(nodeOf(entry->node(node)));
    const auto rows = single.nodes.size() * static_cast<std::size_t>(scatterers_);
    ray.singleWeights.assign(rows * static_cast<std::size_t>(stride_), 0.f);
    for (std::size_t i = 0; i < rows; ++i)
        for (int w = 0; w < wavelengths; ++w) {
            // Scattering is scaled down by what truncation took, the phase function isn't: see physics::Optics.
            const int species = atmosphere_.optics.scatterers[i % static_cast<std::size_t>(scatterers_)];
            const double truncation = atmosphere_.optics.truncation[static_cast<std::size_t>(species * wavelengths + w)];
            ray.singleWeights[i * static_cast<std::size_t>(stride_) + static_cast<std::size_t>(w)] = static_cast<float>(
                single.weights[i * static_cast<std::size_t>(wavelengths) + static_cast<std::size_t>(w)] / (1 - truncation));
        }
    if (ray.ground) {
        ray.groundNode = nodeOf(entry->node(single.ground));
        ray.groundNode.sunRow = sun_.groundRow().index;
        ray.groundNode.sunRowShare = static_cast<float>(sun_.groundRow().fraction);
        for (int w = 0; w < stride_; ++w)
            ray.groundFactors.push_back(w < wavelengths
                                            ? static_cast<float>(single.groundTransmittance[static_cast<std::size_t>(w)] *
                                                                 atmosphere_.medium.groundAlbedo[static_cast<std::size_t>(w)] / pi)
                                            : 0.f);
    }
    if (!moments_)
        return;
    const auto multiple = tracer.trace(entry->altitude, entry->mu, multipleNodes, ray.ground, physics::NodesFor::Field);
    const int harmonics = physics::harmonicCount(degree_);
    ray.coefficients.assign(static_cast<std::size_t>(multipleNodes * harmonics * stride_), 0.f);
    std::vector<double> factors(static_cast<std::size_t>(harmonics));
    for (int k = 0; k < multipleNodes; ++k) {
        const auto& node = multiple.nodes[static_cast<std::size_t>(k)];
        ray.multiple.push_back(nodeOf(entry->node(node)));
        physics::harmonicFactors(degree_, node.mu, factors.data());
        for (int l = 0, lm = 0; l <= degree_; ++l)
            for (int m = 0; m <= l; ++m, ++lm)
                for (int i = 0; i < scatterers_; ++i)
                    for (int w = 0; w < wavelengths; ++w)
                        ray.coefficients[static_cast<std::size_t>((k * harmonics + lm) * stride_ + w)] +=
                            static_cast<float>(factors[static_cast<std::size_t>(lm)] *
                                               multiple.weights[static_cast<std::size_t>((k * scatterers_ + i) * wavelengths + w)] *
                                               atmosphere_.optics.moment(atmosphere_.optics.scatterers[static_cast<std::size_t>(i)], l, w));
    }
    ray.folded.resize(static_cast<std::size_t>(multipleNodes * suns_ * (degree_ + 2) * stride_));
    ray.isFolded.assign(static_cast<std::size_t>(multipleNodes * suns_), 0);
}

bool MomentGather::step(int count)
{
    const int total = static_cast<int>(rays_.size()), end = std::min(total, traced_ + count), first = traced_;
    sky::base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(atmosphere_.profile, atmosphere_.optics, 2);
        for (int r = first + thread; r < end; r += threads)
            trace(r, tracer);
    });
    traced_ = end;
    return traced_ == total;
}

const float* MomentGather::folded(Ray& ray, int node, int sun) const
{
    const int rows = degree_ + 2, harmonics = physics::harmonicCount(degree_);
    float* const result = &ray.folded[static_cast<std::size_t>((node * suns_ + sun) * rows * stride_)];
    auto& done = ray.isFolded[static_cast<std::size_t>(node * suns_ + sun)];
    if (!done) {
        const auto& stencil = ray.multiple[static_cast<std::size_t>(node)].level;
        const float* levels[4];
        float weights[4];
        for (std::size_t i = 0; i < 4; ++i) {
            levels[i] = &field_[static_cast<std::size_t>((stencil.index[i] * suns_ + sun) * harmonics * stride_)];
            weights[i] = static_cast<float>(stencil.weight[i]);
        }
        foldField(levels, weights, static_cast<float>(stencil.between),
                  &ray.coefficients[static_cast<std::size_t>(node * harmonics * stride_)], degree_, bentDegree_, stride_, result);
        done = 1;
    }
    return result;
}

void MomentGather::sunlight(const Node& node, double visible, float aboveHorizon, float* result) const
{
    if (visible <= 0) {
        std::fill(result, result + stride_, 0.f);
        return;
    }
    const int elevations = sun_.elevationCount();
    const float above = std::max(0.f, aboveHorizon + sunRadius_);
    const float scale = static_cast<float>(sun_.elevationScale());
    const float u = std::min(1.f, std::asinh(above / scale) * node.inverseRange) * static_cast<float>(elevations - 1);
    const int k = std::min(static_cast<int>(u), elevations - 2);
    const float* near = &sunDepths_[static_cast<std::size_t>((node.sunRow * elevations + k) * stride_)];
    transmit(near, near + elevations * stride_, u - static_cast<float>(k), node.sunRowShare, static_cast<float>(visible), stride_, result);
}

void MomentGather::addSingle(const Ray& ray, float muSun, float nu, float* lit) const
{
    std::vector<float> light(static_cast<std::size_t>(stride_));
    std::vector<double> above;
    for (const Node& node : ray.single)
        above.push_back(static_cast<double>(std::asin(clampedSine(node.sunScale * muSun + node.nuScale * nu)) - node.horizon));
    const auto visible = physics::visibleAlong(above, static_cast<double>(sunRadius_));
    for (std::size_t k = 0; k < ray.single.size(); ++k) {
        sunlight(ray.single[k], visible[k], static_cast<float>(above[k]), light.data());
        addProducts(&ray.singleWeights[k * static_cast<std::size_t>(scatterers_ * stride_)], light.data(), scatterers_, stride_, lit);
    }
}

void MomentGather::addMultiple(Ray& ray, float muSun, float nu, float* radiance) const
{
    std::vector<float> waves(static_cast<std::size_t>(degree_) + 1);
    for (int k = 0; k < multipleNodes; ++k) {
        const Node& node = ray.multiple[static_cast<std::size_t>(k)];
        const float muSunNode = clampedSine(node.sunScale * muSun + node.nuScale * nu);
        const auto stencil = moments_->grid.sunStencil(moments_->grid.sunPosition(std::asin(static_cast<double>(muSunNode))));
        const float sines = std::sqrt(std::max(0.f, (1 - node.mu * node.mu) * (1 - muSunNode * muSunNode)));
        const float cosine = sines > 1e-6f ? clampedSine((nu - node.mu * muSunNode) / sines) : 1.f;
        float wave = 1, before = cosine; // cos(m phi), cos((m - 1) phi)
        for (auto& value : waves) {
            value = wave;
            const float after = 2 * cosine * wave - before;
            before = wave;
            wave = after;
        }
        const float* suns[4];
        float weights[4];
        for (std::size_t j = 0; j < 4; ++j) {
            suns[j] = folded(ray, k, stencil.index[j]);
            weights[j] = static_cast<float>(stencil.weight[j]);
        }
        addNode(suns, weights, waves.data(), degree_, stride_, radiance);
    }
}

void MomentGather::addGround(const Ray& ray, float muSun, float nu, const LayersUsed& layers, float* radiance) const
{
    const auto& node = ray.groundNode;
    const float muSunThere = clampedSine(node.sunScale * muSun + node.nuScale * nu);
    const float elevation = std::asin(muSunThere);
    std::vector<float> light(static_cast<std::size_t>(stride_));
    const float above = elevation - node.horizon;
    sunlight(node, physics::visibleDiscFraction(static_cast<double>(above), static_cast<double>(sunRadius_)), above, light.data());
    const auto cosine = static_cast<float>(physics::horizontalSunCosine(static_cast<double>(muSunThere), static_cast<double>(sunRadius_)));
    for (float& value : light)
        value *= layers.groundDirect ? cosine : 0.f;
    if (moments_ && layers.groundDiffuse) {
        const auto stencil = moments_->grid.sunStencil(moments_->grid.sunPosition(static_cast<double>(elevation)));
        const float* suns[4];
        float weights[4];
        for (std::size_t j = 0; j < 4; ++j) {
            suns[j] = &groundField_[static_cast<std::size_t>(stencil.index[j] * 2 * stride_)];
            weights[j] = static_cast<float>(stencil.weight[j]);
        }
        const float one = 1;
        addNode(suns, weights, &one, 0, stride_, light.data());
    }
    for (std::size_t w = 0; w < light.size(); ++w)
        radiance[w] += ray.groundFactors[w] * light[w];
}

SkyView MomentGather::gather(double muSun, const LayersUsed& layers, const std::vector<Texel>& weights)
{
    while (!step(static_cast<int>(rays_.size()))) {
    }
    const auto scatterers = static_cast<std::size_t>(scatterers_), stride = static_cast<std::size_t>(stride_);
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    const bool anySingle = std::find(layers.single.begin(), layers.single.end(), true) != layers.single.end();
    SkyView result;
    result.whole = ViewTable(halfViews, azimuths);
    result.scattered.assign(scatterers, ViewTable());
    for (std::size_t i = 0; i < scatterers; ++i)
        if (layers.single[i])
            result.scattered[i] = ViewTable(halfViews, azimuths);

    const auto luminance = [&](const float* radiance) {
        Texel sum{};
        for (std::size_t w = 0; w < wavelengths; ++w)
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += weights[w][c] * std::max(0.f, radiance[w]);
        return sum;
    };
    sky::base::parallel([&](int thread, int threads) {
        std::vector<float> radiance(stride), lit(scatterers * stride);
        std::vector<double> phase(wavelengths);
        for (int v = thread; v < 2 * halfViews; v += threads) {
            Ray& ray = rays_[static_cast<std::size_t>(v)];
            if (!ray.lit)
                continue;
            const double mu = sines_[static_cast<std::size_t>(v)];
            const double sines = std::sqrt(std::max(0., (1 - mu * mu) * (1 - muSun * muSun)));
            for (int a = 0; a < azimuths; ++a) {
                const double nu = std::clamp(mu * muSun + sines * std::cos(pi * a / (azimuths - 1)), -1., 1.);
                const auto muSunF = static_cast<float>(muSun), nuF = static_cast<float>(nu);
                std::fill(radiance.begin(), radiance.end(), 0.f);
                if (layers.multiple && moments_)
                    addMultiple(ray, muSunF, nuF, radiance.data());
                if (layers.ground && ray.ground)
                    addGround(ray, muSunF, nuF, layers, radiance.data());
                result.whole.at(v, a) = luminance(radiance.data());
                if (!anySingle)
                    continue;
                std::fill(lit.begin(), lit.end(), 0.f);
                addSingle(ray, muSunF, nuF, lit.data());
                for (std::size_t i = 0; i < scatterers; ++i) {
                    if (!layers.single[i])
                        continue;
                    phases_.ratio(static_cast<int>(i), nu, phase.data());
                    for (std::size_t w = 0; w < wavelengths; ++w)
                        lit[i * stride + w] *= static_cast<float>(phase[w]);
                    result.scattered[i].at(v, a) = luminance(&lit[i * stride]);
                }
            }
        }
    });
    return result;
}

} // namespace showmysky
