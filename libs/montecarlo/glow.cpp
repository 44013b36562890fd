#include "montecarlo/glow.hpp"

#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "montecarlo/air.hpp"
#include "montecarlo/single.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sky::montecarlo {
namespace {

using base::pi;

// Rough, since whatever they miss only costs paths.
constexpr std::size_t levels = 16, bandCount = 20, sectorCount = 12, together = 3; // sectors that count as one while the series is summed
constexpr double thin = 3e-3;                                                      // optical depth
constexpr double finestSun = 0.15, finestBand = 0.8;                               // where bins begin to widen, in units of twilight()
constexpr int events = 6; // scatterings followed one by one; the rest is a geometric series

/// Sine of the dip of the horizon.
double horizonSine(const Profile& profile, double altitude)
{
    return std::sqrt(radialSquare(profile.planetRadius(), altitude)) / (profile.planetRadius() + altitude);
}

/// The angle that the Sun sinks by in the course of twilight, as far as the air counts: the dip of the horizon from where a level ray meets
/// nothing more to speak of. No more than a fifth, rad.
double twilight(const Profile& profile)
{
    double low = 0, high = profile.topOfAtmosphere();
    for (int halving = 0; halving < 30; ++halving) {
        const double middle = 0.5 * (low + high);
        const Ray level = rayFrom(profile.planetRadius(), {middle, {0, 0, 1}}, {1, 0, 0});
        (profile.opticalDepthToSpace(level) < thin ? high : low) = middle;
    }
    return std::clamp(horizonSine(profile, high), 1e-5, 0.2);
}

} // namespace

/// A line of sight: how much of the light that meets its parts reaches the viewer.
struct Glow::Sight {
    struct Part {
        int shell;
        double distance, inverseRadius; // m, 1/m
        double horizon;                 // sine of its dip
        double share;                   // of the light that meets it here
        bool ground = false;
    };
    Place place;
    double mu = 0;
    std::vector<Part> parts;
    std::vector<double> species; // their parts in all that is scattered

    /// Cosine of the angle from the Sun.
    double towardsSun(double muSun, double azimuth) const
    {
        return std::clamp(mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(azimuth), -1., 1.);
    }
};

Glow::Glow(const Air& air)
{
    layOut(air);
    const Profile& profile = air.profile();
    sunBins_.emplace(twilight(profile) * finestSun, -horizonSine(profile, profile.topOfAtmosphere()) - std::sin(air.sunAngularRadius()), 1);
    for (int i = 0; i < sunBins_->count(); ++i)
        sunCosines_.push_back(std::clamp(sunBins_->middle(i), -1., 1.));
    fill(air, nullptr);
}

Glow::Glow(const Air& air, const Scene& scene)
{
    layOut(air);
    sunCosines_ = {dot(scene.camera.up, scene.sun.centre())};
    fill(air, &*scene.eclipse);
}

void Glow::layOut(const Air& air)
{
    const Profile& profile = air.profile();
    const double scale = finestBand * twilight(profile), whole = std::asinh(0.5 * pi / scale);
    for (std::size_t i = 0; i <= bandCount; ++i)
        cosineEdges_.push_back(
            std::sin(std::clamp(scale * std::sinh(whole * (2. * static_cast<double>(i) / bandCount - 1)), -0.5 * pi, 0.5 * pi)));
    for (std::size_t i = 0; i <= sectorCount; ++i) {
        azimuthEdges_.push_back(pi * std::pow(static_cast<double>(i) / sectorCount, 1.5));
        azimuthCosines_.push_back(std::cos(azimuthEdges_.back()));
    }
    // Half of the levels by optical depth, half by altitude.
    Leg vertical;
    profile.trace(rayFrom(profile.planetRadius(), {0, {0, 0, 1}}, {0, 0, 1}), vertical);
    const double depth = std::max(vertical.opticalDepth, 1e-300);
    double before = 0;
    for (const Segment& segment : vertical.segments) {
        const double after = before + 0.5 * segment.opticalDepth / depth + 0.5 * (segment.end - segment.begin) / vertical.length;
        for (double next;
             (next = (static_cast<double>(levelAltitudes_.size()) + 0.5) / levels) <= after && levelAltitudes_.size() < levels;)
            levelAltitudes_.push_back(segment.begin + (segment.end - segment.begin) * (next - before) / (after - before));
        before = after;
    }
    for (std::size_t i = 0; i + 1 < levelAltitudes_.size(); ++i)
        levelEdges_.push_back(0.5 * (levelAltitudes_[i] + levelAltitudes_[i + 1]));
    for (int shell = 0; shell < profile.shellCount(); ++shell)
        levelOfShell_.push_back(static_cast<std::size_t>(
            std::upper_bound(levelEdges_.begin(), levelEdges_.end(), profile.middleAltitude(shell)) - levelEdges_.begin()));
}

double Glow::solidAngle(std::size_t band, std::size_t sector, std::size_t together) const
{
    return 2 * (cosineEdges_[band + 1] - cosineEdges_[band]) * (azimuthEdges_[sector + together] - azimuthEdges_[sector]);
}

Glow::Sight Glow::sightAt(const Air& air, std::size_t level, std::size_t band) const
{
    const double radius = air.profile().planetRadius();
    Sight sight;
    sight.place = {levelAltitudes_[level], {0, 0, 1}};
    sight.mu = 0.5 * (cosineEdges_[band] + cosineEdges_[band + 1]);
    const Ray ray = rayFrom(radius, sight.place, {std::sqrt(1 - sight.mu * sight.mu), 0, sight.mu});
    Leg leg;
    air.profile().trace(ray, leg);
    double transmittance = 1;
    Local local;
    for (const Segment& segment : leg.segments) {
        const double chance = -transmittance * std::expm1(-segment.opticalDepth), middle = 0.5 * (segment.begin + segment.end);
        transmittance *= std::exp(-segment.opticalDepth);
        air.at(air.profile().middleAltitude(segment.shell), local);
        if (!(local.bright > 0))
            continue;
        const double share = chance * local.bright / local.extinction;
        const double x = std::max(0., ray.at(middle)), inverseRadius = 1 / std::sqrt(radius * radius + x);
        sight.parts.push_back({segment.shell, middle, inverseRadius, std::sqrt(x) * inverseRadius, share});
        sight.species.resize(local.scattering.size());
        for (std::size_t i = 0; i < local.scattering.size(); ++i)
            sight.species[i] += chance * local.scattering[i] / local.extinction;
    }
    const double all = std::accumulate(sight.species.begin(), sight.species.end(), 0.);
    for (double& share : sight.species)
        share = all > 0 ? share / all : 0;
    if (leg.hitsGround && air.groundAlbedo() > 0)
        sight.parts.push_back({0, leg.length, 1 / radius, 0, transmittance * air.groundAlbedo(), true});
    return sight;
}

double Glow::sunlit(const Air& air, const Sight& sight, double muSun, double azimuth, const Eclipse* eclipse) const
{
    const double start = air.profile().planetRadius() + sight.place.altitude, nu = sight.towardsSun(muSun, azimuth);
    const double sine = std::sqrt(1 - sight.mu * sight.mu);
    const Vec direction{sine * std::cos(azimuth), sine * std::sin(azimuth), sight.mu};
    double phase = 0;
    for (std::size_t i = 0; i < sight.species.size(); ++i)
        phase += sight.species[i] * air.phase(i).value(std::acos(nu));
    double sum = 0;
    for (const Sight::Part& part : sight.parts) {
        const double mu = (start * muSun + part.distance * nu) * part.inverseRadius;
        const double light = air.guide()(part.shell, mu + part.horizon) * (part.ground ? std::max(0., mu) / pi : phase);
        sum += part.share * light * (eclipse ? eclipse->guess(start * sight.place.up + part.distance * direction) : 1);
    }
    return sum;
}

double Glow::skylit(const Air& air, const Sight& sight, double muSun, double azimuth) const
{
    const double start = air.profile().planetRadius() + sight.place.altitude, nu = sight.towardsSun(muSun, azimuth);
    double sum = 0;
    for (const Sight::Part& part : sight.parts)
        sum += part.share * fromAllSides(part.shell, (start * muSun + part.distance * nu) * part.inverseRadius);
    return sum / (4 * pi);
}

void Glow::fill(const Air& air, const Eclipse* eclipse)
{
    const std::size_t heights = levelAltitudes_.size(), elevations = sunCosines_.size(), bins = bands() * sectors();
    std::vector<Sight> sights;
    for (std::size_t level = 0; level < heights; ++level)
        for (std::size_t band = 0; band < bands(); ++band)
            sights.push_back(sightAt(air, level, band));
    const std::size_t maps = heights * elevations;
    // Calls visit(map) for all maps, on all threads.
    const auto each = [&](const auto& visit) {
        base::parallel([&](int thread, int threads) {
            for (auto map = static_cast<std::size_t>(thread); map < maps; map += static_cast<std::size_t>(threads))
                visit(map);
        });
    };
    // Calls light(sight, muSun, azimuth) for each bin of a map, and weighs it with its solid angle; of each so many sectors the middle stands for all.
    const auto look = [&](std::size_t map, std::size_t together, const auto& light, const auto& take) {
        for (std::size_t band = 0; band < bands(); ++band)
            for (std::size_t sector = 0; sector < sectors(); sector += together) {
                const double azimuth = 0.5 * (azimuthEdges_[sector] + azimuthEdges_[sector + together]);
                take(band * sectors() + sector, solidAngle(band, sector, together) * light(sights[map / elevations * bands() + band],
                                                                                           sunCosines_[map % elevations], azimuth));
            }
    };
    std::vector<double> direct(maps * bins), once(maps);
    each([&](std::size_t map) {
        look(
            map, 1,
            [&](const Sight& sight, double muSun, double azimuth) {
                const double one = sunlit(air, sight, muSun, azimuth, eclipse); // the Moon may stand beside the Sun's vertical
                return eclipse ? 0.5 * (one + sunlit(air, sight, muSun, -azimuth, eclipse)) : one;
            },
            [&](std::size_t bin, double light) {
                direct[map * bins + bin] = light;
                once[map] += light;
            });
    });

    const auto again = [&](const Sight& sight, double muSun, double azimuth) { return skylit(air, sight, muSun, azimuth); };
    diffuse_ = once;
    std::vector<double> added = once, addedBefore(maps);
    for (int event = 1; event < events; ++event) {
        std::vector<double> next = once;
        each([&](std::size_t map) { look(map, together, again, [&](std::size_t, double light) { next[map] += light; }); });
        addedBefore = added;
        for (std::size_t map = 0; map < maps; ++map)
            added[map] = next[map] - diffuse_[map];
        diffuse_ = next;
    }
    constexpr double steepest = 0.9; // ratio of the series
    for (std::size_t map = 0; map < maps; ++map)
        if (const double ratio = std::min(steepest, added[map] / std::max(addedBefore[map], 1e-300)); ratio > 0)
            diffuse_[map] += added[map] * ratio / (1 - ratio);

    maps_.assign(maps * mapSize(), 0);
    each([&](std::size_t map) {
        std::vector<double> light(direct.begin() + static_cast<std::ptrdiff_t>(map * bins),
                                  direct.begin() + static_cast<std::ptrdiff_t>((map + 1) * bins));
        look(map, 1, again, [&](std::size_t bin, double more) { light[bin] += more; });
        draw(light, &maps_[map * mapSize()]);
    });
}

void Glow::draw(const std::vector<double>& light, float* map) const
{
    const double all = std::accumulate(light.begin(), light.end(), 0.);
    double below = 0;
    for (std::size_t band = 0; band < bands(); ++band) {
        const auto first = light.begin() + static_cast<std::ptrdiff_t>(band * sectors());
        const double inBand = std::accumulate(first, first + static_cast<std::ptrdiff_t>(sectors()), 0.);
        map[band] = static_cast<float>(all > 0 ? (below += inBand) / all : 0);
        double aside = 0;
        for (std::size_t sector = 0; sector < sectors(); ++sector)
            map[bands() + band * sectors() + sector] =
                static_cast<float>(inBand > 0 ? (aside += first[static_cast<std::ptrdiff_t>(sector)]) / inBand : 0);
    }
}

double Glow::fromAllSides(int shell, double muSun) const
{
    return diffuse_[levelOfShell_[static_cast<std::size_t>(shell)] * sunCosines_.size() + sunOf(muSun)];
}

Glow::View Glow::viewFrom(const Place& place, Vec sun) const
{
    View view;
    const double muSun = dot(place.up, sun);
    const auto level =
        static_cast<std::size_t>(std::upper_bound(levelEdges_.begin(), levelEdges_.end(), place.altitude) - levelEdges_.begin());
    const float* map = mapOf(level, sunOf(muSun));
    if (!(map[bands() - 1] > 0))
        return view;
    view.map = map;
    view.up = place.up;
    const Vec horizontal = sun - muSun * place.up;
    view.towards = length(horizontal) > 1e-9 ? normalized(horizontal) : perpendicular(place.up);
    view.side = cross(place.up, view.towards);
    return view;
}

namespace {

/// The bin of a cumulative distribution that u in 0 .. 1 falls into; u becomes its place therein, `share` the bin's.
std::size_t binOf(const float* cumulative, std::size_t count, double& u, double& share)
{
    const double target = u * static_cast<double>(cumulative[count - 1]);
    const float* const full = std::lower_bound(cumulative, cumulative + count, cumulative[count - 1]); // bins after it are empty
    const auto i = static_cast<std::size_t>(std::upper_bound(cumulative, full, static_cast<float>(target)) - cumulative);
    const double before = i > 0 ? static_cast<double>(cumulative[i - 1]) : 0;
    share = static_cast<double>(cumulative[i]) - before;
    u = std::clamp((target - before) / share, 0., 1.);
    return i;
}

} // namespace

Vec Glow::direction(const View& view, double u1, double u2) const
{
    double share = 0;
    const std::size_t band = binOf(view.map, bands(), u1, share);
    const double side = u2 < 0.5 ? 1 : -1;
    u2 = 2 * u2 - (u2 < 0.5 ? 0 : 1);
    const std::size_t sector = binOf(view.map + bands() + band * sectors(), sectors(), u2, share);
    const double mu = std::lerp(cosineEdges_[band], cosineEdges_[band + 1], u1);
    const double azimuth = side * std::lerp(azimuthEdges_[sector], azimuthEdges_[sector + 1], u2);
    const double sine = std::sqrt(std::max(0., 1 - mu * mu));
    return normalized(mu * view.up + sine * (std::cos(azimuth) * view.towards + std::sin(azimuth) * view.side));
}

double Glow::density(const View& view, Vec direction) const
{
    const double mu = dot(view.up, direction), sine = std::sqrt(std::max(0., 1 - mu * mu));
    const double cosAzimuth = sine > 0 ? std::clamp(dot(view.towards, direction) / sine, -1., 1.) : 1;
    const auto band =
        static_cast<std::size_t>(std::upper_bound(cosineEdges_.begin() + 1, cosineEdges_.end() - 1, mu) - cosineEdges_.begin()) - 1;
    const auto sector =
        static_cast<std::size_t>(std::upper_bound(azimuthCosines_.begin() + 1, azimuthCosines_.end() - 1, cosAzimuth, std::greater<>()) -
                                 azimuthCosines_.begin()) -
        1;
    const auto shareOf = [](const float* cumulative, std::size_t i) {
        return static_cast<double>(cumulative[i]) - (i > 0 ? static_cast<double>(cumulative[i - 1]) : 0);
    };
    return shareOf(view.map, band) * shareOf(view.map + bands() + band * sectors(), sector) / solidAngle(band, sector);
}

} // namespace sky::montecarlo
