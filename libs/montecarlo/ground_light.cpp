#include "montecarlo/ground_light.hpp"

#include "base/angles.hpp"
#include "montecarlo/estimate.hpp"
#include "montecarlo/paths.hpp"
#include "montecarlo/reference.hpp"

#include <algorithm>
#include <cmath>

namespace sky::montecarlo {
namespace {

using base::pi;

/// Distance along the leg at which the optical depth is `depth`.
double distanceAtDepth(const Profile& profile, const Ray& ray, const Leg& leg, double depth)
{
    for (const Segment& segment : leg.segments) {
        if (depth <= segment.opticalDepth)
            return profile.distanceAt(ray, segment, depth);
        depth -= segment.opticalDepth;
    }
    return leg.length;
}

} // namespace

GroundLightTracer::GroundLightTracer(const Air& air, const Scene& scene, std::optional<GroundDisc> disc, int orders)
    : air_(air), scene_(scene), orders_(orders), everywhere_(!disc)
{
    const double radius = air.profile().planetRadius();
    if (disc) {
        const double angle = disc->distance / radius;
        centre_ = {std::sin(angle) * std::cos(disc->azimuth), std::sin(angle) * std::sin(disc->azimuth), std::cos(angle)};
        halfChord_ = std::sin(0.5 * disc->radius / radius);
        area_ = 4 * pi * radius * radius * halfChord_ * halfChord_;
    }
    firstRay_ = rayFrom(radius, scene_.camera, scene_.view);
    air_.profile().trace(firstRay_, firstLeg_);
}

double GroundLightTracer::batchMean(Random& random, int paths)
{
    double sum = 0;
    for (int i = 0; i < paths; ++i)
        sum += path(random);
    return sum / paths;
}

bool GroundLightTracer::glows(Vec up) const { return everywhere_ || length(up - centre_) <= 2 * halfChord_; }

double GroundLightTracer::direct() const
{
    if (!firstLeg_.hitsGround)
        return 0;
    const Place hit = moved(air_.profile().planetRadius(), scene_.camera, scene_.view, firstRay_, firstLeg_.length);
    return glows(hit.up) ? std::exp(-firstLeg_.opticalDepth) : 0;
}

/// Density in solid angle of directions towards uniform points of the disc; `cosine` is that of the ray's zenith angle there.
double GroundLightTracer::discDensity(double distance, double cosine) const { return distance * distance / (area_ * cosine); }

/// Light from a random point of the disc, scattered at `place` into the path. Both ways to meet the disc, this one and the path's own
/// next leg, are weighted by the balance heuristic (Veach & Guibas 1995), so that neither small distances nor peaks make noise.
double GroundLightTracer::towardsDisc(const Place& place, Vec direction, const Local& local, Random& random)
{
    const double radius = air_.profile().planetRadius();
    const double half = halfChord_ * std::sqrt(random.uniform()); // sine of half the distance from the centre
    const Vec point = turned(centre_, 1 - 2 * half * half, 2 * half * std::sqrt(1 - half * half), 2 * pi * random.uniform());
    const Vec difference = point - place.up;
    const double chord = dot(difference, difference); // 4 sin^2 of half the central angle
    const double square = place.altitude * place.altitude + radius * (radius + place.altitude) * chord;
    const double distance = std::sqrt(square);
    const double cosine = (place.altitude - 0.5 * (radius + place.altitude) * chord) / distance;
    if (!(cosine > 0) || !(distance > 0))
        return 0;
    const Vec towards = normalized(radius * difference - place.altitude * place.up);
    const Ray ray = rayFrom(radius, place, towards);
    if (!ray.hitsGround())
        return 0;
    air_.profile().trace(ray, discLeg_);
    const double scattered = air_.scatteredAt(local, angleBetween(towards, direction));
    return std::exp(-discLeg_.opticalDepth) * scattered / local.extinction / (discDensity(distance, cosine) + scattered / local.bright);
}

double GroundLightTracer::path(Random& random)
{
    if (!(firstLeg_.opticalDepth > 0))
        return 0;
    const Profile& profile = air_.profile();
    const double radius = profile.planetRadius();
    // The first event is in the air, on every path.
    double weight = -std::expm1(-firstLeg_.opticalDepth), radiance = 0;
    Vec direction = scene_.view;
    const double firstDepth = -std::log1p(-random.uniform() * weight);
    Place place = moved(radius, scene_.camera, direction, firstRay_, distanceAtDepth(profile, firstRay_, firstLeg_, firstDepth));
    place.altitude = std::clamp(place.altitude, 0.0, profile.topOfAtmosphere());
    bool onGround = false;
    for (int order = 1;; ++order) {
        double density = 0; // of the direction that is sampled
        const double u1 = random.uniform(), u2 = random.uniform();
        if (onGround) {
            weight *= air_.groundAlbedo();
            direction = turned(place.up, std::sqrt(1 - u1), std::sqrt(u1), 2 * pi * u2);
        } else {
            air_.at(place.altitude, local_);
            if (!(local_.bright > 0))
                return radiance;
            if (!everywhere_)
                radiance += weight * towardsDisc(place, direction, local_, random);
            const Vec from = direction;
            direction = scatteredDirection(air_, from, local_, u1, u2, weight);
            density = air_.scatteredAt(local_, angleBetween(direction, from)) / local_.bright;
        }
        if (!(weight > 0))
            return radiance;
        const Ray ray = rayFrom(radius, place, direction);
        profile.trace(ray, leg_);
        if (leg_.hitsGround && !onGround) {
            const Vec up = moved(radius, place, direction, ray, leg_.length).up;
            if (glows(up)) {
                const double cosine = std::max(1e-12, -dot(up, direction));
                const double share = everywhere_ ? 1 : density / (density + discDensity(leg_.length, cosine));
                radiance += weight * share * std::exp(-leg_.opticalDepth);
            }
        }
        if (order == orders_)
            return radiance;
        if (weight < rouletteThreshold) {
            if (random.uniform() * rouletteThreshold >= weight)
                return radiance;
            weight = rouletteThreshold;
        }
        const double depth = -std::log1p(-random.uniform());
        const bool inAir = depth < leg_.opticalDepth;
        if (!inAir && !leg_.hitsGround)
            return radiance;
        place = moved(radius, place, direction, ray, inAir ? distanceAtDepth(profile, ray, leg_, depth) : leg_.length);
        place.altitude = inAir ? std::clamp(place.altitude, 0.0, profile.topOfAtmosphere()) : 0;
        onGround = !inAir;
    }
}

GroundLight Reference::groundLight(const Query& query, const std::optional<GroundDisc>& disc, const Settings& settings) const
{
    check(query);
    GroundLight light;
    const std::optional<Scene> scene = sceneOf(medium_, query);
    if (!scene)
        return light;
    const Air& medium = air(query.wavelength);
    const auto tracer = [&] { return std::make_unique<GroundLightTracer>(medium, *scene, disc, settings.orders); };
    light.direct = tracer()->direct();
    Result result;
    runPaths([&] { return [own = std::shared_ptr(tracer())](Random& random, int paths) { return own->batchMean(random, paths); }; }, query,
             settings, result);
    light.scattered = result.multiple;
    light.scatteredStderr = result.multipleStderr;
    light.paths = result.paths;
    return light;
}

} // namespace sky::montecarlo
