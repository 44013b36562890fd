#include "solver/field_work.hpp"
#include "physics/harmonics.hpp"
#include "physics/moments.hpp"
#include "solver/layered_light.hpp"
#include "solver/plan.hpp"
#include "solver/quality.hpp"
#include <algorithm>

namespace sky::solver {

namespace {

// Seconds on two cores of a software driver, by `earth`, `hazy-city` and `cloud`.
constexpr double secondsPerSunVisit = 2.4e-8;  // one set of wavelengths of sunlight at a node
constexpr double secondsPerTermVisit = 2.4e-9; // one set of an azimuthal or spherical term of later light

} // namespace

int eventsOf(const physics::Medium& medium)
{
    switch (airOf(medium)) {
    case Air::Clear:
    case Air::Dusty: return 5;
    case Air::Dense: return 7;
    case Air::Hazy:
    case Air::Sharp: return 6;
    case Air::Cloudy: return 9;
    }
    return 0;
}

FieldWork fieldWorkOf(const physics::Medium& medium, const Options& options, const int orders)
{
    const auto settings = qualityFor(options.quality, medium, orderTolerance(options)).moments;
    const physics::Profile profile(medium);
    const auto optics = physics::makeOptics(medium, settings.degree, settings.truncatePeaks);
    const physics::MomentGrid grid(profile, physics::largestExtinctions(optics), settings.altitudes, settings.suns,
                                   medium.sunAngularRadius);
    const double levels = grid.altitudeCount(), suns = grid.sunCount(), wavelengths = medium.wavelengthCount();
    const double sets = (medium.wavelengthCount() + 3) / 4, scatterers = double(optics.scatterers.size());
    const double directions = settings.groundDirections + settings.limbDirections + settings.skyDirections, rays = levels * directions;
    const double harmonics = physics::harmonicCount(settings.degree);
    const double lightAzimuths = settings.lightAzimuths > 0 ? std::min(settings.lightAzimuths, settings.azimuths) : settings.azimuths;
    const int events = orders > 0 ? std::max(1, orders - 1) : eventsOf(medium);

    FieldWork work{};
    work.seconds = 0.1 + secondsPerSunVisit * rays * suns * sets * lightAzimuths * settings.directNodes;
    for (int event = 2; event <= events; ++event) {
        const int azimuthal = physics::azimuthalDegree(optics, event, settings.negligibleOrder(), settings.leastAzimuthal);
        double terms = 4. * settings.azimuthsFor(azimuthal);
        for (int l = 0; l <= settings.degree; ++l)
            terms += std::min(l, azimuthal) + 1;
        work.seconds += secondsPerTermVisit * rays * suns * sets * settings.nodes * terms;
    }

    const double field = levels * suns * harmonics * wavelengths;
    const double results =
        rays * suns * sets * 16 * (settings.azimuths + (lightAzimuths < settings.azimuths ? lightAzimuths * (scatterers + 1) : 0));
    const double bound = double(resultBytes(options));
    work.bytes = field * (5 * 8 + 4 + (orders > 0 ? 0 : 4 * std::min(8, events))); // sums and moments; the fold's; kept events
    if (orders <= 0)                                                               // late events may have to be told at once
        work.bytes += LayeredLight::bytes(grid.altitudeCount(), medium.wavelengthCount(), settings.degree);
    work.bytes += 2 * (bound > 0 ? std::min(bound, results) : results);                        // on the GPU and its copy
    work.bytes += rays * settings.nodes * ((settings.degree + 1) * sets * 16 + harmonics * 4); // what depends on rays alone
    work.bytes += 2 * rays * settings.directNodes * scatterers * sets * 16;
    work.bytes += 32e6; // sources of a dispatch, twice where the driver still reads the last
    work.diskBytes = 4 * field;
    return work;
}

} // namespace sky::solver
