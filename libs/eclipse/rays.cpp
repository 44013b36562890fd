#include "eclipse/rays.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "eclipse/frame.hpp"
#include "physics/directions.hpp"
#include "physics/harmonics.hpp"
#include "physics/levels.hpp"
#include "physics/moments.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace sky::eclipse {

namespace {

using base::pi;

/// Share of the column of scatterers above which air sends on too little light to know more of than that of the highest level.
constexpr double negligibleColumn = 3e-4;

/// Altitude above which less than that share of every scatterer stands.
double highestLevel(const physics::Medium& medium, const physics::Optics& optics)
{
    double highest = 0;
    for (const int s : optics.scatterers) {
        const auto& n = medium.species[static_cast<std::size_t>(s)].numberDensity;
        std::vector<double> above(n.size(), 0.);
        for (std::size_t k = n.size() - 1; k > 0; --k)
            above[k - 1] = above[k] + 0.5 * (n[k] + n[k - 1]) * (medium.altitudes[k] - medium.altitudes[k - 1]);
        for (std::size_t k = 0; k < n.size(); ++k)
            if (above[k] > negligibleColumn * above[0])
                highest = std::max(highest, medium.altitudes[std::min(k + 1, n.size() - 1)]);
    }
    return highest > 0 ? highest : medium.topOfAtmosphere;
}

std::vector<double> gridAltitudes(const physics::Medium& medium, const physics::Profile& profile, const physics::Optics& optics, int count)
{
    std::vector<double> largest;
    for (int s = 0; s < optics.species; ++s) {
        const auto first = optics.extinction.begin() + s * optics.wavelengths;
        largest.push_back(*std::max_element(first, first + optics.wavelengths));
    }
    const auto& planet = profile.planet();
    const double highest = highestLevel(medium, optics);
    const double more = physics::horizonDistance(planet, planet.topOfAtmosphere) / physics::horizonDistance(planet, highest);
    const int whole = static_cast<int>(std::ceil((count - 1) * more)) + 1;
    auto levels = physics::fieldLevels(profile, largest, whole);
    const auto last = std::lower_bound(levels.begin() + 1, levels.end() - 1, highest);
    levels.erase(last + 1, levels.end());
    return levels;
}

/// Even levels for sunlight, with those of the grid among them: a layer's edges are there.
std::vector<double> sunlightAltitudes(const physics::Planet& planet, const Levels& levels, int count)
{
    auto all = physics::altitudeNodes(planet, count);
    for (int i = 0; i < levels.count(); ++i)
        all.push_back(levels.altitude(i));
    std::sort(all.begin(), all.end());
    const double least = 0.2 * physics::horizonDistance(planet, planet.topOfAtmosphere) / count;
    std::vector<double> result{0};
    for (const double h : all)
        if (physics::horizonDistance(planet, h) - physics::horizonDistance(planet, result.back()) > least)
            result.push_back(h);
    result.back() = planet.topOfAtmosphere;
    return result;
}

/// Leaves out nodes from which next to no light comes through, in haze and clouds most: even where an eclipse makes the rest ten thousand times darker
/// they tell nothing.
physics::RayNodes withoutHidden(const physics::RayNodes& ray, std::size_t scatterers, std::size_t wavelengths)
{
    constexpr double hidden = 1e-9;    // of the largest weight of a wavelength
    constexpr double faintest = 1e-20; // optical depth: with less, light gets so faint that processors compute it a hundred times slower
    const std::size_t row = scatterers * wavelengths;
    std::vector<double> largest(wavelengths, 0.);
    for (std::size_t i = 0; i < ray.weights.size(); ++i)
        largest[i % wavelengths] = std::max(largest[i % wavelengths], ray.weights[i]);
    physics::RayNodes result = ray;
    result.nodes.clear();
    result.weights.clear();
    for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
        std::vector<double> weights(ray.weights.begin() + static_cast<std::ptrdiff_t>(k * row),
                                    ray.weights.begin() + static_cast<std::ptrdiff_t>((k + 1) * row));
        for (std::size_t i = 0; i < row; ++i)
            weights[i] = weights[i] > hidden * largest[i % wavelengths] && weights[i] > faintest ? weights[i] : 0;
        if (*std::max_element(weights.begin(), weights.end()) == 0)
            continue;
        result.nodes.push_back(ray.nodes[k]);
        result.weights.insert(result.weights.end(), weights.begin(), weights.end());
    }
    return result;
}

/// [node]: the largest share that a node has of the light that scatterers send along a ray, of all wavelengths.
std::vector<double> largestShares(const physics::RayNodes& ray, std::size_t wavelengths)
{
    std::vector<double> result(ray.nodes.size(), 0.);
    const std::size_t scatterers = ray.weights.size() / std::max<std::size_t>(1, ray.nodes.size() * wavelengths);
    for (std::size_t w = 0; w < wavelengths; ++w) {
        std::vector<double> sums(ray.nodes.size(), 0.);
        double all = 0;
        for (std::size_t k = 0; k < sums.size(); ++k) {
            for (std::size_t i = 0; i < scatterers; ++i)
                sums[k] += ray.weights[(k * scatterers + i) * wavelengths + w];
            all += sums[k];
        }
        for (std::size_t k = 0; k < sums.size(); ++k)
            result[k] = all > 0 ? std::max(result[k], sums[k] / all) : result[k];
    }
    return result;
}

/// What nodes carry, [group][node][...], shared out among entries, [group][entry][...].
Lanes ofEntries(const Sharing& sharing, const Lanes& ofNodes, int groups)
{
    int nodes = 0;
    for (const auto& part : sharing.parts)
        nodes = std::max(nodes, part.node + 1);
    const std::size_t entries = sharing.places.levels.size(), count = static_cast<std::size_t>(groups);
    const std::size_t row = nodes > 0 ? ofNodes.size() / (count * static_cast<std::size_t>(nodes)) : 0;
    Lanes result(count * entries * row, Lane{});
    for (std::size_t g = 0; g < count; ++g)
        for (const auto& part : sharing.parts)
            for (std::size_t i = 0; i < row; ++i)
                result[(g * entries + static_cast<std::size_t>(part.entry)) * row + i] +=
                    part.share * ofNodes[(g * static_cast<std::size_t>(nodes) + static_cast<std::size_t>(part.node)) * row + i];
    return result;
}

FieldSettings checked(FieldSettings s)
{
    if (s.azimuths < 4 || s.azimuths % 4 != 0)
        throw RangeError("The number of azimuths of an eclipse's field is " + std::to_string(s.azimuths) + "; expected a multiple of 4.");
    if (s.along < 2 || s.across < 2)
        throw RangeError("The grid of an eclipse's field has " + std::to_string(s.along) + " x " + std::to_string(s.across) +
                         " points; expected 2 x 2 or more.");
    return s;
}

} // namespace

Levels::Levels(const physics::Planet& planet, std::vector<double> altitudes) : planet_(planet), altitudes_(std::move(altitudes))
{
    for (const double h : altitudes_)
        measure_.push_back(physics::horizonDistance(planet_, h));
}

Place Levels::place(const double altitude, const double distance) const
{
    const double x = physics::horizonDistance(planet_, altitude);
    const auto above = std::upper_bound(measure_.begin(), measure_.end(), x) - measure_.begin();
    const int k = static_cast<int>(std::clamp<std::ptrdiff_t>(above, 1, count() - 1)) - 1;
    const double low = measure_[static_cast<std::size_t>(k)], high = measure_[static_cast<std::size_t>(k) + 1];
    return {k, static_cast<float>(std::clamp((x - low) / (high - low), 0., 1.)), static_cast<float>(distance)};
}

AirRays::AirRays(const physics::Medium& medium_, const physics::Profile& profile_, const physics::Optics& optics_,
                 const FieldSettings& settings_)
    : medium(medium_), profile(profile_), optics(optics_), settings(checked(settings_)),
      degree(std::clamp(std::min(settings_.degree, optics_.degree), 0, mostDegree)), wavelengths(optics_.wavelengths),
      groups(groupsOf(wavelengths)), scatterers(static_cast<int>(optics_.scatterers.size())),
      levels(profile_.planet(), gridAltitudes(medium_, profile_, optics_, settings_.altitudes)),
      sunlightLevels(profile_.planet(), sunlightAltitudes(profile_.planet(), levels, settings_.sunlightAltitudes))
{
    for (int g = 0; g < groups; ++g)
        for (const int s : optics.scatterers)
            for (int l = 0; l <= degree; ++l) {
                phase.emplace_back();
                fillLane(phase.back(), &optics.moments[static_cast<std::size_t>((s * (optics.degree + 1) + l) * wavelengths)], g,
                         wavelengths);
                phase.back() *= static_cast<float>(2 * l + 1);
            }
    physics::MomentSettings quadrature;
    quadrature.groundDirections = settings.groundDirections;
    quadrature.limbDirections = settings.limbDirections;
    quadrature.skyDirections = settings.skyDirections;
    rays.resize(static_cast<std::size_t>(levels.count()));
    base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(profile, optics, 2);
        for (int a = thread; a < levels.count(); a += threads) {
            const double h = levels.altitude(a);
            const auto directions = physics::directionsAt(profile.planet(), h, quadrature);
            for (std::size_t d = 0; d < directions.mu.size(); ++d)
                rays[static_cast<std::size_t>(a)].push_back(
                    trace(tracer, h, directions.mu[d], directions.weight[d], directions.hitsGround[d]));
        }
    });
}

Lanes AirRays::coefficientsOf(const physics::RayNodes& ray) const
{
    const int harmonics = physics::harmonicCount(degree), nodes = static_cast<int>(ray.nodes.size());
    std::vector<double> factors(static_cast<std::size_t>(harmonics)), sums(static_cast<std::size_t>(wavelengths));
    Lanes result(static_cast<std::size_t>(groups * nodes * harmonics));
    for (int k = 0; k < nodes; ++k) {
        physics::harmonicFactors(degree, ray.nodes[static_cast<std::size_t>(k)].mu, factors.data());
        for (int l = 0; l <= degree; ++l) {
            for (int w = 0; w < wavelengths; ++w) {
                double sum = 0;
                for (int i = 0; i < scatterers; ++i)
                    sum += ray.weights[static_cast<std::size_t>((k * scatterers + i) * wavelengths + w)] *
                           optics.moment(optics.scatterers[static_cast<std::size_t>(i)], l, w);
                sums[static_cast<std::size_t>(w)] = sum;
            }
            for (int g = 0; g < groups; ++g)
                for (int m = 0; m <= l; ++m) {
                    const int lm = physics::harmonicIndex(l, m);
                    Lane& lane = result[static_cast<std::size_t>((g * nodes + k) * harmonics + lm)];
                    fillLane(lane, sums.data(), g, wavelengths);
                    lane *= static_cast<float>(factors[static_cast<std::size_t>(lm)]);
                }
        }
    }
    return result;
}

GridRay AirRays::trace(physics::RayTracer& tracer, const double altitude, const double mu, const double weight, const bool hitsGround) const
{
    const double radius = profile.planet().radius;
    GridRay ray{static_cast<float>(mu), static_cast<float>(weight), hitsGround, {}, {}, {}, {}, 0, {}, {}};
    const auto distanceOf = [&](const physics::RayNodes::Node& n) { return groundDistance(radius, n.sunScale, n.nuScale, mu); };

    const auto seen = [&](int nodes) {
        return withoutHidden(tracer.trace(altitude, mu, nodes, hitsGround), static_cast<std::size_t>(scatterers),
                             static_cast<std::size_t>(wavelengths));
    };
    const auto sharing = [&](const physics::RayNodes& nodes, const Levels& among, double tolerance) {
        std::vector<Place> places;
        for (const auto& node : nodes.nodes)
            places.push_back(among.place(node.altitude, distanceOf(node)));
        return shareOut(places, largestShares(nodes, static_cast<std::size_t>(wavelengths)), settings.core, tolerance);
    };
    const auto scattered = seen(settings.nodes);
    Sharing shared = sharing(scattered, levels, settings.chords);
    ray.coefficients = ofEntries(shared, coefficientsOf(scattered), groups);
    ray.scattered = std::move(shared.places);

    const auto direct = seen(settings.directNodes);
    shared = sharing(direct, sunlightLevels, settings.directChords);
    const std::size_t rows = direct.nodes.size() * static_cast<std::size_t>(scatterers);
    Lanes weights(static_cast<std::size_t>(groups) * rows);
    for (int g = 0; g < groups; ++g)
        for (std::size_t i = 0; i < rows; ++i) {
            Lane& lane = weights[static_cast<std::size_t>(g) * rows + i];
            fillLane(lane, &direct.weights[i * static_cast<std::size_t>(wavelengths)], g, wavelengths);
            lane *= static_cast<float>(1 / (4 * pi));
        }
    ray.directWeights = ofEntries(shared, weights, groups);
    ray.direct = std::move(shared.places);

    ray.ground.resize(static_cast<std::size_t>(groups));
    if (hitsGround) {
        ray.groundDistance = static_cast<float>(distanceOf(direct.ground));
        std::vector<double> reflected(static_cast<std::size_t>(wavelengths));
        for (std::size_t w = 0; w < reflected.size(); ++w)
            reflected[w] = direct.groundTransmittance[w] * medium.groundAlbedo[w] / pi;
        for (int g = 0; g < groups; ++g)
            fillLane(ray.ground[static_cast<std::size_t>(g)], reflected.data(), g, wavelengths);
    }
    std::vector<double> factors(static_cast<std::size_t>(physics::harmonicCount(degree)));
    physics::harmonicFactors(degree, mu, factors.data());
    ray.factors.assign(factors.begin(), factors.end());
    return ray;
}

std::shared_ptr<const AirRays> traceAir(const physics::Medium& medium, const physics::Profile& profile, const physics::Optics& optics,
                                        const FieldSettings& settings)
{
    return std::make_shared<const AirRays>(medium, profile, optics, settings);
}

} // namespace sky::eclipse
