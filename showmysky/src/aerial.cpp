#include "aerial.hpp"

#include "aerial_axis.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/shadow_edge.hpp"
#include "physics/sky.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::pi;
constexpr float faintest = 1e-30f; // told from no light
/// Parts of the interval between two distances, each with sunlight of its own.
constexpr int singleParts = 2;
/// Air darker than this is faintest.
constexpr double mostDepth = 80;

AerialSpacing spacingOf(const physics::Planet& planet, double altitude, bool ground)
{
    return ground ? AerialSpacing::bothEnds : altitude > planet.topOfAtmosphere ? AerialSpacing::even : AerialSpacing::fromCamera;
}

/// SeenColumns at one distance: within a cell the air is taken as uniform.
struct Seen {
    std::vector<double> columns;       ///< [scatterer][wavelength]
    std::vector<double> transmittance; ///< [wavelength]
};

Seen seenUpTo(const physics::SeenColumns& all, double distance, std::size_t scatterers, std::size_t wavelengths)
{
    Seen result{std::vector<double>(scatterers * wavelengths, 0.), std::vector<double>(wavelengths, 1.)};
    if (all.distances.size() < 2)
        return result;
    const auto after = std::upper_bound(all.distances.begin(), all.distances.end(), distance);
    const auto last = static_cast<std::ptrdiff_t>(all.distances.size()) - 2;
    const auto cell = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - all.distances.begin() - 1, 0, last));
    const double x = std::clamp((distance - all.distances[cell]) / (all.distances[cell + 1] - all.distances[cell]), 0., 1.);
    for (std::size_t w = 0; w < wavelengths; ++w) {
        const double before = all.transmittance[cell * wavelengths + w], behind = all.transmittance[(cell + 1) * wavelengths + w];
        const double depth = before > 0 && behind > 0 ? std::log(before / behind) : mostDepth;
        const double share = depth > 1e-9 ? std::expm1(-depth * x) / std::expm1(-depth) : x;
        result.transmittance[w] = before * std::exp(-depth * x);
        for (std::size_t i = 0; i < scatterers; ++i) {
            const std::size_t near = (cell * scatterers + i) * wavelengths + w, far = near + scatterers * wavelengths;
            result.columns[i * wavelengths + w] = all.seen[near] + share * (all.seen[far] - all.seen[near]);
        }
    }
    return result;
}

} // namespace

Aerial::Aerial(const Atmosphere& atmosphere, const Phases& phases, const physics::Moments* moments, const physics::SunTable& sun)
    : atmosphere_(atmosphere), phases_(phases), moments_(moments), sun_(sun)
{
}

void Aerial::set(AerialScene scene)
{
    scene_ = std::move(scene);
    sines_ = viewSines(atmosphere_.planet(), scene_.altitude, halfViews);
    texels_.assign(static_cast<std::size_t>(tables(atmosphere_.scatterers()) * distances * 2 * halfViews * columns()), Texel{});
    done_ = 0;
}

bool Aerial::step(int lines)
{
    const int end = std::min(2 * halfViews, done_ + lines), first = done_;
    std::vector<Line> traced(static_cast<std::size_t>(end - first));
    sky::base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(atmosphere_.profile, atmosphere_.optics, 0.25);
        for (int view = first + thread; view < end; view += threads)
            traced[static_cast<std::size_t>(view - first)] = trace(view, tracer);
    });
    std::vector<float> shares;
    std::vector<std::size_t> firstShare; // [line]
    if (scene_.eclipse && scene_.eclipse->higherOrders) {
        std::vector<physics::RayNodes> nodesOf;
        std::size_t nodes = 0;
        for (const Line& line : traced) {
            firstShare.push_back(nodes * static_cast<std::size_t>(columns() * atmosphere_.wavelengths()));
            nodes += line.multiple.nodes.size();
            nodesOf.push_back(line.multiple);
        }
        std::vector<double> relative;
        for (int a = 0; a < columns(); ++a)
            relative.push_back(relativeAzimuth(a));
        shares = scene_.eclipse->higherOrders(nodesOf, {sines_.begin() + first, sines_.begin() + end}, relative);
    }
    sky::base::parallel([&](int thread, int threads) {
        for (int view = first + thread; view < end; view += threads) {
            const auto i = static_cast<std::size_t>(view - first);
            if (!traced[i].multiple.nodes.empty())
                growLight(view, traced[i], shares.empty() ? nullptr : &shares[firstShare[i]]);
        }
    });
    done_ = end;
    return done_ == 2 * halfViews;
}

Texel& Aerial::at(int table, int distance, int view, int column)
{
    return texels_[static_cast<std::size_t>(((table * distances + distance) * 2 * halfViews + view) * columns() + column)];
}

Texel Aerial::luminance(const std::vector<double>& radiance) const
{
    Texel sum{};
    for (std::size_t w = 0; w < scene_.weights.size(); ++w)
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += scene_.weights[w][c] * static_cast<float>(std::max(0., radiance[w]));
    return sum;
}

double Aerial::relativeAzimuth(int column) const { return pi * (scene_.eclipse ? column - (azimuths - 1) : column) / (azimuths - 1); }

physics::RayNodes Aerial::nodes(const physics::SeenColumns& seen, const physics::AirEntry& entry, bool ground, int parts) const
{
    const auto& planet = atmosphere_.planet();
    const auto scatterers = static_cast<std::size_t>(atmosphere_.scatterers());
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    const auto spacing = spacingOf(planet, scene_.altitude, ground);
    const double radius = planet.radius + entry.altitude, length = seen.distances.back();
    physics::RayNodes result;
    std::vector<double> before(scatterers * wavelengths, 0.);
    double from = 0;
    for (int k = 1; k < distances; ++k)
        for (int part = 1; part <= parts; ++part) {
            const double near = aerialDistance(double(k - 1) / (distances - 1), length, spacing);
            const double far = aerialDistance(double(k) / (distances - 1), length, spacing);
            const double to = near + (far - near) * part / parts, s = 0.5 * (from + to);
            const double h = physics::altitudeAlong(planet, entry.altitude, entry.mu, s), there = planet.radius + h;
            result.nodes.push_back(entry.node({h, radius / there, s / there, std::clamp((radius * entry.mu + s) / there, -1., 1.)}));
            const auto upTo = seenUpTo(seen, to, scatterers, wavelengths).columns;
            for (std::size_t i = 0; i < upTo.size(); ++i)
                result.weights.push_back(upTo[i] - before[i]);
            before = upTo;
            from = to;
        }
    return result;
}

Aerial::Line Aerial::trace(int view, physics::RayTracer& tracer)
{
    const auto& planet = atmosphere_.planet();
    const double mu = sines_[static_cast<std::size_t>(view)];
    const bool ground = view >= halfViews;
    const auto entry = enterAir(planet, scene_.altitude, mu);
    Line result;
    if (!entry)
        return result;
    const auto scatterers = static_cast<std::size_t>(atmosphere_.scatterers());
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    const auto seen = tracer.seen(entry->altitude, entry->mu, ground);
    const double length = seen.distances.back();
    const auto spacing = spacingOf(planet, scene_.altitude, ground);
    const Texel white = luminance(std::vector<double>(wavelengths, 1.));
    auto& columnShares = result.columnShares;
    for (int k = 0; k < distances; ++k) {
        const Seen upTo = seenUpTo(seen, aerialDistance(double(k) / (distances - 1), length, spacing), scatterers, wavelengths);
        const Texel through = luminance(upTo.transmittance);
        std::vector<double> all(wavelengths, 0.);
        for (std::size_t i = 0; i < scatterers; ++i)
            for (std::size_t w = 0; w < wavelengths; ++w)
                all[w] += upTo.columns[i * wavelengths + w];
        columnShares.push_back(luminance(all));
        Texel depth{};
        for (std::size_t c = 0; c < 4; ++c)
            depth[c] = through[c] > faintest * white[c] ? -std::log(through[c] / white[c]) : static_cast<float>(mostDepth);
        for (int a = 0; a < columns(); ++a)
            at(atmosphere_.scatterers() + 1, k, view, a) = depth;
    }
    for (Texel& share : columnShares)
        for (std::size_t c = 0; c < 4; ++c)
            share[c] = columnShares.back()[c] > faintest ? share[c] / columnShares.back()[c] : 1.f;
    result.single = nodes(seen, *entry, ground, singleParts);
    result.multiple = nodes(seen, *entry, ground, 1);
    return result;
}

void Aerial::growLight(int view, const Line& line, const float* shares)
{
    const auto& single = line.single;
    const auto& multiple = line.multiple;
    const auto& columnShares = line.columnShares;
    const auto scatterers = static_cast<std::size_t>(atmosphere_.scatterers());
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    const auto& optics = atmosphere_.optics;
    const physics::SkyEvaluator evaluator(atmosphere_.medium, atmosphere_.profile, optics, sun_);
    const double mu = sines_[static_cast<std::size_t>(view)], muSun = scene_.muSun;
    const double sines = std::sqrt(std::max(0., (1 - mu * mu) * (1 - muSun * muSun)));
    const std::size_t stride = scatterers * wavelengths;
    std::vector<double> light(wavelengths), ratio(wavelengths), part(wavelengths);
    std::vector<Texel> grown(distances);
    // Shares of the last of `grown`, or of more than it.
    const auto store = [&](int table, int column, const Texel& total) {
        for (int k = 0; k < distances; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                at(table, k, view, column)[c] = total[c] > faintest ? std::clamp(grown[static_cast<std::size_t>(k)][c] / total[c], 0.f, 1.f)
                                                                    : columnShares[static_cast<std::size_t>(k)][c];
    };
    const double flat = std::sqrt(std::max(0., 1 - mu * mu));
    for (int a = 0; a < columns(); ++a) {
        const double relative = relativeAzimuth(a), nu = std::clamp(mu * muSun + sines * std::cos(relative), -1., 1.);
        const double azimuth = (scene_.eclipse ? scene_.eclipse->sunAzimuth : 0) + relative;
        const std::array<double, 3> direction{flat * std::cos(azimuth), flat * std::sin(azimuth), mu};
        std::vector<double> lit(stride, 0.);
        std::vector<std::vector<Texel>> singles(scatterers, std::vector<Texel>(distances, Texel{}));
        std::vector<std::vector<double>> ratios(scatterers, std::vector<double>(wavelengths));
        for (std::size_t i = 0; i < scatterers; ++i) {
            phases_.ratio(static_cast<int>(i), nu, ratios[i].data());
            for (std::size_t w = 0; w < wavelengths; ++w)
                ratios[i][w] /= 1 - optics.truncation[static_cast<std::size_t>(optics.scatterers[i]) * wavelengths + w];
        }
        const auto visible = physics::visibleAlong(sun_, single, muSun, nu, atmosphere_.medium.sunAngularRadius);
        for (std::size_t n = 0; n < single.nodes.size(); ++n) {
            const auto& node = single.nodes[n];
            const SunSeen seen = scene_.eclipse ? scene_.eclipse->sun(direction, node) : SunSeen{1, {}};
            sun_.opticalDepth(node.altitude, std::clamp(node.sunScale * muSun + node.nuScale * nu, -1., 1.), light.data(),
                              seen.middle.rise);
            for (double& value : light)
                value = seen.share * visible[n] * std::exp(-value);
            for (std::size_t i = 0; i < scatterers; ++i)
                for (std::size_t w = 0; w < wavelengths; ++w)
                    lit[i * wavelengths + w] += single.weights[n * stride + i * wavelengths + w] * light[w];
            if ((n + 1) % singleParts == 0)
                for (std::size_t i = 0; i < scatterers; ++i) {
                    for (std::size_t w = 0; w < wavelengths; ++w)
                        part[w] = lit[i * wavelengths + w] * ratios[i][w];
                    singles[i][(n + 1) / singleParts] = luminance(part);
                }
        }
        for (std::size_t i = 0; i < scatterers; ++i) {
            grown = singles[i];
            store(static_cast<int>(i) + 1, a, grown.back());
        }
        std::fill(grown.begin(), grown.end(), Texel{});
        if (moments_ ? scene_.layers.multiple : !scene_.multiple.empty()) {
            std::vector<double> sum(wavelengths, 0.);
            physics::RayNodes one;
            for (std::size_t n = 0; n < multiple.nodes.size(); ++n) {
                one.nodes.assign(1, multiple.nodes[n]);
                one.weights.assign(&multiple.weights[n * stride], &multiple.weights[n * stride] + stride);
                std::fill(part.begin(), part.end(), 0.);
                if (moments_)
                    evaluator.multipleAlong(one, *moments_, muSun, nu, part.data());
                else
                    for (std::size_t i = 0; i < stride; ++i)
                        part[i % wavelengths] += one.weights[i];
                const float* left =
                    shares ? &shares[(n * static_cast<std::size_t>(columns()) + static_cast<std::size_t>(a)) * wavelengths] : nullptr;
                for (std::size_t w = 0; w < wavelengths; ++w)
                    sum[w] += (left ? static_cast<double>(left[w]) : 1) * part[w];
                grown[n + 1] = luminance(sum);
            }
            for (std::size_t c = 0; !moments_ && c < 4; ++c) {
                const float scale = grown.back()[c] > faintest ? scene_.multiple.at(view, a)[c] / grown.back()[c] : 0;
                for (Texel& texel : grown)
                    texel[c] *= scale;
            }
        }
        Texel total = grown.back();
        const Texel seen = scene_.whole.empty() ? Texel{} : scene_.whole.at(view, a);
        if (view >= halfViews)
            total = seen; // with the ground
        else if (scene_.glow)
            for (std::size_t c = 0; c < 4; ++c) {
                const float other = std::max(0.f, seen[c] - total[c]);
                for (int k = 0; k < distances; ++k)
                    grown[static_cast<std::size_t>(k)][c] += other * columnShares[static_cast<std::size_t>(k)][c];
                total[c] += other;
            }
        store(0, a, total);
    }
}

} // namespace showmysky
