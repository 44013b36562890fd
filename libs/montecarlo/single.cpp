#include "montecarlo/single.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace sky::montecarlo {
namespace {

constexpr double halvingTolerance = 2e-5;
constexpr int mostHalvings = 4;
constexpr double costOfHalving = 6; // each takes 4 to 8 times as long as the one before

/// Steps that even ones in a segment may be at most, before they are halved.
constexpr int mostSteps = 64;

/// Power with which steps crowd at both ends of a segment, where its light is if it is too deep for even steps: the first is half a mean
/// free path.
double crowdingAtEnds(double opticalDepth) { return std::max(1., std::log(opticalDepth) / std::log(mostSteps / 2)); }

/// Optical depth towards the Sun's centre, or towards the horizon where that hides it.
double depthTowardsSun(const Profile& profile, const Place& place, Vec sun)
{
    const double radius = profile.planetRadius(), altitude = std::clamp(place.altitude, 0., profile.topOfAtmosphere());
    const double horizon = -(1 - 1e-12) * std::sqrt(radialSquare(radius, altitude)) / (radius + altitude); // a hair above it
    const double mu = std::max(horizon, dot(place.up, sun));
    return profile.opticalDepthToSpace(rayFrom(radius, {altitude, {0, 0, 1}}, {std::sqrt(std::max(0., 1 - mu * mu)), 0, mu}));
}

/// Place 0..1 in a segment after a share x of its steps.
double crowded(double x, double power) { return x < 0.5 ? 0.5 * std::pow(2 * x, power) : 1 - 0.5 * std::pow(2 - 2 * x, power); }

double integrate(const Air& air, const Scene& scene, const Leg& leg, int halvings)
{
    const Profile& profile = air.profile();
    const double radius = profile.planetRadius();
    const Ray ray = rayFrom(radius, scene.camera, scene.view);
    const Rule steps = gaussLegendre(4), across = gaussLegendre(4 + 2 * halvings), along = gaussLegendre(6 + 3 * halvings);
    Local local;
    double sum = 0, depthBefore = 0;
    for (const Segment& segment : leg.segments) {
        // A step is short against the mean free path and against the turning of the vertical along the ray.
        const double length = segment.end - segment.begin;
        const double turns = length / (radius + scene.camera.altitude) / 0.003;
        const auto towardsSun = [&](double s) {
            return depthTowardsSun(profile, moved(radius, scene.camera, scene.view, ray, s), scene.sun.centre());
        };
        // Of a low Sun a skin under an upper edge is lit, however shallow the segment is along the view.
        const double lit = std::abs(towardsSun(segment.begin) - towardsSun(segment.end));
        const double depth = std::max(segment.opticalDepth, lit > mostSteps ? lit : 0);
        const int count = std::clamp(static_cast<int>(std::ceil(std::max(2 * std::min<double>(depth, mostSteps), turns))), 1, mostSteps)
                          << halvings;
        const double crowding = crowdingAtEnds(depth);
        for (int i = 0; i < count; ++i) {
            const double from = length * crowded(double(i) / count, crowding), step = length * crowded((i + 1.) / count, crowding) - from;
            for (std::size_t k = 0; k < steps.node.size(); ++k) {
                const double s = segment.begin + from + step * (0.5 + 0.5 * steps.node[k]);
                const Place place = moved(radius, scene.camera, scene.view, ray, s);
                air.at(place.altitude, local);
                const double before = depthBefore + profile.partialDepth(ray, segment, s);
                const double source = averageSun(scene, radius, place, across, along, [&](Vec sun) {
                    return air.transmittance(place, sun) * air.scatteredAt(local, angleBetween(sun, scene.view));
                });
                sum += 0.5 * step * steps.weight[k] * std::exp(-before) * source;
            }
        }
        depthBefore += segment.opticalDepth;
    }
    return sum;
}

} // namespace

Integral singleScattering(const Air& air, const Scene& scene, const Leg& leg, const double maxSeconds)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    Integral result{integrate(air, scene, leg, 0), 0};
    for (int halvings = 1; halvings <= mostHalvings; ++halvings) {
        const double finer = integrate(air, scene, leg, halvings);
        result = {finer, std::abs(finer - result.value)};
        if (result.error <= halvingTolerance * finer)
            break;
        if (maxSeconds > 0 && costOfHalving * std::chrono::duration<double>(Clock::now() - start).count() > maxSeconds)
            break;
    }
    return result;
}

double groundDirect(const Air& air, const Scene& scene, const Leg& leg)
{
    if (!leg.hitsGround)
        return 0;
    const double radius = air.profile().planetRadius();
    const Ray ray = rayFrom(radius, scene.camera, scene.view);
    Place ground = moved(radius, scene.camera, scene.view, ray, leg.length);
    ground.altitude = 0;
    const Rule rule = gaussLegendre(24);
    const double irradiance = averageSun(scene, radius, ground, rule, rule,
                                         [&](Vec sun) { return std::max(0.0, dot(ground.up, sun)) * air.transmittance(ground, sun); });
    return air.groundAlbedo() / std::numbers::pi * std::exp(-leg.opticalDepth) * irradiance;
}

} // namespace sky::montecarlo
