#include "photometry_eclipse.hpp"

#include "bodies.hpp"
#include "eclipse_view.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

constexpr double pi = 3.14159265358979323846;
/// Along a ray through the shadow.
constexpr int eclipseNodes = 400;

} // namespace

physics::EclipseBodies EclipsePhotometry::bodiesOf(const Photometer::View& view, const Moon& moon) const
{
    return showmysky::bodiesOf(sky_.model.manifest(), view.altitude, Sun{view.sunAzimuth, view.sunZenithAngle, {}},
                               moon, sky_.medium.sunAngularRadius);
}

double EclipsePhotometry::obscuration(const Photometer::View& view, const Moon& moon) const
{
    return stateOf(bodiesOf(view, moon)).obscuration;
}

std::shared_ptr<const sky::eclipse::ScatteredField>
EclipsePhotometry::fieldOf(const physics::EclipseBodies& bodies) const
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

void EclipsePhotometry::radiance(const Photometer::View& view, const Moon& moon, const unsigned layers,
                                 double* const result) const
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
    const bool ground = physics::hitsGround(planet, view.altitude, mu);
    const auto visibleAt = [&](const physics::RayNodes::Node& node) {
        const double distance = (planet.radius + view.altitude) * node.nuScale / node.sunScale;
        return shadow.visible({distance * direction[0], distance * direction[1], distance * direction[2]});
    };
    const std::size_t row = sky_.optics.scatterers.size() * wavelengths;
    physics::RayTracer tracer(sky_.profile, sky_.optics);
    auto ray = tracer.trace(entry->altitude, entry->mu, eclipseNodes, ground);
    if (layers & Photometer::singleScattering) {
        for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
            ray.nodes[k] = entry->node(ray.nodes[k]);
            const double visible = visibleAt(ray.nodes[k]);
            for (std::size_t i = 0; i < row; ++i)
                ray.weights[k * row + i] *= visible;
        }
        sky_.evaluator.singleAlong(ray, muSun, nu, true, result);
    }
    if (layers & (Photometer::multipleScattering | Photometer::zeroOrder)) {
        const auto light = fieldOf(bodies)->view({eclipseViewRay(planet, view.altitude, mu, ground)},
                                                 {std::atan2(direction[1], direction[0])});
        std::vector<double> direct(wavelengths), diffuse(wavelengths), multiple(wavelengths, 0.);
        if ((layers & Photometer::zeroOrder) && ground) {
            const auto there = entry->node(ray.ground);
            const double muSunThere = std::clamp(there.sunScale * muSun + there.nuScale * nu, -1., 1.),
                         visible = visibleAt(there);
            sky_.sun.horizontalIrradiance(0, muSunThere, direct.data());
            sky_.moments->interpolateGround(muSunThere, diffuse.data());
            for (std::size_t w = 0; w < wavelengths; ++w)
                result[w] += ray.groundTransmittance[w] * sky_.medium.groundAlbedo[w] / pi *
                             (visible * direct[w] +
                              static_cast<double>(light.groundRatio(0, 0, static_cast<int>(w))) * diffuse[w]);
        }
        if (layers & Photometer::multipleScattering) {
            auto coarse =
                tracer.trace(entry->altitude, entry->mu, physics::SkyEvaluator::Parts{}.multipleNodes, ground);
            for (auto& node : coarse.nodes)
                node = entry->node(node);
            sky_.evaluator.multipleAlong(coarse, *sky_.moments, muSun, nu, multiple.data());
            for (std::size_t w = 0; w < wavelengths; ++w)
                result[w] += static_cast<double>(light.skyRatio(0, 0, static_cast<int>(w))) * multiple[w];
        }
    }
    for (std::size_t w = 0; w < wavelengths; ++w)
        result[w] = std::max(0., result[w] * sky_.medium.solarIrradiance[w]);
}

} // namespace showmysky
