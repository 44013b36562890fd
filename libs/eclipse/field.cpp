#include "eclipse/field.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "eclipse/state.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <atomic>
#include <cmath>

namespace sky::eclipse {

namespace {

constexpr float pi = static_cast<float>(base::pi);
constexpr int mostEvents = 60;
/// Light below this share of full sunlight is darkness: single precision loses it on the way.
constexpr double darkness = 1e-30;

/// Runs work(i) for i = 0 .. count - 1 on all cores, each taking the next that is left.
template<class Work>
void spread(int count, Work&& work)
{
    std::atomic<int> next{0};
    base::parallel([&](int, int) {
        for (int i = next++; i < count; i = next++)
            work(i);
    });
}

} // namespace

/// Memory of one task.
struct Scratch {
    Lanes planes;  // [azimuth][point]: light that leaves points towards the viewer; [point]: mixed sunlight
    Lanes light;   // [azimuth][scatterer][point]
    Lanes arrived; // [azimuth][point]
    Lanes row, moved;
    std::vector<Shifts> shifts;      // [station, then ground]: of one ray
    std::vector<const Lane*> levels; // of sunlight, of a station
    Seen seen;                       // of a station
    std::vector<float> nu;
};

ScatteredField::State::State(std::shared_ptr<const AirRays> rays, const physics::SunTable& sun_, const physics::EclipseBodies& bodies,
                             const Orders& orders_, SunlightLeft left)
    : air(std::move(rays)), sun(sun_), orders(orders_), sunlightLeft(std::move(left)), frame(bodies),
      grid(makeGrid(frame, air->settings)), fine{grid.x.refined(std::max(1, air->settings.sunlightRefinement)),
                                                 grid.y.refined(std::max(1, air->settings.sunlightRefinement))},
      turns(turnsOf(air->settings, air->degree))
{
    if (!sunlightLeft) {
        const auto shadow = physics::singlePrecision(physics::makeShadow(bodies));
        sunlightLeft = [shadow](const std::array<float, 3>& point) { return shadow.visibleSun(point); };
    }
    for (const float y : grid.y.points())
        for (const float x : grid.x.points())
            sunAt.push_back(frame.sunAt(frame.axesAt(static_cast<double>(x), static_cast<double>(y))));
    done = air->scatterers == 0 || (!orders.all && orders.orders < 2);
}

void ScatteredField::State::shine()
{
    const auto& levelsOfSun = air->sunlightLevels;
    const auto finePoints = static_cast<std::size_t>(fine.points()), groups = static_cast<std::size_t>(air->groups);
    const auto levelCount = static_cast<std::size_t>(levelsOfSun.count());
    sunlight.assign(groups * levelCount * finePoints, Lane{});
    sunnyGround.assign(groups * finePoints, Lane{});
    spread(fine.y.count(), [&](int j) {
        std::vector<double> light(static_cast<std::size_t>(air->wavelengths)), left(light);
        // One half of a lane is what the Moon leaves, the other all of it.
        const auto put = [&](Lanes& lights, std::size_t index, std::size_t stride, double share) {
            for (std::size_t w = 0; w < light.size(); ++w) {
                light[w] = light[w] > darkness ? light[w] : 0;
                left[w] = std::min(light[w], share * left[w]);
            }
            for (std::size_t g = 0; g < groups; ++g) {
                Lane &lane = lights[g * stride + index], eclipsed;
                fillLane(lane, light.data(), static_cast<int>(g), air->wavelengths);
                fillLane(eclipsed, left.data(), static_cast<int>(g), air->wavelengths);
                for (int i = 0; i < waves; ++i)
                    lane[i] = eclipsed[i];
            }
        };
        for (int i = 0; i < fine.x.count(); ++i) {
            const auto point = static_cast<std::size_t>(j * fine.x.count() + i);
            const LocalAxes axes = frame.axesAt(static_cast<double>(fine.x.points()[static_cast<std::size_t>(i)]),
                                                static_cast<double>(fine.y.points()[static_cast<std::size_t>(j)]));
            const double muSun = frame.sunAt(axes)[2];
            for (std::size_t level = 0; level < levelCount; ++level) {
                const double altitude = levelsOfSun.altitude(static_cast<int>(level));
                sun.transmittance(altitude, muSun, light.data());
                if (*std::max_element(light.begin(), light.end()) <= darkness)
                    continue;
                const Vector exact = frame.position(axes, altitude);
                const std::array<float, 3> place{static_cast<float>(exact[0]), static_cast<float>(exact[1]), static_cast<float>(exact[2])};
                const auto seen = sunlightLeft(place);
                const auto share = static_cast<double>(std::clamp(seen.share, 0.f, 1.f));
                double rise = 0; // of the middle of what is left of the Sun
                for (std::size_t k = 0; k < 3; ++k)
                    rise += static_cast<double>(seen.aside[k]) * axes.up[k];
                if (rise == 0)
                    left = light;
                else
                    sun.transmittance(altitude, muSun, left.data(), rise);
                put(sunlight, level * finePoints + point, levelCount * finePoints, share);
                if (level == 0) {
                    sun.groundIrradiance(muSun, light.data());
                    sun.groundIrradiance(muSun, left.data(), rise);
                    put(sunnyGround, point, finePoints, share);
                }
            }
        }
    });
    lit = true;
}

void ScatteredField::State::addGround(const GridRay& ray, int group, const Grid& source, const Lane* irradiance, Scratch& scratch) const
{
    scratch.planes.resize(std::max(scratch.planes.size(), static_cast<std::size_t>(source.points())));
    if (mix(&irradiance, 1, &ray.ground[static_cast<std::size_t>(group)], 1, source.points(), scratch.planes.data()))
        addShiftedToAll(scratch.shifts.back(), source, scratch.planes.data(), scratch.moved.data(), scratch.arrived.data(), grid.points());
}

void ScatteredField::State::directRay(const GridRay& ray, int group, Scratch& scratch) const
{
    const int gridPoints = grid.points(), finePoints = fine.points(), azimuths = turn().count, scatterers = air->scatterers;
    const int entries = static_cast<int>(ray.direct.levels.size());
    const auto g = static_cast<std::size_t>(group);
    const Lane* levels = &sunlight[g * static_cast<std::size_t>(air->sunlightLevels.count() * finePoints)];
    scratch.planes.resize(static_cast<std::size_t>(finePoints));
    scratch.light.assign(static_cast<std::size_t>(scatterers * azimuths * gridPoints), Lane{});
    for (std::size_t k = 0; k < ray.direct.stations.size(); ++k) {
        const Station& station = ray.direct.stations[k];
        scratch.levels.clear();
        for (int e = 0; e < station.count; ++e)
            scratch.levels.push_back(levels + ray.direct.levels[static_cast<std::size_t>(station.first + e)] * finePoints);
        const Lane* weights = &ray.directWeights[static_cast<std::size_t>((group * entries + station.first) * scatterers)];
        for (int s = 0; s < scatterers; ++s)
            if (mix(scratch.levels.data(), station.count, weights + s, scatterers, finePoints, scratch.planes.data()))
                addShiftedToAll(scratch.shifts[k], fine, scratch.planes.data(), scratch.moved.data(),
                                &scratch.light[static_cast<std::size_t>(s * gridPoints)], scatterers * gridPoints);
    }
    const Lane* phase = &air->phase[g * static_cast<std::size_t>(scatterers * (air->degree + 1))];
    const float sine = std::sqrt(std::max(0.f, 1 - ray.mu * ray.mu));
    scratch.nu.resize(points());
    for (int a = 0; a < azimuths; ++a) {
        const auto c = static_cast<float>(std::cos(turn().azimuth(a))), s = static_cast<float>(std::sin(turn().azimuth(a)));
        for (std::size_t p = 0; p < points(); ++p)
            scratch.nu[p] = std::clamp(ray.mu * static_cast<float>(sunAt[p][2]) +
                                           sine * (c * static_cast<float>(sunAt[p][0]) + s * static_cast<float>(sunAt[p][1])),
                                       -1.f, 1.f);
        scatterSunlight(air->degree, scatterers, phase, scratch.nu.data(),
                        &scratch.light[static_cast<std::size_t>(a * scatterers * gridPoints)], gridPoints,
                        &scratch.arrived[static_cast<std::size_t>(a * gridPoints)]);
    }
    if (ray.hitsGround)
        addGround(ray, group, fine, &sunnyGround[g * static_cast<std::size_t>(finePoints)], scratch);
}

void ScatteredField::State::scatteredRay(const GridRay& ray, int group, Scratch& scratch) const
{
    const int gridPoints = grid.points(), azimuths = turn().count, entries = static_cast<int>(ray.scattered.levels.size());
    scratch.seen.degree = last.degree;
    scratch.seen.terms = physics::harmonicCount(air->degree);
    scratch.planes.resize(static_cast<std::size_t>(azimuths * gridPoints));
    std::fill(scratch.arrived.begin(), scratch.arrived.end(), Lane{});
    for (std::size_t k = 0; k < ray.scattered.stations.size(); ++k) {
        const Station& station = ray.scattered.stations[k];
        scratch.seen.levels.clear();
        for (int e = 0; e < station.count; ++e)
            scratch.seen.levels.push_back(momentsAt(last, group, ray.scattered.levels[static_cast<std::size_t>(station.first + e)]));
        scratch.seen.coefficients = &ray.coefficients[static_cast<std::size_t>((group * entries + station.first) * scratch.seen.terms)];
        radiate(turn(), scratch.seen, gridPoints, scratch.planes.data());
        for (int a = 0; a < azimuths; ++a)
            addShifted(scratch.shifts[k], a, grid.x.count(), &scratch.planes[static_cast<std::size_t>(a * gridPoints)],
                       &scratch.planes[static_cast<std::size_t>(turn().mirror(a) * gridPoints)], scratch.row.data(),
                       &scratch.arrived[static_cast<std::size_t>(a * gridPoints)]);
    }
    if (ray.hitsGround)
        addGround(ray, group, grid, &last.irradiance[static_cast<std::size_t>(group) * points()], scratch);
}

void ScatteredField::State::gatherLevel(int level, Light& light) const
{
    Scratch scratch;
    scratch.row.resize(static_cast<std::size_t>(grid.x.count()));
    scratch.moved.resize(static_cast<std::size_t>(fine.y.count() * grid.x.count()));
    scratch.arrived.resize(static_cast<std::size_t>(turn().count) * points());
    const bool direct = events == 0;
    const Grid& source = direct ? fine : grid;
    for (const GridRay& ray : air->rays[static_cast<std::size_t>(level)]) {
        scratch.shifts.clear();
        for (const Station& station : (direct ? ray.direct : ray.scattered).stations)
            scratch.shifts.emplace_back(source, grid, turn(), station.distance);
        if (ray.hitsGround)
            scratch.shifts.emplace_back(source, grid, turn(), ray.groundDistance);
        for (int g = 0; g < air->groups; ++g) {
            if (direct)
                directRay(ray, g, scratch);
            else
                scatteredRay(ray, g, scratch);
            const auto group = static_cast<std::size_t>(g);
            Lane* irradiance = level == 0 && ray.mu > 0 ? &light.irradiance[group * points()] : nullptr;
            project(turn(), scratch.arrived.data(), ray.factors.data(), 2 * pi * ray.weight, grid.points(),
                    &light.moments[(group * levels() + static_cast<std::size_t>(level)) * points() * light.harmonics()], irradiance,
                    ray.mu);
        }
    }
}

Light ScatteredField::State::gather() const
{
    const auto groups = static_cast<std::size_t>(air->groups), harmonics = static_cast<std::size_t>(allHarmonics(turn().degree));
    Light light{turn().degree, Lanes(groups * levels() * points() * harmonics, Lane{}), Lanes(groups * points(), Lane{})};
    spread(air->levels.count(), [&](int level) { gatherLevel(level, light); });
    return light;
}

void ScatteredField::State::add(const Light& light)
{
    if (total.moments.empty()) {
        total = light;
        return;
    }
    for (std::size_t i = 0, k = 0; i < light.moments.size(); i += light.harmonics(), k += total.harmonics())
        for (std::size_t h = 0; h < light.harmonics(); ++h)
            total.moments[k + h] += light.moments[i + h];
    for (std::size_t i = 0; i < light.irradiance.size(); ++i)
        total.irradiance[i] += light.irradiance[i];
}

bool ScatteredField::State::known()
{
    if (!convergence)
        convergence.emplace(*air, frame.cameraAltitude());
    return convergence->add(look(last, convergence->views(), convergence->azimuths())) <= orders.tolerance || events >= mostEvents;
}

void ScatteredField::State::close()
{
    // The tail has the shape of the last event in all harmonics.
    for (std::size_t point = 0; point < last.moments.size() / last.harmonics(); ++point) {
        const Lane *ours = &last.moments[point * last.harmonics()], *earlier = &before.moments[point * before.harmonics()];
        for (int w = 0; w < lanes; ++w) {
            const float tail = tailOf((*ours)[w], (*earlier)[w]);
            for (std::size_t h = 0; h < last.harmonics(); ++h)
                total.moments[point * total.harmonics() + h][w] += tail * ours[h][w];
        }
    }
    for (std::size_t i = 0; i < total.irradiance.size(); ++i)
        for (int w = 0; w < lanes; ++w)
            total.irradiance[i][w] += tailOf(last.irradiance[i][w], before.irradiance[i][w]) * last.irradiance[i][w];
}

ScatteredField::ScatteredField(std::shared_ptr<const AirRays> rays, const physics::SunTable& sun, const physics::EclipseBodies& bodies,
                               const Orders& orders, SunlightLeft left)
    : state_(std::make_unique<State>(std::move(rays), sun, bodies, orders, std::move(left)))
{
}

ScatteredField::~ScatteredField() = default;
ScatteredField::ScatteredField(ScatteredField&&) noexcept = default;
ScatteredField& ScatteredField::operator=(ScatteredField&&) noexcept = default;

bool ScatteredField::step()
{
    State& s = *state_;
    if (s.done)
        return true;
    if (!s.lit) {
        s.shine();
        return false;
    }
    Light light = s.gather();
    s.before = std::move(s.last);
    s.last = std::move(light);
    ++s.events;
    s.add(s.last);
    s.done = s.orders.all ? s.known() : s.events >= s.orders.orders - 1;
    if (s.done && s.orders.all)
        s.close();
    return s.done;
}

double ScatteredField::fractionDone() const
{
    const State& s = *state_;
    if (s.done)
        return 1;
    const double worked = s.lit ? 0.2 + s.events : 0;
    return s.orders.all ? 1 - std::pow(0.75, worked) : worked / (0.2 + s.orders.orders - 1);
}

int ScatteredField::events() const { return state_->events; }

} // namespace sky::eclipse
