#include "physics/ground_glow.hpp"
#include "base/angles.hpp"
#include "base/not_negative.hpp"
#include "base/parallel.hpp"
#include "physics/directions.hpp"
#include "physics/glow_light.hpp"
#include "physics/harmonics.hpp"
#include "physics/levels.hpp"
#include "physics/series.hpp"
#include "physics/table_axes.hpp"
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

/// Zenith-angle factors of Y_l0.
void zonalFactors(int degree, double mu, double* factors)
{
    legendre(degree, mu, factors);
    for (int l = 0; l <= degree; ++l)
        factors[l] *= std::sqrt((2 * l + 1) / (4 * pi));
}

/// Light fainter than this part of the brightest decides nothing.
constexpr double faintest = 1e-20;

/// A field as sums, before logarithms.
struct Sums {
    std::vector<double> moments;    // [altitude][l][wavelength]
    std::vector<double> irradiance; // [wavelength], downward at the ground
};

GlowMoments asMoments(const MomentGrid& grid, int degree, int wavelengths, const Sums& sums)
{
    GlowMoments m{grid, degree, wavelengths, sums.moments, sums.irradiance};
    for (int a = 0; a < grid.altitudeCount(); ++a) {
        double* v = &m.values[size_t(a) * (degree + 1) * wavelengths];
        for (int w = 0; w < wavelengths; ++w) {
            const double whole = std::max(v[w], darkness);
            for (int l = 1; l <= degree; ++l)
                v[l * wavelengths + w] /= whole;
            v[w] = std::log(whole);
        }
    }
    return m;
}

/// The rays of every level, divided into cells once for all events, and what each event does with them.
class Sweeps
{
public:
    Sweeps(const Medium& medium, const Profile& profile, const Optics& optics, const MomentGrid& grid, const GlowSettings& settings)
        : medium_(medium), optics_(optics), levels_(grid.altitudeCount())
    {
        MomentSettings directions;
        directions.groundDirections = settings.groundDirections;
        directions.limbDirections = settings.limbDirections;
        directions.skyDirections = settings.skyDirections;
        base::parallel([&](int thread, int threads) {
            RayTracer tracer(profile, optics, settings.cells);
            for (int a = thread; a < grid.altitudeCount(); a += threads) {
                const double altitude = grid.altitudes()[a];
                const auto all = directionsAt(profile.planet(), altitude, directions);
                for (size_t d = 0; d < all.mu.size(); ++d)
                    levels_[a].push_back(
                        {all.weight[d] * 2 * pi, tracer.cells(altitude, all.mu[d], all.hitsGround[d], GlowLight::deepest)});
            }
        });
    }

    /// Light straight from the ground: event 0.
    Sums direct(const GlowMoments& darkness) const
    {
        const GlowLight light(medium_, optics_, darkness);
        return swept([&](const RayCells& ray, double* radiance) { light.direct(ray, radiance); });
    }

    /// The light of one event, scattered and reflected once more.
    Sums scattered(const GlowMoments& previous) const
    {
        const GlowLight light(medium_, optics_, previous);
        return swept([&](const RayCells& ray, double* radiance) { light.scattered(ray, radiance); });
    }

private:
    struct Ray {
        double weight;
        RayCells cells;
    };

    template<class Radiance>
    Sums swept(Radiance&& radianceOf) const
    {
        const int wavelengths = optics_.wavelengths, count = (optics_.degree + 1) * wavelengths;
        Sums sums{std::vector<double>(levels_.size() * count, 0.), std::vector<double>(wavelengths, 0.)};
        base::parallel([&](int thread, int threads) {
            std::vector<double> radiance(wavelengths), factors(optics_.degree + 1);
            for (size_t a = thread; a < levels_.size(); a += threads)
                for (const Ray& ray : levels_[a]) {
                    const double mu = ray.cells.mu;
                    radianceOf(ray.cells, radiance.data());
                    zonalFactors(optics_.degree, mu, factors.data());
                    for (int l = 0; l <= optics_.degree; ++l)
                        for (int w = 0; w < wavelengths; ++w)
                            sums.moments[a * count + l * wavelengths + w] += ray.weight * factors[l] * radiance[w];
                    if (a == 0 && mu > 0)
                        for (int w = 0; w < wavelengths; ++w)
                            sums.irradiance[w] += ray.weight * mu * radiance[w];
                }
        });
        // A cut series of a phase function may be negative somewhere; no field is.
        for (size_t a = 0; a < levels_.size(); ++a)
            for (int w = 0; w < wavelengths; ++w)
                sums.moments[a * count + w] = base::notNegative(sums.moments[a * count + w]);
        for (double& e : sums.irradiance)
            e = base::notNegative(e);
        return sums;
    }

    const Medium& medium_;
    const Optics& optics_;
    std::vector<std::vector<Ray>> levels_;
};

} // namespace

void GlowMoments::interpolate(const double altitude, double* const result) const
{
    const Stencil a = grid.altitudeStencil(altitude);
    const int count = (degree + 1) * wavelengths;
    const double* levels[4];
    for (int i = 0; i < 4; ++i)
        levels[i] = &values[size_t(a.index[i]) * count];
    const auto logarithm = logarithmBetween(a);
    for (int w = 0; w < wavelengths; ++w)
        result[w] = logarithm(levels[0][w], levels[1][w], levels[2][w], levels[3][w]);
    for (int k = wavelengths; k < count; ++k)
        result[k] = a.weight[0] * levels[0][k] + a.weight[1] * levels[1][k] + a.weight[2] * levels[2][k] + a.weight[3] * levels[3][k];
    for (int w = 0; w < wavelengths; ++w)
        result[w] = std::exp(result[w]);
    for (int l = 1; l <= degree; ++l)
        for (int w = 0; w < wavelengths; ++w)
            result[l * wavelengths + w] *= result[w];
}

MomentGrid glowGrid(const Profile& profile, const Optics& optics, const GlowSettings& settings)
{
    return MomentGrid(profile.planet(), fieldLevels(profile, largestExtinctions(optics), settings.altitudes), -1, 2);
}

Profile glowProfile(const Medium& medium)
{
    // Densities are followed less closely than for twilight, which looks through much more air.
    constexpr double tolerance = 1e-3;
    constexpr int shells = 24;
    const Profile coarse(medium, tolerance);
    return coarse.withShellsAt(altitudeNodes(coarse.planet(), shells));
}

Optics glowOptics(const Medium& medium, const int degree) { return makeOptics(medium, degree, true); }

GlowField solveGroundGlow(const Medium& medium, const Profile& profile, const Optics& optics, const GlowSettings& settings,
                          const bool keepEvents, const std::function<void(int)>& breath)
{
    const MomentGrid grid = glowGrid(profile, optics, settings);
    const int degree = optics.degree, wavelengths = optics.wavelengths;
    const Sweeps sweeps(medium, profile, optics, grid, settings);
    const auto moments = [&](const Sums& sums) { return asMoments(grid, degree, wavelengths, sums); };
    GlowField field;
    const Sums none{std::vector<double>(size_t(grid.altitudeCount()) * (degree + 1) * wavelengths, 0.),
                    std::vector<double>(wavelengths, 0.)};
    GeometricSeries<double> light(degree + 1, wavelengths), irradiance(1, wavelengths);
    const auto add = [&](Sums event) {
        light.add(std::move(event.moments));
        irradiance.add(std::move(event.irradiance));
        const GlowMoments added = moments({light.last(), irradiance.last()});
        if (keepEvents)
            field.perEvent.push_back(added);
        return added;
    };
    GlowMoments last = add(sweeps.direct(moments(none)));
    const bool scatters = !optics.scatterers.empty(); // else no light ever comes down to be reflected
    for (int event = 1; scatters && event <= settings.mostEvents; ++event) {
        last = add(sweeps.scattered(last));
        field.eventCount = event;
        if (breath)
            breath(event);
        if (event < 3)
            continue;
        field.remainder = light.change(faintest);
        if (field.remainder < settings.tolerance)
            break;
    }
    field.total = moments({light.whole(), irradiance.whole()});
    return field;
}

} // namespace sky::physics
