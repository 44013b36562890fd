// The spectral radiance of a single direction, followed along its own ray in double precision: what probes and the tests of pictures ask.
#include "scene.hpp"

#include "base/angles.hpp"
#include "base/not_negative.hpp"
#include "bodies.hpp"
#include "physics/air_entry.hpp"
#include "physics/sky.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

using sky::base::pi;

std::vector<double> Scene::spectralRadiance(const std::array<double, 3>& direction)
{
    const auto& medium = atmosphere_->medium;
    const auto& optics = atmosphere_->optics;
    const auto wavelengths = static_cast<std::size_t>(atmosphere_->wavelengths());
    std::vector<double> result(wavelengths, 0.);
    const double size = std::hypot(direction[0], direction[1], direction[2]);
    if (!(size > 0))
        return result;
    std::array<double, 3> view{direction[0] / size, direction[1] / size, direction[2] / size};
    const double horizon = physics::horizonElevation(atmosphere_->planet(), settings_.altitude);
    const double elevation = std::asin(std::clamp(view[2], -1., 1.));
    bool ground = elevation < horizon;
    if (ground && settings_.pseudoMirror) {
        const double mirrored = 2 * horizon - elevation, flat = std::max(std::hypot(view[0], view[1]), 1e-12);
        view = {view[0] / flat * std::cos(mirrored), view[1] / flat * std::cos(mirrored), std::sin(mirrored)};
        ground = false;
    }
    const auto entry = enterAir(atmosphere_->planet(), settings_.altitude, view[2]);
    if (!entry)
        return result;
    const auto sunDirection = directionOf(settings_.sun.azimuth, settings_.sun.zenithAngle);
    const double muSun = sunDirection[2];
    const double nu = std::clamp(view[0] * sunDirection[0] + view[1] * sunDirection[1] + view[2] * sunDirection[2], -1., 1.);
    const LayersUsed layers = layersUsed();
    physics::RayTracer tracer(atmosphere_->profile, optics);
    const physics::SkyEvaluator evaluator(medium, atmosphere_->profile, optics, *sun_, &atmosphere_->aureole);
    physics::SkyEvaluator::Parts parts;
    // An eclipse has edges along the ray.
    const bool eclipse = settings_.eclipse == EclipseMode::on;
    std::vector<double> visible(wavelengths, 1.);
    EclipseSky::Ratios ratios{visible, visible};
    if (eclipse) {
        while (!ready_)
            step();
        parts.singleNodes = nodesInShadow;
        if (moments_ && (layers.multiple || (layers.ground && ground)))
            ratios = eclipse_->ratios(view, ground);
    }

    auto ray = tracer.trace(entry->altitude, entry->mu, atmosphere_->profile.forShadows(parts.singleNodes, sunRadius()), ground);
    std::vector<physics::MiddleOfLight> middles(eclipse ? ray.nodes.size() : 0);
    for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
        ray.nodes[k] = entry->node(ray.nodes[k]);
        for (std::size_t i = 0; i < layers.single.size(); ++i)
            if (!layers.single[i])
                std::fill_n(&ray.weights[(k * layers.single.size() + i) * wavelengths], wavelengths, 0.);
        if (!eclipse)
            continue;
        middles[k] = eclipse_->visibleAt(view, ray.nodes[k], visible.data());
        for (std::size_t i = 0; i < layers.single.size(); ++i)
            for (std::size_t w = 0; w < wavelengths; ++w)
                ray.weights[(k * layers.single.size() + i) * wavelengths + w] *= visible[w];
    }
    evaluator.singleAlong(ray, muSun, nu, true, result.data(), middles,
                          atmosphere_->aureole.depths(tracer, settings_.altitude, muSun, std::acos(nu)));
    if (layers.ground && ground) {
        const auto there = entry->node(ray.ground);
        const double muSunThere = std::clamp(there.sunScale * muSun + there.nuScale * nu, -1., 1.);
        std::vector<double> direct(wavelengths), diffuse(wavelengths, 0.);
        std::fill(visible.begin(), visible.end(), 1.);
        const double rise = eclipse ? eclipse_->visibleAt(view, there, visible.data()).rise : 0;
        sun_->groundIrradiance(muSunThere, direct.data(), rise);
        if (moments_)
            moments_->interpolateGround(muSunThere, diffuse.data());
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] +=
                ray.groundTransmittance[w] * medium.groundAlbedo[w] / pi * (visible[w] * direct[w] + ratios.ground[w] * diffuse[w]);
    }
    if (layers.multiple && moments_) {
        auto coarse = tracer.trace(entry->altitude, entry->mu, parts.multipleNodes, ground, physics::NodesFor::Field);
        for (auto& node : coarse.nodes)
            node = entry->node(node);
        std::vector<double> multiple(wavelengths, 0.);
        evaluator.multipleAlong(coarse, *moments_, muSun, nu, multiple.data());
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] += ratios.sky[w] * multiple[w];
    }
    for (std::size_t w = 0; w < wavelengths; ++w)
        result[w] = sky::base::notNegative(result[w]) * medium.solarIrradiance[w] *
                    (settings_.solarSpectrumFactors.empty() ? 1 : settings_.solarSpectrumFactors[w]);
    if (settings_.layers.lightPollution && !settings_.cities.empty())
        cities_->addRadiance(settings_.cities, settings_.altitude, view, result.data());
    if (settings_.layers.lightPollution && settings_.lightPollutionLuminance > 0) {
        std::vector<double> glow(wavelengths);
        glow_->radiance(settings_.altitude, view[2], glow.data());
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] += glow[w] * settings_.lightPollutionLuminance;
    }
    return result;
}

} // namespace showmysky
