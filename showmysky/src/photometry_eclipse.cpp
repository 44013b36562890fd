#include "photometry_eclipse.hpp"

#include "base/angles.hpp"
#include "bodies.hpp"
#include "eclipse_view.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::pi;

} // namespace

physics::EclipseBodies EclipsePhotometry::bodiesOf(const Photometer::View& view, const Moon& moon) const
{
    return showmysky::bodiesOf(sky_.model.manifest(), view.altitude, Sun{view.sunAzimuth, view.sunZenithAngle, {}}, moon,
                               sky_.medium.sunAngularRadius);
}

double EclipsePhotometry::obscuration(const Photometer::View& view, const Moon& moon) const
{
    return stateOf(bodiesOf(view, moon)).obscuration;
}

std::shared_ptr<const sky::eclipse::ScatteredField> EclipsePhotometry::fieldOf(const physics::EclipseBodies& bodies) const
{
    const std::lock_guard lock(mutex_);
    if (field_ && samePlaces(known_, bodies))
        return field_;
    if (!air_)
        air_ = sky::eclipse::traceAir(sky_.medium, sky_.profile, sky_.optics, {});
    sky::eclipse::Orders orders;
    orders.orders = sky_.model.manifest().scatteringOrders;
    orders.all = sky_.model.manifest().allScatteringOrders;
    auto field = std::make_shared<sky::eclipse::ScatteredField>(air_, sky_.sun, bodies, orders);
    while (!field->step()) {
    }
    known_ = bodies;
    return field_ = std::move(field);
}

void EclipsePhotometry::radiance(const Photometer::View& view, const Moon& moon, const unsigned layers, double* const result) const
{
    const auto wavelengths = static_cast<std::size_t>(sky_.medium.wavelengthCount());
    std::fill_n(result, wavelengths, 0.);
    const auto bodies = bodiesOf(view, moon);
    const auto shadow = physics::makeShadow(bodies);
    const auto& planet = sky_.profile.planet();
    const auto direction = directionOf(view.viewAzimuth, view.viewZenithAngle);
    const double mu = direction[2], muSun = bodies.sunDirection[2];
    const double nu = std::clamp(physics::Shadow::dot(direction, bodies.sunDirection), -1., 1.);
    const auto entry = enterAir(planet, view.altitude, mu);
    if (!entry)
        return;
    const bool hitsGround = physics::hitsGround(planet, view.altitude, mu);
    const auto sunAt = [&](const physics::RayNodes::Node& node) { return sunSeen(shadow, planet, view.altitude, direction, node); };
    const std::size_t row = sky_.optics.scatterers.size() * wavelengths;
    physics::RayTracer tracer(sky_.profile, sky_.optics);
    auto ray = tracer.trace(entry->altitude, entry->mu, nodesInShadow, hitsGround);
    if (layers & Photometer::singleScattering) {
        std::vector<physics::MiddleOfLight> middles(ray.nodes.size());
        for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
            ray.nodes[k] = entry->node(ray.nodes[k]);
            const SunSeen sun = sunAt(ray.nodes[k]);
            middles[k] = sun.middle;
            for (std::size_t i = 0; i < row; ++i)
                ray.weights[k * row + i] *= sun.share;
        }
        sky_.evaluator.singleAlong(ray, muSun, nu, true, result, middles, sky_.aureole.depths(tracer, view.altitude, muSun, std::acos(nu)));
    }
    const bool multiple = (layers & Photometer::multipleScattering) && sky_.moments,
               ground = (layers & Photometer::zeroOrder) && hitsGround;
    std::vector<double> light(wavelengths), skyRatio(wavelengths, 1.), groundRatio(wavelengths, 1.);
    if (sky_.moments && (multiple || ground)) {
        const auto field =
            fieldOf(bodies)->view({eclipseViewRay(planet, view.altitude, mu, hitsGround)}, {std::atan2(direction[1], direction[0])});
        for (int w = 0; w < field.wavelengths; ++w) {
            skyRatio[static_cast<std::size_t>(w)] = static_cast<double>(field.skyRatio(0, 0, w));
            groundRatio[static_cast<std::size_t>(w)] = static_cast<double>(field.groundRatio(0, 0, w));
        }
    }
    if (ground) {
        const auto there = entry->node(ray.ground);
        const double muSunThere = std::clamp(there.sunScale * muSun + there.nuScale * nu, -1., 1.);
        const SunSeen sun = sunAt(there);
        const auto addReflected = [&](const auto& share) {
            for (std::size_t w = 0; w < wavelengths; ++w)
                result[w] += ray.groundTransmittance[w] * sky_.medium.groundAlbedo[w] / pi * share(w) * light[w];
        };
        sky_.sun.groundIrradiance(muSunThere, light.data(), sun.middle.rise);
        addReflected([&](std::size_t) { return sun.share; });
        if (sky_.moments) {
            sky_.moments->interpolateGround(muSunThere, light.data());
            addReflected([&](std::size_t w) { return groundRatio[w]; });
        }
    }
    if (multiple) {
        auto coarse =
            tracer.trace(entry->altitude, entry->mu, physics::SkyEvaluator::Parts{}.multipleNodes, hitsGround, physics::NodesFor::Field);
        for (auto& node : coarse.nodes)
            node = entry->node(node);
        std::fill(light.begin(), light.end(), 0.);
        sky_.evaluator.multipleAlong(coarse, *sky_.moments, muSun, nu, light.data());
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] += skyRatio[w] * light[w];
    }
    sky_.finishRadiance(result);
}

} // namespace showmysky
