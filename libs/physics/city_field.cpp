#include "base/angles.hpp"
#include "base/lanes.hpp"
#include "base/not_negative.hpp"
#include "base/parallel.hpp"
#include "physics/city.hpp"
#include "physics/directions.hpp"
#include "physics/harmonics.hpp"
#include "physics/quadrature.hpp"
#include "physics/series.hpp"
#include "physics/table_axes.hpp"
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

/// Nodes of a ray: about the place nearest to the city, and where the light that is seen comes from.
constexpr int viewNearNodes = 18, fieldNearNodes = 10, fieldFarNodes = 8;
/// Nodes about the place where a ray passes low over the edge of the disc: lower than this share of the disc's radius; m, lower still counts as that.
constexpr int edgeNodes = 8;
constexpr double lowOverEdge = 0.3, lowestOverEdge = 10;
constexpr int levels = 12, anglesOfField = 22, azimuthsOfField = 6, fewestEvents = 3, mostEvents = 8;
constexpr double tolerance = 0.02; // relative change of the closed series, where the field is bright, at which events end
constexpr double faintest = 1e-3;  // part of the brightest light below which that is not asked
constexpr float darkLog2 = -100.F; // of a radiance that is told from darkness

/// A point of a ray.
struct Node {
    double altitude, fromCity, mu, cosine, sine; // as CityAir::scattered() wants them
};

Node nodeAt(const Planet& p, const CityView& view, double s)
{
    const double r0 = p.radius + view.altitude, altitude = altitudeAlong(p, view.altitude, view.mu, s), r = p.radius + altitude;
    const double axis = std::clamp((r0 * std::cos(view.fromCity) + s * view.alongAxis) / r, -1., 1.);
    const double mu = std::clamp((r0 * view.mu + s) / r, -1., 1.), sineAngle = std::sqrt(1 - axis * axis), flat = std::sqrt(1 - mu * mu);
    const double cosine = sineAngle > 1e-9 ? std::clamp((view.alongAxis - mu * axis) / sineAngle, -flat, flat) : flat;
    return {altitude, std::acos(axis), mu, cosine, std::sqrt(std::max(0., flat * flat - cosine * cosine))};
}

/// Memory of one thread.
struct Scratch {
    CityAir::Scratch air;
    std::vector<double> nodes, seen, seenBefore;
    std::vector<float> here, before, moments, factors;
    std::vector<double> harmonics;
};

/// Distances of the nodes of a ray in increasing order: the ray's own, and some about the place nearest to the city, where its light is
/// strong.
void findNodes(const CityAir& air, double discRadius, const CityView& view, const CityColumns& ray, int near, std::vector<double>& nodes)
{
    nodes = ray.nodes;
    if (nodes.empty())
        return;
    const double R = air.profile().planet().radius, r0 = R + view.altitude, length = nodes.back(), half = std::sin(0.5 * view.fromCity);
    // Square of the distance to the middle of the city: s^2 - 2 closest s + start.
    const double closest = R * view.alongAxis - r0 * view.mu, start = view.altitude * view.altitude + 4 * R * r0 * half * half;
    const double middle = std::clamp(closest, 0., length);
    // Light varies over the distance to the edge.
    const double edge = std::sqrt(std::max(0., middle * (middle - 2 * closest) + start)) - discRadius * R;
    const double width = std::max({edge, 0.15 * discRadius * R, 30.});
    const double from = std::asinh(-middle / width), to = std::asinh((length - middle) / width);
    for (int k = 0; k < near; ++k)
        nodes.push_back(std::clamp(middle + width * std::sinh(from + (to - from) * (k + 0.5) / near), 0., length));
    // Low above the edge light ends within about the altitude.
    const double disc = discRadius * R, root = closest * closest - start + disc * disc;
    for (const double side : {-1., 1.}) {
        const double crossing = closest + side * std::sqrt(std::max(0., root));
        if (root <= 0 || crossing < 0 || crossing > length)
            continue;
        const double altitude = std::max(lowestOverEdge, altitudeAlong(air.profile().planet(), view.altitude, view.mu, crossing));
        if (altitude > lowOverEdge * disc)
            continue;
        const double spread = std::asinh(disc / altitude);
        for (int k = 0; k < edgeNodes; ++k)
            nodes.push_back(std::clamp(crossing + altitude * std::sinh(spread * (2 * (k + 0.5) / edgeNodes - 1)), 0., length));
    }
    std::sort(nodes.begin(), nodes.end());
}

/// The integral of a source function over what is seen of the air: between scratch.nodes by Simpson's rule with the
/// geometric mean in the middle, right for sources that fall off like powers or exponentials.
///   source  fills [scatterer][stride] for a Node
///   result  [stride], added to
template<class Source>
void integrate(const CityAir& air, const CityView& view, const SeenColumns& columns, Scratch& scratch, Source&& source, float* result)
{
    auto& [unused, nodes, seen, seenBefore, here, before, moments, factors, harmonics] = scratch;
    if (nodes.empty() || air.scatterers() == 0)
        return;
    const int scatterers = air.scatterers(), wavelengths = air.optics().wavelengths, stride = air.stride();
    const size_t cells = columns.distances.size() - 1, count = size_t(scatterers) * wavelengths;
    here.resize(size_t(scatterers) * stride);
    before.resize(here.size());
    seen.resize(count);
    seenBefore.resize(count);
    size_t c = 0;
    for (size_t k = 0; k < nodes.size(); ++k) {
        while (c + 1 < cells && columns.distances[c + 1] < nodes[k])
            ++c;
        const double length = columns.distances[c + 1] - columns.distances[c];
        const double x = length > 0 ? std::clamp((nodes[k] - columns.distances[c]) / length, 0., 1.) : 0.;
        const double* near = &columns.seen[c * count];
        for (size_t i = 0; i < count; ++i)
            seen[i] = near[i] + x * (near[count + i] - near[i]);
        source(nodeAt(air.profile().planet(), view, nodes[k]), here.data());
        if (k > 0)
            for (int i = 0; i < scatterers; ++i)
                for (int w = 0; w < wavelengths; ++w) {
                    const float a = before[i * stride + w], b = here[i * stride + w];
                    result[w] += (a + b + 4 * std::sqrt(std::max(0.F, a * b))) / 6 *
                                 static_cast<float>(seen[i * wavelengths + w] - seenBefore[i * wavelengths + w]);
                }
        std::swap(before, here);
        std::swap(seenBefore, seen);
    }
}

/// Adds what a field scatters into the ray at a node.
void addScattered(const CityAir& air, const CityField& field, const Node& node, Scratch& scratch, float* result)
{
    const int degree = air.optics().degree, harmonics = harmonicCount(degree);
    scratch.moments.resize(size_t(harmonics) * air.stride());
    scratch.harmonics.resize(harmonics);
    scratch.factors.resize(harmonics);
    field.interpolate(node.altitude, node.fromCity, scratch.moments.data());
    harmonicFactors(degree, node.mu, scratch.harmonics.data());
    const double flat = std::hypot(node.cosine, node.sine), cosine = flat > 1e-12 ? node.cosine / flat : 1;
    double wave = 1, previous = cosine; // cos(m phi)
    for (int m = 0; m <= degree; ++m) {
        for (int l = m; l <= degree; ++l)
            scratch.factors[harmonicIndex(l, m)] = static_cast<float>(scratch.harmonics[harmonicIndex(l, m)] * wave);
        const double next = 2 * cosine * wave - previous;
        previous = wave;
        wave = next;
    }
    air.addHarmonics(scratch.moments.data(), scratch.factors.data(), scratch.air, result);
}

SKY_WIDEST_VECTORS
void interpolateLevels(const float* const corners[4], const float weights[4], int harmonics, int stride, float* __restrict result)
{
    const float *a = corners[0], *b = corners[1], *c = corners[2], *d = corners[3];
    for (int k = 0; k < harmonics * stride; ++k)
        result[k] = weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k] + weights[3] * d[k];
    for (int w = 0; w < stride; ++w)
        result[w] = base::exp2Lane(result[w]);
    for (int lm = 1; lm < harmonics; ++lm)
        for (int w = 0; w < stride; ++w)
            result[lm * stride + w] *= result[w];
}

/// In place: [lm][stride] of moments to log2 I_00 and ratios.
void toLogRatios(float* values, int harmonics, int stride)
{
    for (int w = 0; w < stride; ++w) {
        const float whole = values[w], smallest = std::exp2(darkLog2);
        for (int lm = 1; lm < harmonics; ++lm)
            values[lm * stride + w] = whole > smallest ? values[lm * stride + w] / whole : 0.F;
        values[w] = whole > smallest ? std::log2(whole) : darkLog2;
    }
}

} // namespace

CityColumns::CityColumns(RayTracer& tracer, const double altitude, const double mu, const bool hitsGround, const int count)
    : columns(tracer.seen(altitude, mu, hitsGround))
{
    if (columns.distances.size() < 2)
        return;
    // Equal steps of light seen, summed over wavelengths, and of length.
    const size_t cells = columns.distances.size() - 1, channels = columns.seen.size() / (cells + 1);
    const double length = columns.distances.back();
    std::vector<double> measure(cells + 1, 0.);
    for (size_t c = 0; c <= cells; ++c)
        for (size_t i = 0; i < channels; ++i)
            measure[c] += columns.seen[c * channels + i];
    const double whole = std::max(measure.back(), 1e-300);
    for (size_t c = 0; c <= cells; ++c)
        measure[c] = 0.8 * measure[c] / whole + 0.2 * columns.distances[c] / length;
    nodes.push_back(0);
    for (int k = 1; k + 1 < count; ++k) {
        const double target = measure.back() * k / (count - 1);
        const size_t c = std::clamp<size_t>(std::upper_bound(measure.begin(), measure.end(), target) - measure.begin(), 1, cells);
        const double x = std::clamp((target - measure[c - 1]) / std::max(1e-300, measure[c] - measure[c - 1]), 0., 1.);
        nodes.push_back(columns.distances[c - 1] + x * (columns.distances[c] - columns.distances[c - 1]));
    }
    nodes.push_back(length);
}

double CityField::position(const double fromCity) const
{
    return std::clamp(std::asinh(fromCity / scale_) / std::asinh(farthest_ / scale_), 0., 1.) * (angles_ - 1);
}

double CityField::angleAt(const int node) const { return scale_ * std::sinh(std::asinh(farthest_ / scale_) * node / (angles_ - 1)); }

void CityField::interpolate(const double altitude, const double fromCity, float* const result) const
{
    const double measure = horizonDistance(air_.profile().planet(), altitude);
    const auto above = std::upper_bound(measures_.begin(), measures_.end(), measure) - measures_.begin();
    const auto a = std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(measures_.size()) - 1) - 1;
    const float y = static_cast<float>(std::clamp((measure - measures_[a]) / (measures_[a + 1] - measures_[a]), 0., 1.));
    const double t = position(fromCity);
    const int j = std::min(static_cast<int>(t), angles_ - 2);
    const float x = static_cast<float>(t - j);
    const size_t step = size_t(harmonics_) * stride_;
    const float* low = &values_[(size_t(a) * angles_ + j) * step];
    const float* high = low + angles_ * step;
    const float* corners[4] = {low, low + step, high, high + step};
    const float weights[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    interpolateLevels(corners, weights, harmonics_, stride_, result);
}

void CityField::groundIrradiance(const double fromCity, float* const result) const
{
    const double t = position(fromCity);
    const int j = std::min(static_cast<int>(t), angles_ - 2);
    const float x = static_cast<float>(t - j);
    for (int w = 0; w < stride_; ++w)
        result[w] = base::exp2Lane((1 - x) * ground_[j * stride_ + w] + x * ground_[(j + 1) * stride_ + w]);
}

CityField::CityField(const CityAir& air, const double discRadius, const base::StopRequest& stop)
    : air_(air), discRadius_(discRadius), stride_(air.stride()), harmonics_(harmonicCount(air.optics().degree)), angles_(anglesOfField)
{
    const auto& profile = air.profile();
    const auto& p = profile.planet();
    const auto& optics = air.optics();
    const int wavelengths = optics.wavelengths;
    // Twice the horizon of the altitude below which nearly all of the air is.
    double top = p.topOfAtmosphere;
    {
        RayTracer tracer(profile, optics, 2);
        const auto up = tracer.seen(0, 1, false);
        const size_t count = up.seen.size() / up.distances.size();
        for (size_t c = 0; c + 1 < up.distances.size(); ++c) {
            bool most = true;
            for (size_t i = 0; i < count; ++i)
                most = most && up.seen[c * count + i] >= 0.995 * up.seen[up.seen.size() - count + i];
            if (most) {
                top = std::max(up.distances[c], 1e-3 * p.topOfAtmosphere);
                break;
            }
        }
    }
    farthest_ = std::clamp(-2 * horizonElevation(p, top) + discRadius, 1e-6, 3.);
    scale_ = std::max(discRadius, std::min(0.02 * farthest_, 0.2 * top / p.radius));
    altitudes_ = altitudeNodes(p, levels);
    for (const double h : altitudes_)
        measures_.push_back(horizonDistance(p, h));

    MomentSettings settings;
    settings.groundDirections = 4;
    settings.limbDirections = 2;
    settings.skyDirections = 6;
    std::vector<Directions> directions;
    std::vector<std::vector<CityColumns>> columns(levels);
    for (const double h : altitudes_)
        directions.push_back(directionsAt(p, h, settings));
    base::parallel([&](int thread, int threads) {
        RayTracer tracer(profile, optics, 2);
        for (int a = thread; a < levels; a += threads) {
            base::stopIfAsked(stop);
            for (size_t d = 0; d < directions[a].mu.size(); ++d)
                columns[a].emplace_back(tracer, altitudes_[a], directions[a].mu[d], directions[a].hitsGround[d], fieldFarNodes);
        }
    });
    const auto azimuths = gaussLegendre(azimuthsOfField, 0, 1); // phi = pi x^2: close where the city is

    const size_t step = size_t(harmonics_) * stride_, points = size_t(levels) * angles_;
    GeometricSeries<float> light(harmonics_, stride_), irradiance(1, stride_);
    // In logarithms, for the next event to scatter.
    const auto keep = [&](std::vector<float> field, std::vector<float> ground) {
        for (size_t point = 0; point < points; ++point)
            toLogRatios(&field[point * step], harmonics_, stride_);
        for (float& e : ground)
            e = e > std::exp2(darkLog2) ? std::log2(e) : darkLog2;
        values_ = std::move(field);
        ground_ = std::move(ground);
    };
    for (int event = 1; event <= mostEvents; ++event) {
        std::vector<float> last(points * step, 0.F), lastGround(size_t(angles_) * stride_, 0.F);
        base::parallel([&](int thread, int threads) {
            Scratch scratch;
            std::vector<float> radiance(stride_), ground(stride_);
            std::vector<double> factors(harmonics_);
            for (size_t point = thread; point < points; point += threads) {
                base::stopIfAsked(stop);
                const int a = static_cast<int>(point) / angles_, j = static_cast<int>(point) % angles_;
                const double angle = angleAt(j);
                float* const sums = &last[point * step];
                for (size_t d = 0; d < directions[a].mu.size(); ++d) {
                    const double mu = directions[a].mu[d], flat = std::sqrt(1 - mu * mu);
                    const CityColumns& ray = columns[a][d];
                    harmonicFactors(optics.degree, mu, factors.data());
                    for (int k = 0; k < azimuthsOfField; ++k) {
                        const double x = azimuths.nodes[k], phi = pi * x * x;
                        const CityView view{altitudes_[a], mu, angle, mu * std::cos(angle) + flat * std::cos(phi) * std::sin(angle),
                                            directions[a].hitsGround[d]};
                        std::fill(radiance.begin(), radiance.end(), 0.F);
                        findNodes(air, discRadius, view, ray, fieldNearNodes, scratch.nodes);
                        integrate(
                            air, view, ray.columns, scratch,
                            [&](const Node& n, float* source) {
                                if (event == 1) {
                                    air.scattered(n.altitude, n.fromCity, discRadius, n.mu, n.cosine, n.sine, scratch.air, source);
                                    return;
                                }
                                std::fill(source, source + air.scatterers() * stride_, 0.F);
                                addScattered(air, *this, n, scratch, source);
                            },
                            radiance.data());
                        if (event > 1 && view.hitsGround) {
                            groundIrradiance(nodeAt(p, view, ray.columns.distances.back()).fromCity, ground.data());
                            for (int w = 0; w < wavelengths; ++w)
                                radiance[w] +=
                                    static_cast<float>(ray.columns.groundTransmittance[w] * air.medium().groundAlbedo[w] / pi) * ground[w];
                        }
                        // Both sides of the plane through the city.
                        const double solidAngle = directions[a].weight[d] * 2 * azimuths.weights[k] * 2 * pi * x;
                        for (int l = 0; l <= optics.degree; ++l)
                            for (int m = 0; m <= l; ++m) {
                                const float y = static_cast<float>(solidAngle * factors[harmonicIndex(l, m)] * std::cos(m * phi));
                                for (int w = 0; w < stride_; ++w)
                                    sums[harmonicIndex(l, m) * stride_ + w] += y * radiance[w];
                            }
                        if (a == 0 && mu > 0)
                            for (int w = 0; w < stride_; ++w)
                                lastGround[j * stride_ + w] += static_cast<float>(solidAngle * mu) * radiance[w];
                    }
                }
            }
        });
        for (float& e : lastGround)
            e = std::max(e, 0.F);
        light.add(std::move(last));
        irradiance.add(std::move(lastGround));
        events_ = event;
        if (event >= fewestEvents && light.change(faintest) < tolerance)
            break;
        keep(light.last(), irradiance.last());
    }
    keep(light.whole(), irradiance.whole());
}

void cityRadiance(const CityAir& air, const CityField* const field, const double discRadius, const CityView& view, const CityColumns& ray,
                  const bool direct, double* const result)
{
    const int stride = air.stride(), wavelengths = air.optics().wavelengths;
    Scratch scratch;
    std::vector<float> radiance(stride, 0.F);
    findNodes(air, discRadius, view, ray, viewNearNodes, scratch.nodes);
    integrate(
        air, view, ray.columns, scratch,
        [&](const Node& n, float* source) {
            air.scattered(n.altitude, n.fromCity, discRadius, n.mu, n.cosine, n.sine, scratch.air, source);
            if (field)
                addScattered(air, *field, n, scratch, source);
        },
        radiance.data());
    for (int w = 0; w < wavelengths; ++w)
        result[w] = base::notNegative(double(radiance[w]));
    if (!view.hitsGround)
        return;
    const double there = nodeAt(air.profile().planet(), view, ray.columns.distances.back()).fromCity;
    std::vector<float> ground(stride, 0.F);
    if (field)
        field->groundIrradiance(there, ground.data());
    for (int w = 0; w < wavelengths; ++w)
        result[w] += ray.columns.groundTransmittance[w] *
                     (air.medium().groundAlbedo[w] / pi * double(ground[w]) + (direct && there <= discRadius ? 1 : 0));
}

} // namespace sky::physics
