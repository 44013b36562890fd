#include "montecarlo/paths.hpp"

#include "base/angles.hpp"

#include <algorithm>
#include <cmath>

namespace sky::montecarlo {
namespace {

using base::pi;

constexpr double followed = 0.5; // of events placed where light is: bounds each such weight by 2

/// How far a path of some weight still follows the guides. In clouds a path has dozens of events; the product of as many guided weights would
/// have a tail so long that the mean of any number of paths misses it. Like this a weight grows by so much an event at most, and yet finds light.
double trust(double weight) { return std::min(1., 1 / weight); }

constexpr double aimedShare = 0.15; // of directions after a scattering that are drawn about the Sun
constexpr double peaked = 15;       // forward value of a phase function, in units of the isotropic one, worth aiming for

/// Share of directions after a scattering that are drawn where the sky is bright. Few of those lie within a peak, and many guided decisions in a
/// row make weights whose tail short runs do not see.
///   forward  value of the phase function, in units of the isotropic one
double glowShare(double forward, int order) { return (order <= 2 ? 0.75 : 0.3) / (1 + forward / 8); }

} // namespace

PathTracer::PathTracer(const Air& air, const Scene& scene, Orders orders, const Glow* glow)
    : air_(air), scene_(scene), orders_(orders), glow_(glow)
{
    firstRay_ = rayFrom(air_.profile().planetRadius(), scene_.camera, scene_.view);
    air_.profile().trace(firstRay_, firstLeg_);
    // The ground in direct view is a layer of its own: the first event is in the air.
    prepare(scene_.camera, scene_.view, firstRay_, firstLeg_, 0, wantedAt(1, 1), firstChoice_);
}

PathTracer::Wanted PathTracer::wantedAt(int order, double weight) const
{
    return {order >= orders_.first, order != orders_.last, followed * trust(weight)};
}

double PathTracer::batchMean(Random& random, int paths)
{
    // Additive recurrence with the powers of the generalised golden ratio g^5 = g + 1 (M. Roberts 2018), shifted at
    // random: each path is uniform by itself, and the paths of a batch do not cluster.
    static constexpr Decisions step{0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101};
    Decisions decisions;
    for (double& u : decisions)
        u = random.uniform();
    double sum = 0;
    for (int i = 0; i < paths; ++i) {
        sum += path(random, decisions);
        for (int k = 0; k < spreadDecisions; ++k) {
            decisions[k] += step[k];
            decisions[k] -= decisions[k] >= 1 ? 1 : 0;
        }
    }
    return sum / paths;
}

void PathTracer::prepare(const Place& place, Vec direction, const Ray& ray, const Leg& leg, double groundAlbedo, Wanted wanted,
                         Choice& choice) const
{
    const double radius = air_.profile().planetRadius();
    const double upSun = (radius + place.altitude) * dot(place.up, scene_.sun.centre());
    const double alongSun = dot(direction, scene_.sun.centre());
    const auto bright = [&](double s) {
        return scene_.eclipse ? scene_.eclipse->guess((radius + place.altitude) * place.up + s * direction) : 1.0;
    };
    const auto lightAt = [&](int shell, double s, double sunlit) {
        const double x = std::max(0., ray.at(s)), inverseRadius = 1 / std::sqrt(radius * radius + x);
        const double muSun = (upSun + s * alongSun) * inverseRadius;
        return (wanted.direct ? sunlit * air_.guide()(shell, muSun + std::sqrt(x) * inverseRadius) * bright(s) : 0) +
               (wanted.scattered ? glow_->fromAllSides(shell, muSun) : 0);
    };
    // Here `cumulative` holds the plain chance of each event and `weight` the guide's factor.
    choice.cumulative.clear();
    choice.weight.clear();
    double plain = 0, guided = 0, transmittance = 1;
    const auto add = [&](double chance, double factor) {
        choice.cumulative.push_back(chance);
        choice.weight.push_back(factor);
        plain += chance;
        guided += chance * factor;
    };
    for (const Segment& segment : leg.segments) {
        const double middle = 0.5 * (segment.begin + segment.end);
        // Only scattering is an event. Were absorption one, paths would end in smoke and never know of light in thin air beside it.
        add(-transmittance * std::expm1(-segment.opticalDepth) * air_.scatteredShare(segment.shell), lightAt(segment.shell, middle, 1));
        transmittance *= std::exp(-segment.opticalDepth);
    }
    if (leg.hitsGround && groundAlbedo > 0) {
        // Sunlight leaves the ground as mu / pi, the air as about 1 / (4 pi).
        add(transmittance * groundAlbedo, lightAt(0, leg.length, 4 * std::max(0.0, (upSun + leg.length * alongSun) / radius)));
    }
    choice.possible = plain > 1e-300; // whose inverse is a number
    choice.plain = plain;
    if (!choice.possible)
        return;
    const double follow = guided > 0 ? wanted.guided : 0;
    double sum = 0;
    for (std::size_t i = 0; i < choice.weight.size(); ++i) {
        const double density = (1 - follow) / plain + (follow > 0 ? follow * choice.weight[i] / guided : 0);
        sum += choice.cumulative[i] * density;
        choice.cumulative[i] = sum;
        const double share = i < leg.segments.size() ? air_.scatteredShare(leg.segments[i].shell) : 1;
        choice.weight[i] = share > 0 ? 1 / (density * share) : 0;
    }
}

bool PathTracer::advance(Place& place, Vec direction, const Ray& ray, const Leg& leg, const Choice& choice, double u, double& weight) const
{
    const double radius = air_.profile().planetRadius();
    const double target = u * choice.cumulative.back();
    const auto found = std::upper_bound(choice.cumulative.begin(), choice.cumulative.end() - 1, target);
    const auto i = static_cast<std::size_t>(found - choice.cumulative.begin());
    weight *= choice.weight[i];
    if (i == leg.segments.size()) {
        place = moved(radius, place, direction, ray, leg.length);
        place.altitude = 0;
        return true;
    }
    // What is left of u places the event within the segment, by optical depth.
    const double before = i > 0 ? choice.cumulative[i - 1] : 0;
    const double rest = std::clamp((target - before) / (choice.cumulative[i] - before), 0.0, 1.0);
    const Segment& segment = leg.segments[i];
    const double depth = -std::log1p(rest * std::expm1(-segment.opticalDepth));
    const double s = air_.profile().distanceAt(ray, segment, std::min(depth, segment.opticalDepth));
    place = moved(radius, place, direction, ray, s);
    place.altitude = std::clamp(place.altitude, 0.0, air_.profile().topOfAtmosphere());
    return false;
}

Eclipse::Left PathTracer::sunPoint(const Place& place, Random& random) const
{
    const double u1 = random.uniform(), u2 = random.uniform();
    if (!scene_.eclipse)
        return {scene_.sun.point(u1, u2), 1};
    return scene_.eclipse->pointLeft((air_.profile().planetRadius() + place.altitude) * place.up, u1, u2);
}

double PathTracer::sunlightAtAir(const Place& place, Vec direction, const Local& local, Random& random) const
{
    const auto [sun, share] = sunPoint(place, random);
    const double t = share > 0 ? share * air_.transmittance(place, sun) : 0;
    return t > 0 ? t * air_.scatteredAt(local, angleBetween(sun, direction)) / local.extinction : 0;
}

double PathTracer::sunlightAtGround(const Place& place, Random& random) const
{
    const auto [sun, share] = sunPoint(place, random);
    const double mu = dot(place.up, sun);
    return share > 0 && mu > 0 ? share * mu / pi * air_.transmittance(place, sun) : 0;
}

Vec scatteredDirection(const Air& air, Vec direction, const Local& local, double u1, double u2, double& weight)
{
    weight *= local.bright / local.extinction;
    if (!(local.bright > 0))
        return direction;
    // One random number picks the species, what is left of it the angle.
    double target = u1 * local.bright;
    std::size_t last = local.scattering.size();
    double share = 0;
    for (std::size_t i = 0; i < local.scattering.size(); ++i) {
        const double next = local.scattering[i] * air.phase(i).integral();
        if (next <= 0)
            continue;
        if (last < local.scattering.size()) {
            if (target < share)
                break;
            target -= share;
        }
        last = i;
        share = next;
    }
    const PhaseTable::Sample sample = air.phase(last).sample(std::clamp(target / share, 0.0, 1.0));
    weight *= sample.weight;
    return turned(direction, std::cos(sample.angle), std::sin(sample.angle), 2 * pi * u2);
}

Vec PathTracer::nextDirection(const Place& place, Vec direction, int order, double u1, double u2, Random& random, double& weight) const
{
    if (!(local_.bright > 0)) {
        weight = 0;
        return direction;
    }
    const Vec sun = scene_.sun.centre();
    const Glow::View view = glow_->viewFrom(place, sun);
    const double forward = 4 * pi * air_.scatteredAt(local_, 0) / local_.bright;
    const double aimed = forward > peaked ? aimedShare : 0,
                 guided = view.map ? glowShare(forward, order) * trust(weight * local_.bright / local_.extinction) : 0;
    // What is left of u1 after the choice is as even as it was.
    Vec next;
    if (u1 < guided) {
        next = glow_->direction(view, u1 / guided, u2);
        weight *= local_.bright / local_.extinction;
    } else {
        next = scatteredDirection(air_, aimed > 0 && random.uniform() * (1 - guided) < aimed ? sun : direction, local_,
                                  (u1 - guided) / (1 - guided), u2, weight);
    }
    if (!(weight > 0))
        return next;
    // Each way might have led here: the balance heuristic.
    const double scattered = air_.scatteredAt(local_, angleBetween(next, direction));
    double likely = (1 - aimed - guided) * scattered;
    if (aimed > 0)
        likely += aimed * air_.scatteredAt(local_, angleBetween(next, sun));
    if (guided > 0)
        likely += guided * glow_->density(view, next) * local_.bright;
    weight *= scattered / likely;
    return next;
}

double PathTracer::path(Random& random, const Decisions& decisions)
{
    if (!firstChoice_.possible)
        return 0;
    const double radius = air_.profile().planetRadius();
    Place place = scene_.camera;
    Vec direction = scene_.view;
    double weight = 1, radiance = 0, left = 1, reference = 1;
    bool onGround = advance(place, direction, firstRay_, firstLeg_, firstChoice_, decisions[0], weight);
    for (int order = 1;; ++order) {
        if (!onGround)
            air_.at(place.altitude, local_);
        if (!onGround && !(local_.extinction > 0))
            return radiance;
        if (order >= orders_.first)
            radiance += weight * (onGround ? sunlightAtGround(place, random) : sunlightAtAir(place, direction, local_, random));
        if (order == orders_.last)
            return radiance;

        const double u1 = order == 1 ? decisions[1] : random.uniform();
        const double u2 = order == 1 ? decisions[2] : random.uniform();
        if (onGround) // Lambert's law: the sine squared is uniform
            direction = turned(place.up, std::sqrt(1 - u1), std::sqrt(u1), 2 * pi * u2);
        else
            direction = nextDirection(place, direction, order, u1, u2, random, weight);
        if (!(weight > 0))
            return radiance;

        const Ray ray = rayFrom(radius, place, direction);
        air_.profile().trace(ray, leg_);
        prepare(place, direction, ray, leg_, air_.groundAlbedo(), wantedAt(order + 1, weight), choice_);
        if (!choice_.possible)
            return radiance;
        onGround = advance(place, direction, ray, leg_, choice_, order == 1 ? decisions[3] : random.uniform(), weight);

        // Russian roulette once events are being counted, by what would be left of a path that follows no guide.
        left *= choice_.plain;
        if (order < orders_.first)
            reference = left;
        else if (const double least = rouletteThreshold * reference; left < least) {
            if (random.uniform() * least >= left)
                return radiance;
            weight *= least / left;
            left = least;
        }
    }
}

} // namespace sky::montecarlo
