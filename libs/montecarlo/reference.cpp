#include "montecarlo/reference.hpp"

#include "base/error.hpp"
#include "montecarlo/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace sky::montecarlo {
namespace {

/// Unit vector of a zenith angle and an azimuth from the Sun's.
Vec directionOf(double zenithAngle, double relativeAzimuth)
{
    const double sine = std::sin(zenithAngle);
    return {sine * std::cos(relativeAzimuth), sine * std::sin(relativeAzimuth), std::cos(zenithAngle)};
}

/// A body at a distance from the planet's centre that the camera, at radius r above it, sees in a direction.
Vec bodyAt(Vec direction, double distance, double r)
{
    const double b = r * direction.z;
    return Vec{0, 0, r} + (std::sqrt(b * b + (distance - r) * (distance + r)) - b) * direction;
}

/// Throws RangeError with the parts as one sentence unless the condition holds.
template<class... Parts>
void require(bool condition, const Parts&... parts)
{
    if (condition)
        return;
    std::ostringstream message;
    (message << ... << parts);
    throw RangeError(message.str());
}

bool allWithin(const std::vector<double>& values, double low, double high)
{
    for (const double v : values)
        if (!(v >= low && v <= high))
            return false;
    return true;
}

void checkSpecies(const physics::Medium& medium, const physics::Species& species)
{
    constexpr double huge = 1e300;
    const std::size_t wavelengths = medium.wavelengthsNm.size();
    require(species.numberDensity.size() == medium.altitudes.size() && allWithin(species.numberDensity, 0, huge), "number density of `",
            species.name, "`: expected one finite value >= 0 per altitude node");
    require(species.extinctionCrossSection.size() == wavelengths && allWithin(species.extinctionCrossSection, 0, huge),
            "cross section of `", species.name, "`: expected one finite value >= 0 per wavelength");
    require(species.singleScatteringAlbedo.size() == wavelengths && allWithin(species.singleScatteringAlbedo, 0, 1),
            "single-scattering albedo of `", species.name, "`: expected one value within 0..1 per wavelength");
    require(!species.scatters() ||
                (species.phaseFunction.size() == medium.scatteringAngles.size() * wavelengths && allWithin(species.phaseFunction, 0, huge)),
            "phase function of `", species.name, "`: expected one finite value >= 0 per angle and wavelength");
}

bool increasing(const std::vector<double>& nodes)
{
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        if (!(nodes[i] < nodes[i + 1]))
            return false;
    return nodes.size() >= 2;
}

} // namespace

std::optional<Scene> sceneOf(const physics::Medium& medium, const Query& query)
{
    const Vec sun = directionOf(query.sunZenithAngle, 0);
    Scene scene{{query.altitude, {0, 0, 1}},
                normalized(directionOf(query.viewZenithAngle, query.relativeAzimuth)),
                SunDisc(sun, medium.sunAngularRadius)};
    if (query.moon) {
        const double r = medium.planetRadius + query.altitude;
        const Vec moon = bodyAt(directionOf(query.moon->zenithAngle, query.moon->relativeAzimuth), query.moon->distance, r);
        scene.eclipse.emplace(bodyAt(sun, query.moon->sunDistance, r), moon, query.moon->radius, medium.sunAngularRadius);
    }
    if (query.altitude > medium.topOfAtmosphere) {
        const Ray ray = rayFrom(medium.planetRadius, scene.camera, scene.view);
        const double top = radialSquare(medium.planetRadius, medium.topOfAtmosphere);
        if (ray.b >= 0 || ray.lowest() >= top)
            return std::nullopt;
        scene.camera = moved(medium.planetRadius, scene.camera, scene.view, ray, ray.down(top));
        scene.camera.altitude = medium.topOfAtmosphere;
    }
    return scene;
}

Result scaled(const Result& result, double solarIrradiance)
{
    Result r = result;
    for (double* value : {&r.single, &r.multiple, &r.singleStderr, &r.multipleStderr, &r.groundDirect})
        *value *= solarIrradiance;
    return r;
}

Reference::Reference(physics::Medium medium) : medium_(std::move(medium)), slots_(medium_.wavelengthsNm.size())
{
    require(medium_.planetRadius > 0 && medium_.topOfAtmosphere > 0, "planet radius and top of the atmosphere: expected positive lengths");
    require(medium_.sunAngularRadius >= 0 && medium_.sunAngularRadius < 1.5, "angular radius of the Sun ", medium_.sunAngularRadius,
            " rad: expected 0 to 1.5");
    require(increasing(medium_.altitudes) && medium_.altitudes.front() >= 0 && medium_.altitudes.front() <= 0,
            "altitude nodes: expected at least two, increasing from 0");
    require(medium_.groundAlbedo.size() == medium_.wavelengthsNm.size() && allWithin(medium_.groundAlbedo, 0, 1),
            "ground albedo: expected one value within 0..1 per wavelength");
    for (const physics::Species& species : medium_.species) {
        require(!species.scatters() || increasing(medium_.scatteringAngles),
                "scattering angles: expected at least two, increasing from 0 to pi");
        checkSpecies(medium_, species);
    }
}

Reference::~Reference() = default;

const Air& Reference::air(int wavelength) const
{
    Slot& slot = slots_[static_cast<std::size_t>(wavelength)];
    std::call_once(slot.once, [&] { slot.air = std::make_unique<Air>(medium_, wavelength); });
    return *slot.air;
}

void Reference::check(const Query& query) const
{
    require(query.wavelength >= 0 && query.wavelength < medium_.wavelengthCount(), "wavelength index ", query.wavelength,
            ": expected 0 to ", medium_.wavelengthCount() - 1);
    require(query.altitude >= 0 && std::isfinite(query.altitude), "camera altitude ", query.altitude, " m: expected a finite value >= 0");
    require(std::isfinite(query.sunZenithAngle) && std::isfinite(query.viewZenithAngle) && std::isfinite(query.relativeAzimuth),
            "sun zenith angle, view zenith angle and relative azimuth: expected finite values");
    if (!query.moon)
        return;
    const MoonPlace& moon = *query.moon;
    require(std::isfinite(moon.zenithAngle) && std::isfinite(moon.relativeAzimuth),
            "zenith angle and azimuth of the Moon: expected finite values");
    const double highest = medium_.planetRadius + std::max(medium_.topOfAtmosphere, query.altitude);
    require(moon.radius > 0 && moon.distance > highest + moon.radius && moon.sunDistance > moon.distance, "The Moon, ", moon.distance,
            " m from the planet's centre: expected more than ", highest + moon.radius,
            " m, which keeps it clear of the air and of the camera, and less than the Sun's distance");
}

Result Reference::radiance(const Query& query, const Settings& settings) const
{
    check(query);
    const std::optional<Scene> scene = sceneOf(medium_, query);
    Result result;
    if (!scene)
        return result;
    const Air& medium = air(query.wavelength);
    Leg leg;
    medium.profile().trace(rayFrom(medium_.planetRadius, scene->camera, scene->view), leg);
    constexpr double enough = 1; // s, which nearly all integrals end in
    const double limit = settings.maxSeconds > 0 ? std::max(enough, settings.maxSeconds) : 0;
    const Integral single = singleScattering(medium, *scene, leg, limit);
    result.single = single.value;
    result.singleStderr = single.error;
    result.groundDirect = groundDirect(medium, *scene, leg);
    if (settings.orders != 1)
        addPaths(medium, *scene, {2, settings.orders}, query, settings, result);
    return result;
}

Result Reference::singleByPaths(const Query& query, const Settings& settings) const
{
    check(query);
    Result result;
    if (const std::optional<Scene> scene = sceneOf(medium_, query))
        addPaths(air(query.wavelength), *scene, {1, 1}, query, settings, result);
    return result;
}

} // namespace sky::montecarlo
