#include "solver/iterate.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include "solver/event_series.hpp"
#include "solver/event_tail.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace sky::solver {

namespace {

using base::pi;
/// Events that are computed one by one where all are wanted. What then is not closed dies out slowly: light in deep air.
constexpr int mostSingly = 16;
/// What is told as left, as a part of all light, from which on nothing is told.
constexpr double untold = 1;
/// Times that light to begin with is told anew, from its own shape.
constexpr int reshapings = 3;

using physics::harmonicCount;
using physics::harmonicIndex;

/// Levels whose rays are gathered together: as many as memory allows.
struct Block {
    int firstLevel, levels;
    std::vector<RayStart> starts;
    std::optional<ScatteredRays> scattered; ///< kept from event to event
};

class Sweeps
{
public:
    Sweeps(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const physics::MomentSettings& settings,
           std::size_t blockBytes)
        : api_(api), scene_(scene), grid_(grid), settings_(settings),
          lightAzimuths_(settings.lightAzimuths > 0 ? std::min(settings.lightAzimuths, settings.azimuths) : settings.azimuths),
          samples_(api, sunCosines(), azimuthCosines(settings.azimuths)), lightSamples_(api, sunCosines(), azimuthCosines(lightAzimuths_))
    {
        makeBlocks(blockBytes);
        std::size_t rays = 0;
        for (const Block& block : blocks_)
            rays = std::max(rays, block.starts.size());
        results_.emplace(api, "sweep radiance", rays * bytesPerRay(samples_));
        if (lightApart())
            light_.emplace(api, "sunlight", rays * (scene.scatterers() + 1) * bytesPerRay(lightSamples_));
    }

    enum class First { all, groundOnly };
    Sums direct(First which, const Breath& breath)
    {
        const bool apart = which == First::all && lightApart();
        using Purpose = DirectGather::Purpose;
        DirectGather gather(api_, scene_,
                            which == First::groundOnly ? Purpose::groundField
                            : apart                    ? Purpose::fieldLight
                                                       : Purpose::field,
                            {});
        std::optional<PhaseGather> phases;
        if (apart)
            phases.emplace(api_, scene_, lightAzimuths_, samples_.azimuths);
        Sums sums = nothing();
        for (const Block& block : blocks_) {
            const DirectRays rays(api_, DirectRayData(scene_, block.starts, settings_.directNodes, true));
            if (apart) {
                gather.gather(rays, lightSamples_, stridesOf(lightSamples_), std::vector<bool>(scene_.scatterers() + 1), *light_, breath);
                phases->gather(rays, samples_, stridesOf(samples_), *light_, *results_, breath);
            } else
                gather.gather(rays, samples_, stridesOf(samples_), {}, *results_, breath);
            project(block, settings_.degree, samples_.azimuths, sums);
        }
        return checked(std::move(sums));
    }

    /// Light of event `event`, scattered or reflected once more than the field.
    Sums scattered(const physics::Moments& field, int event, const Breath& breath)
    {
        if (!gather_)
            gather_.emplace(api_, scene_, std::vector<std::array<double, 4>>{});
        const int azimuthal = physics::azimuthalDegree(scene_.optics, event, settings_.negligibleOrder(), settings_.leastAzimuthal);
        const SunSamples samples(api_, sunCosines(), azimuthCosines(settings_.azimuthsFor(azimuthal)));
        const FoldField foldable(field, sweepRefinement);
        Sums sums = nothing();
        for (Block& block : blocks_) {
            if (!block.scattered)
                block.scattered.emplace(api_, scene_, grid_, block.starts,
                                        ScatteredRaySettings{settings_.nodes, settings_.stationTolerance, true});
            gather_->gather(*block.scattered, foldable, azimuthal, samples, stridesOf(samples), *results_, breath);
            project(block, azimuthal, samples.azimuths, sums);
        }
        return checked(std::move(sums));
    }

    /// The same scattering, of light that is everywhere the same; once scattered() has traced the rays.
    ///   light  what there is of it, for its shape; null: as bright everywhere
    LayeredLight layers(const Sums* light) const
    {
        const int levels = grid_.altitudeCount(), wavelengths = scene_.optics.wavelengths;
        const std::size_t perPoint = std::size_t(harmonicCount(settings_.degree)) * wavelengths;
        std::vector<double> shape(std::size_t(levels) * wavelengths, light ? physics::darkness : 1);
        if (light)
            for (std::size_t point = 0; point < std::size_t(levels) * samples_.suns; ++point)
                for (int w = 0; w < wavelengths; ++w)
                    shape[point / samples_.suns * wavelengths + w] += std::max(0., light->moments[point * perPoint + w]);
        LayeredLight result(std::move(shape), wavelengths, settings_.degree, !light);
        for (const Block& block : blocks_)
            result.add(*block.scattered, directions_, block.firstLevel, block.levels);
        result.factorise();
        return result;
    }

    physics::Moments toMoments(const Sums& sums) const
    {
        const int count = harmonicCount(settings_.degree), wavelengths = scene_.optics.wavelengths;
        physics::Moments m{grid_, settings_.degree, wavelengths, sums.moments, {}};
        for (int a = 0; a < grid_.altitudeCount(); ++a)
            for (int j = 0; j < grid_.sunCount(); ++j) {
                double* v = m.at(a, j);
                for (int w = 0; w < wavelengths; ++w) {
                    const double whole = std::max(v[w], physics::darkness);
                    for (int lm = 1; lm < count; ++lm)
                        v[lm * wavelengths + w] /= whole;
                    v[w] = std::log(whole);
                }
            }
        m.groundIrradiance.assign(sums.irradiance.begin(), sums.irradiance.begin() + grid_.sunCount() * wavelengths);
        return m;
    }

    int suns() const { return samples_.suns; }

private:
    bool lightApart() const { return lightAzimuths_ < settings_.azimuths; }

    std::size_t bytesPerRay(const SunSamples& samples) const
    {
        return std::size_t(samples.suns) * samples.azimuths * scene_.sets() * 4 * sizeof(float);
    }

    void makeBlocks(const std::size_t most)
    {
        const std::size_t perRay = bytesPerRay(samples_) + (lightApart() ? (scene_.scatterers() + 1) * bytesPerRay(lightSamples_) : 0);
        for (int a = 0; a < grid_.altitudeCount(); ++a) {
            const double h = grid_.altitudes()[a];
            directions_.push_back(physics::directionsAt(scene_.profile.planet(), h, settings_));
            const auto& set = directions_.back();
            if (blocks_.empty() || (most > 0 && (blocks_.back().starts.size() + set.mu.size()) * perRay > most))
                blocks_.push_back({a, 0, {}, {}});
            ++blocks_.back().levels;
            for (std::size_t d = 0; d < set.mu.size(); ++d)
                blocks_.back().starts.push_back({h, set.mu[d], set.hitsGround[d]});
        }
    }

    Sums nothing() const
    {
        const std::size_t points = std::size_t(grid_.altitudeCount()) * samples_.suns, wavelengths = scene_.optics.wavelengths;
        return {std::vector<double>(points * harmonicCount(settings_.degree) * wavelengths, 0.),
                std::vector<double>(points * wavelengths, 0.)};
    }

    std::vector<float> sunCosines() const
    {
        std::vector<float> values;
        for (int j = 0; j < grid_.sunCount(); ++j)
            values.push_back(static_cast<float>(std::sin(grid_.sunElevation(j))));
        return values;
    }

    static std::vector<float> azimuthCosines(int count)
    {
        std::vector<float> values;
        for (int k = 0; k < count; ++k)
            values.push_back(static_cast<float>(std::cos(pi * (k + 0.5) / count)));
        return values;
    }

    static Strides stridesOf(const SunSamples& samples) { return {samples.suns * samples.azimuths, samples.azimuths, 1}; }

    /// Moments by quadrature: Gauss-Legendre in mu on each panel, midpoints in azimuth (exact for trigonometric polynomials).
    /// Azimuthal orders above `azimuthal` stay zero.
    void project(const Block& block, const int azimuthal, const int azimuths, Sums& sums) const
    {
        const auto radiance = results_->download();
        const int degree = settings_.degree, count = harmonicCount(degree), wavelengths = scene_.optics.wavelengths;
        const int suns = samples_.suns, stride = scene_.sets() * 4;
        std::vector<double> waves(azimuths * (azimuthal + 1));
        for (int k = 0; k < azimuths; ++k)
            for (int m = 0; m <= azimuthal; ++m)
                waves[k * (azimuthal + 1) + m] = std::cos(m * pi * (k + 0.5) / azimuths) * 2 * pi / azimuths;
        base::parallel([&](int thread, int threads) {
            std::vector<double> factors(count), byAzimuth((azimuthal + 1) * wavelengths);
            for (int level = thread; level < block.levels; level += threads) {
                const int a = block.firstLevel + level;
                const auto& set = directions_[a];
                std::size_t firstRay = 0;
                for (int below = block.firstLevel; below < a; ++below)
                    firstRay += directions_[below].mu.size();
                for (std::size_t d = 0; d < set.mu.size(); ++d) {
                    physics::harmonicFactors(degree, set.mu[d], factors.data());
                    for (int j = 0; j < suns; ++j) {
                        const float* values = &radiance[((firstRay + d) * suns + j) * azimuths * stride];
                        std::fill(byAzimuth.begin(), byAzimuth.end(), 0.);
                        for (int k = 0; k < azimuths; ++k)
                            for (int m = 0; m <= azimuthal; ++m)
                                for (int w = 0; w < wavelengths; ++w)
                                    byAzimuth[m * wavelengths + w] += waves[k * (azimuthal + 1) + m] * double(values[k * stride + w]);
                        double* moments = &sums.moments[(std::size_t(a) * suns + j) * count * wavelengths];
                        for (int l = 0; l <= degree; ++l)
                            for (int m = 0; m <= std::min(l, azimuthal); ++m) {
                                const double y = set.weight[d] * factors[harmonicIndex(l, m)];
                                for (int w = 0; w < wavelengths; ++w)
                                    moments[harmonicIndex(l, m) * wavelengths + w] += y * byAzimuth[m * wavelengths + w];
                            }
                        if (set.mu[d] > 0)
                            for (int w = 0; w < wavelengths; ++w)
                                sums.irradiance[(std::size_t(a) * suns + j) * wavelengths + w] += set.weight[d] * set.mu[d] * byAzimuth[w];
                    }
                }
            }
        });
    }

    Sums checked(Sums sums) const
    {
        const std::size_t suns = samples_.suns, count = harmonicCount(settings_.degree), wavelengths = scene_.optics.wavelengths;
        for (std::size_t i = 0; i < sums.moments.size(); ++i)
            if (!std::isfinite(sums.moments[i]))
                throw NumericsError("moments: the value at altitude level " + std::to_string(i / (suns * count * wavelengths)) + ", Sun " +
                                    std::to_string(i / (count * wavelengths) % suns) + ", harmonic " +
                                    std::to_string(i / wavelengths % count) + ", wavelength " + std::to_string(i % wavelengths) +
                                    " is not finite. This is an error of calcmysky or of the "
                                    "OpenGL driver; try another one with --device or --gl.");
        return sums;
    }

    gl::Api api_;
    const Scene scene_;
    const physics::MomentGrid& grid_;
    const physics::MomentSettings& settings_;
    const int lightAzimuths_;
    const SunSamples samples_, lightSamples_;
    std::vector<physics::Directions> directions_; // [level]
    std::vector<Block> blocks_;
    std::optional<gl::Buffer> results_, light_; // of one block
    std::optional<ScatteredGather> gather_;
};

/// Light whose late events are told at once.
struct Closed {
    Sums earlier;     ///< events before the last that was computed by itself
    Sums rest;        ///< that one and all that follow
    double remainder; ///< what is left, as EventTail says; infinite where that tells nothing
};

/// Where each event is so little weaker than the last that those to come are told from sweeps over all of them: as many as it takes, or as
/// are of use.
///   sum     of the events so far, with the last
///   count   of sweeps; goes on
Closed close(Sweeps& sweeps, const Sums& sum, const Sums& last, double tolerance, int& count, const Breath& breath)
{
    Closed result{sum, {}, std::numeric_limits<double>::infinity()};
    addTo(result.earlier, last, -1);
    EventTail tail(last, sweeps.layers(nullptr), sweeps.suns());
    for (int i = 0; i < reshapings; ++i)
        tail.begin(sweeps.layers(&tail.light()));
    const int next = count + 1;
    bool settled = false; // whether what is told of the answer is
    do {
        const Sums swept = sweeps.scattered(sweeps.toMoments(tail.light()), next, breath);
        tail.improve(swept, result.earlier, sweeps.layers(&tail.light()));
        ++count;
        // Near the end changes leap. What few sweeps made guess is worth less than what more of them tell.
        const bool told = std::isfinite(tail.remainder()), surer = tail.settled() && !settled;
        if (surer || (told && (tail.settled() || tail.remainder() < result.remainder))) {
            result.remainder = tail.remainder();
            result.rest = tail.light();
            settled = tail.settled();
        }
    } while (!(result.remainder < tolerance) && !tail.stalls());
    if (!(result.remainder < untold))
        result.remainder = std::numeric_limits<double>::infinity();
    return result;
}

} // namespace

RadiationField iterate(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const physics::MomentSettings& settings,
                       const OrderLimit& limit, bool keepEvents, const std::function<void(double)>& breath, std::size_t blockBytes)
{
    const int wanted = limit.all ? limit.most : limit.orders - 1;
    const int harmonics = harmonicCount(settings.degree), wavelengths = scene.optics.wavelengths;
    RadiationField field;
    const auto fractionOf = [&](int event) { return limit.all ? 1 - std::pow(0.7, event) : double(event) / std::max(1, wanted); };

    Sweeps sweeps(api, scene, grid, settings, blockBytes);
    if (keepEvents)
        field.firstFromGround = sweeps.toMoments(sweeps.direct(Sweeps::First::groundOnly, [&] { breath(0); }));
    EventSeries series(harmonics, wavelengths, limit.all);
    Sums last = sweeps.direct(Sweeps::First::all, [&] { breath(0); });
    const auto keep = [&] {
        series.add(last);
        ++field.eventCount;
        field.irradiance.push_back(last.irradiance);
        if (keepEvents)
            field.perEvent.push_back(sweeps.toMoments(last));
    };
    keep();
    std::optional<Closed> late;
    int nextLook = mostSingly; // event after which to ask where it leads to go on
    double halfwayChange = 0;  // by the event at half its number
    const double tolerance = limit.tolerance > 0 ? limit.tolerance : limit.all ? settings.tolerance : 0;
    for (int event = 2; event <= wanted; ++event) {
        last = sweeps.scattered(sweeps.toMoments(last), event, [&] { breath(fractionOf(field.eventCount)); });
        keep();
        if (!(tolerance > 0))
            continue;
        field.remainder = late ? series.remainder() : series.change();
        if (field.remainder < tolerance)
            break;
        if (2 * event == nextLook)
            halfwayChange = series.change();
        if (!limit.all || event != nextLook)
            continue;
        if (!late)
            late = close(sweeps, series.sum(), last, tolerance, field.eventCount, [&] { breath(fractionOf(field.eventCount)); });
        const double promised = leftAfter(halfwayChange, series.change(), event, wanted);
        if (late->remainder < std::max(tolerance, promised)) {
            // Those that are allowed would leave more: light that spreads by diffusion, on which it takes minutes to find out.
            field.remainder = std::max(field.remainder, promised);
            break;
        }
        if (event > mostSingly && !(promised < untold)) {
            field.remainder = std::max(field.remainder, untold); // neither way leads anywhere
            break;
        }
        halfwayChange = series.change();
        nextLook *= 2;
    }
    Sums total, rest; // the latter: of the last event and all that follow
    if (late && late->remainder < field.remainder) {
        // Nearer than what came one by one after it.
        field.remainder = late->remainder;
        rest = std::move(late->rest);
        total = std::move(late->earlier);
        addTo(total, rest, 1);
        field.irradiance.resize(mostSingly);
        if (keepEvents)
            field.perEvent.resize(mostSingly);
    } else {
        // A guess at what follows that may be wrong by all light there is lit black ground under air 1000 deep, where next to no light comes.
        total = rest = field.remainder < untold ? series.total() : series.sum();
        addTo(rest, series.sum(), -1);
        addTo(rest, last, 1);
    }
    field.ended = !(limit.all && tolerance > 0) || field.remainder < tolerance;
    field.irradiance.back() = rest.irradiance;
    if (keepEvents)
        field.perEvent.back() = sweeps.toMoments(rest);
    field.total = sweeps.toMoments(total);
    breath(1);
    return field;
}

} // namespace sky::solver
