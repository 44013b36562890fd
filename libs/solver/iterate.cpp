#include "solver/iterate.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include "solver/event_series.hpp"
#include <algorithm>
#include <cmath>

namespace sky::solver {

namespace {

using base::pi;
constexpr int mostEvents = 200;

using physics::harmonicCount;
using physics::harmonicIndex;

class Sweeps
{
public:
    Sweeps(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const physics::MomentSettings& settings)
        : api_(api), scene_(scene), grid_(grid), settings_(settings), starts_(makeStarts()),
          samples_(api, sunCosines(), azimuthCosines(settings.azimuths)),
          results_(api, "sweep radiance", starts_.size() * samples_.suns * samples_.azimuths * scene.sets() * 4 * sizeof(float))
    {
    }

    enum class First { all, groundOnly };
    Sums direct(First which, const Breath& breath)
    {
        const DirectRays rays(api_, DirectRayData(scene_, starts_, settings_.directNodes, true));
        DirectGather gather(api_, scene_, which == First::all ? DirectGather::Purpose::field : DirectGather::Purpose::groundField, {});
        gather.gather(rays, samples_, stridesOf(samples_), {}, results_, breath);
        return project(settings_.degree, samples_.azimuths);
    }

    /// Light of event `event`, scattered or reflected once more than the field.
    Sums scattered(const physics::Moments& field, int event, const Breath& breath)
    {
        if (!gather_) {
            rays_.emplace(api_, scene_, grid_, starts_, ScatteredRaySettings{settings_.nodes, settings_.stationTolerance, true});
            gather_.emplace(api_, scene_, std::vector<std::array<double, 4>>{});
        }
        const int azimuthal = physics::azimuthalDegree(scene_.optics, event, settings_.negligibleOrder(), settings_.leastAzimuthal);
        const SunSamples samples(api_, sunCosines(), azimuthCosines(settings_.azimuthsFor(azimuthal)));
        gather_->gather(*rays_, FoldField(field, sweepRefinement), azimuthal, samples, stridesOf(samples), results_, breath);
        return project(azimuthal, samples.azimuths);
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

private:
    std::vector<RayStart> makeStarts()
    {
        std::vector<RayStart> starts;
        for (const double h : grid_.altitudes()) {
            firstRay_.push_back(static_cast<int>(starts.size()));
            directions_.push_back(physics::directionsAt(scene_.profile.planet(), h, settings_));
            const auto& set = directions_.back();
            for (std::size_t d = 0; d < set.mu.size(); ++d)
                starts.push_back({h, set.mu[d], set.hitsGround[d]});
        }
        return starts;
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
    Sums project(const int azimuthal, const int azimuths) const
    {
        const auto radiance = results_.download();
        const int degree = settings_.degree, count = harmonicCount(degree), wavelengths = scene_.optics.wavelengths;
        const int suns = samples_.suns, stride = scene_.sets() * 4;
        Sums sums{std::vector<double>(std::size_t(grid_.altitudeCount()) * suns * count * wavelengths, 0.),
                  std::vector<double>(std::size_t(grid_.altitudeCount()) * suns * wavelengths, 0.)};
        std::vector<double> waves(azimuths * (azimuthal + 1));
        for (int k = 0; k < azimuths; ++k)
            for (int m = 0; m <= azimuthal; ++m)
                waves[k * (azimuthal + 1) + m] = std::cos(m * pi * (k + 0.5) / azimuths) * 2 * pi / azimuths;
        base::parallel([&](int thread, int threads) {
            std::vector<double> factors(count), byAzimuth((azimuthal + 1) * wavelengths);
            for (int a = thread; a < grid_.altitudeCount(); a += threads) {
                const auto& set = directions_[a];
                for (std::size_t d = 0; d < set.mu.size(); ++d) {
                    physics::harmonicFactors(degree, set.mu[d], factors.data());
                    for (int j = 0; j < suns; ++j) {
                        const float* values = &radiance[(std::size_t(firstRay_[a] + d) * suns + j) * azimuths * stride];
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
        for (std::size_t i = 0; i < sums.moments.size(); ++i)
            if (!std::isfinite(sums.moments[i]))
                throw NumericsError("moments: the value at altitude level " +
                                    std::to_string(i / (std::size_t(suns) * count * wavelengths)) + ", Sun " +
                                    std::to_string(i / (std::size_t(count) * wavelengths) % suns) + ", harmonic " +
                                    std::to_string(i / wavelengths % count) + ", wavelength " + std::to_string(i % wavelengths) +
                                    " is not finite. This is an error of calcmysky or of the "
                                    "OpenGL driver; try another one with --device or --gl.");
        return sums;
    }

    gl::Api api_;
    const Scene scene_;
    const physics::MomentGrid& grid_;
    const physics::MomentSettings& settings_;
    std::vector<int> firstRay_;
    std::vector<physics::Directions> directions_;
    std::vector<RayStart> starts_;
    SunSamples samples_;
    gl::Buffer results_;
    std::optional<ScatteredRays> rays_;
    std::optional<ScatteredGather> gather_;
};

} // namespace

RadiationField iterate(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const physics::MomentSettings& settings,
                       const OrderLimit& limit, bool keepEvents, const std::function<void(double)>& breath)
{
    const int wanted = limit.all ? mostEvents : limit.orders - 1;
    const int harmonics = harmonicCount(settings.degree), wavelengths = scene.optics.wavelengths;
    RadiationField field;
    const auto fractionOf = [&](int event) { return limit.all ? 1 - std::pow(0.7, event) : double(event) / std::max(1, wanted); };

    Sweeps sweeps(api, scene, grid, settings);
    if (keepEvents)
        field.firstFromGround = sweeps.toMoments(sweeps.direct(Sweeps::First::groundOnly, [&] { breath(0); }));
    EventSeries series(harmonics, wavelengths, limit.all);
    Sums last = sweeps.direct(Sweeps::First::all, [&] { breath(0); });
    const auto keep = [&](int event) {
        series.add(last);
        field.eventCount = event;
        field.irradiance.push_back(last.irradiance);
        if (keepEvents)
            field.perEvent.push_back(sweeps.toMoments(last));
    };
    keep(1);
    const double tolerance = limit.tolerance > 0 ? limit.tolerance : limit.all ? settings.tolerance : 0;
    for (int event = 2; event <= wanted; ++event) {
        last = sweeps.scattered(sweeps.toMoments(last), event, [&] { breath(fractionOf(event - 1)); });
        keep(event);
        if (!(tolerance > 0))
            continue;
        field.remainder = series.change();
        if (field.remainder < tolerance)
            break;
    }
    const Sums total = series.total();
    for (std::size_t i = 0; i < total.irradiance.size(); ++i) // orders beyond the last count with it
        field.irradiance.back()[i] += total.irradiance[i] - series.sum().irradiance[i];
    field.total = sweeps.toMoments(total);
    breath(1);
    return field;
}

} // namespace sky::solver
