#include "photometry_ray.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

using namespace lanes;
namespace physics = sky::physics;

namespace {

/// What the wavelength loop over the cells of a ray reads and writes.
struct CellLoop {
    int cells, species, scatterers, blocks;
    const float* columns;
    const int* scatterer; ///< indices of species
    const Block *extinction, *scattering;
    const float* centres; ///< [cells][species], of the density: 0..1 of the cell
    CellLight* lit;
    Block* transmittance;
    float *light, *depth;
};

/// Sum of the lanes.
SKY_INLINE float total(const Lanes& x)
{
    float sums[count];
    for (int i = 0; i < count; ++i)
        sums[i] = x[i];
    for (int half = count / 2; half > 0; half /= 2)
        for (int i = 0; i < half; ++i)
            sums[i] += sums[i + half];
    return sums[0];
}

SKY_INLINE Lanes held(const Lanes& x, float low, float high)
{
    const Lanes raised = x < low ? all(low) : x;
    return raised > high ? all(high) : raised;
}

/// Attenuation cell by cell: the mean transmittance over each is T (1 - e^-tau) / tau.
SKY_WIDEST_VECTORS
void foldCells(const CellLoop& loop)
{
    for (int c = 0; c < loop.cells; ++c)
        loop.light[c] = loop.depth[c] = 0;
    for (int b = 0; b < loop.blocks; ++b) {
        Lanes transmittance = all(1);
        for (int c = 0; c < loop.cells; ++c) {
            const float* column = loop.columns + c * loop.species;
            const float* centres = loop.centres + c * loop.species;
            Lanes tau = all(0);
            for (int s = 0; s < loop.species; ++s)
                tau += column[s] * loop.extinction[s * loop.blocks + b].v;
            // (1 - e^-tau) / tau; for small tau by its series, whose next term, tau^6 / 5040, is below 5e-8.
            const Lanes thin = 1 - tau * (0.5f - tau * (1.f / 6 - tau * (1.f / 24 - tau * (1.f / 120 - tau * (1.f / 720)))));
            const Lanes thick = tau < 0.25f ? all(1) : tau, lost = 1 - exponential(-thick), both = 1 / (thick * lost);
            const Lanes inverse = both * lost, mean = tau < 0.25f ? thin : lost * inverse;
            // Attenuation moves the light's centre towards the eye by 1 / tau - 1 / (e^tau - 1) - 1/2 of the cell.
            const Lanes square = tau * tau, near = -tau * (1.f / 12 - square * (1.f / 720 - square * (1.f / 30240)));
            const Lanes shift = tau < 1.f ? near : inverse - both * thick + 0.5f;
            const Lanes seen = transmittance * mean;
            transmittance -= transmittance * (tau * mean);
            Lanes scattered = all(0);
            for (int i = 0; i < loop.scatterers; ++i) {
                const int s = loop.scatterer[i];
                const Lanes amount = column[s] * seen, centre = held(centres[s] + shift, 0, 1), slope = held(6 * centre - 3, -1, 1);
                loop.lit[(c * loop.scatterers + i) * loop.blocks + b] = {{amount}, {slope}, {centre - 0.5f - slope * (1.f / 6)}};
                scattered += amount * loop.scattering[i * loop.blocks + b].v;
            }
            loop.light[c] += total(scattered);
            loop.depth[c] += total(tau);
        }
        loop.transmittance[b].v = transmittance;
    }
}

/// Shares out the cells among the nodes: hat functions between neighbours, as physics::RayTracer::trace.
SKY_WIDEST_VECTORS
void foldWeights(const CellLoop& loop, const std::vector<physics::CellPart>& parts, int nodes, Block* weights)
{
    const int stride = loop.scatterers * loop.blocks;
    std::fill(weights, weights + nodes * stride, Block{all(0)});
    for (const physics::CellPart& part : parts) {
        const physics::PartLight<float> partLight(part);
        const CellLight* lit = loop.lit + part.cell * stride;
        Block *near = weights + part.node * stride, *beyond = near + stride;
        for (int i = 0; i < stride; ++i) {
            const auto light = partLight.of<Lanes>({lit[i].slope.v, lit[i].excess.v});
            Lanes far = light.far < 0.f ? all(0) : light.far;
            far = far > light.share ? light.share : far;
            const Lanes seen = lit[i].amount.v * loop.scattering[i].v;
            near[i].v += (light.share - far) * seen;
            beyond[i].v += far * seen;
        }
    }
}

/// Densities from their arguments: the exponential where it is the logarithm that is linear.
SKY_WIDEST_VECTORS
void foldDensities(int steps, const Block* argument, const Block* logarithmic, Block* density)
{
    for (int i = 0; i < steps; ++i) {
        const Lanes x = argument[i].v, linear = x > 0.f ? x : all(0);
        density[i].v = logarithmic[i].v > 0.5f ? exponential(x) : linear;
    }
}

/// Nodes at their distances along the ray.
SKY_WIDEST_VECTORS
void findNodes(const physics::Planet& planet, const FastRay& ray, NodeSet& set)
{
    const double r = planet.radius + ray.altitude;
    const double* const position = ray.position.data();
    double* const altitudes = set.altitudes.data();
    float *const sunScales = set.sunScales.data(), *const nuScales = set.nuScales.data(), *const mu = set.mu.data();
    for (int k = 0; k < set.count(); ++k) {
        const double s = position[k], h = physics::altitudeAlong(planet, ray.altitude, ray.mu, s), inverse = 1 / (planet.radius + h);
        altitudes[k] = h;
        sunScales[k] = static_cast<float>(r * inverse);
        nuScales[k] = static_cast<float>(s * inverse);
        const double cosine = (r * ray.mu + s) * inverse;
        mu[k] = static_cast<float>(cosine < -1 ? -1 : cosine > 1 ? 1 : cosine);
    }
}

} // namespace

RayFolder::RayFolder(const physics::Profile& profile, const physics::Optics& optics, const Effort& effort)
    : profile_(profile), effort_(effort), species_(optics.species), wavelengths_(optics.wavelengths),
      blocks_(blocksFor(optics.wavelengths)), scatterers_(optics.scatterers)
{
    const auto& shells = profile.shells();
    const std::size_t intervals = shells.size() - 1;
    std::vector<double> low(species_), high(species_), largest(species_, 0.), ends;
    for (std::size_t k = 0; k < intervals; ++k) {
        profile.densities(static_cast<int>(k), shells[k], low.data());
        profile.densities(static_cast<int>(k), shells[k + 1], high.data());
        ends.insert(ends.end(), low.begin(), low.end());
        ends.insert(ends.end(), high.begin(), high.end());
        for (int s = 0; s < species_; ++s)
            largest[s] = std::max({largest[s], low[s], high[s]});
    }
    for (double& density : largest)
        density = density > 0 ? density : 1;
    for (int s = 0; s < species_; ++s) {
        const auto row = toBlocks(&optics.extinction[s * optics.wavelengths], 1, optics.wavelengths, largest[s]);
        extinctions_.insert(extinctions_.end(), row.begin(), row.end());
    }
    for (const int s : scatterers_) {
        const auto row = toBlocks(&optics.scattering[s * optics.wavelengths], 1, optics.wavelengths, largest[s]);
        scatterings_.insert(scatterings_.end(), row.begin(), row.end());
    }
    for (std::size_t k = 0; k < intervals; ++k) {
        double below = 0, above = 0;
        for (int s = 0; s < species_; ++s) {
            const double a = ends[2 * k * species_ + s] / largest[s], b = ends[(2 * k + 1) * species_ + s] / largest[s];
            const bool logarithmic = profile.logarithmic(static_cast<int>(k), s);
            const double start = logarithmic ? std::log(a) : a, end = logarithmic ? std::log(b) : b;
            segments_.push_back({start, (end - start) / (shells[k + 1] - shells[k]), logarithmic ? 1.f : 0.f});
            const auto sigma = optics.extinction.begin() + s * optics.wavelengths;
            const double most = largest[s] * *std::max_element(sigma, sigma + optics.wavelengths);
            below += a * most;
            above += b * most;
        }
        const bool exponential = below > 0 && above > 0;
        extinction_.push_back(
            {exponential ? below : std::max(below, above), exponential ? std::log(above / below) / (shells[k + 1] - shells[k]) : 0});
    }
}

/// Cuts the ray at the shells of the profile, and between them into cells.
void RayFolder::walk(FastRay& ray) const
{
    const auto& p = profile_.planet();
    const auto& shells = profile_.shells();
    const double h = ray.altitude, mu = ray.mu;
    const double length = ray.hitsGround ? physics::distanceToGround(p, h, mu) : physics::distanceToTop(p, h, mu);
    ray.bounds.assign(1, 0);
    ray.heights.assign(1, h);
    ray.intervals.clear();
    const auto add = [&](int interval, double to, double height) {
        const double from = ray.bounds.back();
        to = std::min(to, length);
        if (!(to > from))
            return;
        const auto extinctionAt = [&e = extinction_[interval], bottom = shells[interval]](double at) {
            return e.slope != 0 ? e.low * std::exp(e.slope * (at - bottom)) : e.low;
        };
        const double before = ray.heights.back();
        const physics::CellDivision division =
            physics::divided({from, to, length, profile_.steepness(interval) * std::abs(height - before),
                              extinctionAt(0.5 * (before + height)) * (to - from), extinctionAt(before) * (to - from)},
                             effort_.cell);
        const int cells = division.count();
        for (int c = 1; c <= cells; ++c) {
            const double s = c == cells ? to : division.end(c);
            ray.bounds.push_back(s);
            ray.heights.push_back(c == cells ? height : physics::altitudeAlong(p, h, mu, s));
            ray.intervals.push_back(interval);
        }
    };
    int k = profile_.intervalAt(h);
    if (mu < 0) {
        const double perigee = -(p.radius + h) * mu, lowest = physics::altitudeAlong(p, h, mu, perigee);
        for (; k > 0 && (ray.hitsGround || shells[k] > lowest); --k)
            add(k, physics::distanceToShell(p, h, mu, shells[k], true), shells[k]);
        add(k, ray.hitsGround ? length : perigee, ray.hitsGround ? 0 : lowest);
    }
    if (!ray.hitsGround)
        for (; k + 1 < static_cast<int>(shells.size()); ++k)
            add(k, physics::distanceToShell(p, h, mu, shells[k + 1], false), shells[k + 1]);
    ray.cells = static_cast<int>(ray.intervals.size());
}

/// Columns of each species in each cell, from the densities at two points of Gauss.
void RayFolder::findColumns(FastRay& ray) const
{
    const auto& p = profile_.planet();
    const auto& shells = profile_.shells();
    const std::size_t steps = static_cast<std::size_t>(ray.cells * 2 * species_ + count - 1) / count;
    for (auto* blocks : {&ray.arguments, &ray.logarithmic, &ray.densities})
        blocks->resize(steps, Block{all(0)});
    // Within a cell altitude is a parabola: h'' = (r sin)^2 / r'^3, whose numerator all points of the ray share.
    const double r = p.radius + ray.altitude, sine = r * r * (1 - ray.mu * ray.mu);
    constexpr double gauss = 0.21132486540518712;
    float *argument = floats(ray.arguments), *logarithmic = floats(ray.logarithmic);
    for (int c = 0; c < ray.cells; ++c) {
        const double ds = ray.bounds[c + 1] - ray.bounds[c], h0 = ray.heights[c], h1 = ray.heights[c + 1];
        const double rCell = p.radius + 0.5 * (h0 + h1), sag = 0.5 * gauss * (1 - gauss) * ds * ds * sine / (rCell * rCell * rCell);
        const double first = h0 + gauss * (h1 - h0) - sag, second = h1 - gauss * (h1 - h0) - sag;
        const int interval = ray.intervals[c];
        for (const double height : {first, second})
            for (int s = 0; s < species_; ++s) {
                const Segment& segment = segments_[interval * species_ + s];
                *argument++ = static_cast<float>(segment.start + segment.slope * (height - shells[interval]));
                *logarithmic++ = segment.logarithmic;
            }
    }
    foldDensities(static_cast<int>(steps), ray.arguments.data(), ray.logarithmic.data(), ray.densities.data());
    ray.columns.resize(ray.cells * species_);
    ray.centres.resize(ray.cells * species_);
    const float* density = floats(ray.densities);
    for (int c = 0; c < ray.cells; ++c, density += 2 * species_) {
        const float half = static_cast<float>(0.5 * (ray.bounds[c + 1] - ray.bounds[c]));
        for (int s = 0; s < species_; ++s) {
            const float both = density[s] + density[species_ + s];
            ray.columns[c * species_ + s] = half * both;
            ray.centres[c * species_ + s] = 0.5f + (both > 0 ? 0.28867513f * (density[species_ + s] - density[s]) / both : 0.f);
        }
    }
}

void RayFolder::placeNodes(FastRay& ray, const int nodes, const physics::NodeMeasure& measure, NodeSet& set) const
{
    physics::placeNodes(ray.bounds, ray.shares, measure, nodes, ray.measured, ray.position);
    set.altitudes.resize(nodes);
    for (auto* numbers : {&set.sunScales, &set.nuScales, &set.mu})
        numbers->resize(nodes);
    findNodes(profile_.planet(), ray, set);
    set.weights.resize(static_cast<std::size_t>(nodes) * scatterers_.size() * blocks_, Block{all(0)});
    physics::cutAtNodes(ray.bounds, ray.position, ray.parts);
}

void RayFolder::trace(const double altitude, const double mu, FastRay& ray) const
{
    if (ray.altitude == altitude && ray.mu == mu)
        return;
    const auto& p = profile_.planet();
    ray.altitude = altitude;
    ray.mu = mu;
    ray.hitsGround = physics::hitsGround(p, altitude, mu);
    walk(ray);
    findColumns(ray);
    ray.lit.resize(static_cast<std::size_t>(ray.cells) * scatterers() * blocks_);
    ray.transmittance.resize(blocks_, Block{all(0)});
    ray.light.resize(ray.cells);
    ray.depth.resize(ray.cells);
    ray.shares.resize(ray.cells);
    const CellLoop loop{ray.cells,
                        species_,
                        scatterers(),
                        blocks_,
                        ray.columns.data(),
                        scatterers_.data(),
                        extinctions_.data(),
                        scatterings_.data(),
                        ray.centres.data(),
                        ray.lit.data(),
                        ray.transmittance.data(),
                        ray.light.data(),
                        ray.depth.data()};
    foldCells(loop);

    const auto& shells = profile_.shells();
    double from = physics::horizonDistance(p, altitude);
    for (int c = 0; c < ray.cells; ++c) {
        const double to = physics::horizonDistance(p, ray.heights[c + 1]), way = ray.bounds[c + 1] - ray.bounds[c];
        const double slant = way > 0 ? std::abs(ray.heights[c + 1] - ray.heights[c]) / way : 0;
        const double depth = double(ray.depth[c]) / wavelengths_, climb = std::abs(ray.heights[c + 1] - ray.heights[c]);
        const int interval = ray.intervals[c];
        const double halvings = profile_.halvings(interval) * climb / (shells[interval + 1] - shells[interval]);
        ray.shares[c] = {double(ray.light[c]), std::abs(to - from), way, depth * slant, halvings, depth};
        from = to;
    }
    const physics::NodeShares whole = physics::weighedAsSeen(ray.shares);
    const auto place = [&](int nodes, physics::NodesFor nodesFor, NodeSet& set) {
        placeNodes(ray, nodes, physics::NodeMeasure(whole, nodesFor), set);
        foldWeights(loop, ray.parts, nodes, set.weights.data());
    };
    place(effort_.singleNodes, physics::NodesFor::Sunlight, ray.single);
    place(effort_.multipleNodes, physics::NodesFor::Field, ray.multiple);
    ++ray.version;
}

} // namespace showmysky
