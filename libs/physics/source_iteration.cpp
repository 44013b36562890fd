#include "physics/source_iteration.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <thread>

namespace sky::physics {

namespace {

using base::pi;

void toLogRatios(Moments& m)
{
    const int count = harmonicCount(m.degree);
    for (int a = 0; a < m.grid.altitudeCount(); ++a)
        for (int j = 0; j < m.grid.sunCount(); ++j) {
            double* v = m.at(a, j);
            for (int w = 0; w < m.wavelengths; ++w) {
                const double whole = std::max(v[w], darkness);
                for (int lm = 1; lm < count; ++lm)
                    v[lm * m.wavelengths + w] /= whole;
                v[w] = std::log(whole);
            }
        }
}

} // namespace

Moments iterateSource(const Medium& medium, const Profile& profile, const Optics& optics, const SunTable& sun, const MomentGrid& grid,
                      const MomentSettings& settings, const int orders, const int sunChords, const int threadCount)
{
    const int wavelengths = optics.wavelengths, count = harmonicCount(settings.degree);
    const SkyEvaluator sky(medium, profile, optics, sun);
    Moments total{grid, settings.degree, wavelengths,
                  std::vector<double>(size_t(grid.altitudeCount()) * grid.sunCount() * count * wavelengths, 0.),
                  std::vector<double>(size_t(grid.sunCount()) * wavelengths, 0.)};
    const Moments empty = total;
    Moments previous = empty;

    // Rays depend on altitude and zenith angle only: traced once, used for all Suns, azimuths and orders.
    std::vector<Directions> directions;
    std::vector<std::vector<RayNodes>> rays, directRays;
    RayTracer tracer(profile, optics);
    for (const double h : grid.altitudes()) {
        directions.push_back(directionsAt(profile.planet(), h, settings));
        rays.emplace_back();
        directRays.emplace_back();
        for (size_t d = 0; d < directions.back().mu.size(); ++d) {
            const double mu = directions.back().mu[d];
            rays.back().push_back(tracer.trace(h, mu, settings.nodes, directions.back().hitsGround[d], NodesFor::Field));
            directRays.back().push_back(tracer.trace(h, mu, settings.directNodes, directions.back().hitsGround[d]));
        }
    }

    for (int order = 1; order <= orders; ++order) {
        Moments current = empty;
        const int azimuthal =
            order == 1 ? settings.degree : azimuthalDegree(optics, order, settings.negligibleOrder(), settings.leastAzimuthal);
        const int azimuths = order == 1 ? settings.azimuths : settings.azimuthsFor(azimuthal);
        for (int l = azimuthal + 1; l <= settings.degree; ++l)
            for (int m = azimuthal + 1; m <= l; ++m)
                for (size_t i = size_t(harmonicIndex(l, m)) * wavelengths; i < previous.values.size(); i += size_t(count) * wavelengths)
                    std::fill_n(previous.values.begin() + std::ptrdiff_t(i), wavelengths, 0.);
        const auto gather = [&](int altitude, int j) {
            const double muSun = std::sin(grid.sunElevation(j)), sineSun = std::cos(grid.sunElevation(j));
            double* moments = current.at(altitude, j);
            std::vector<double> radiance(wavelengths), irradiance(wavelengths), factors(count);
            const auto& set = directions[altitude];
            for (size_t d = 0; d < set.mu.size(); ++d) {
                const auto& ray = (order == 1 ? directRays : rays)[altitude][d];
                harmonicFactors(settings.degree, set.mu[d], factors.data());
                for (int k = 0; k < azimuths; ++k) {
                    const double phi = pi * (k + 0.5) / azimuths;
                    const double nu = set.mu[d] * muSun + std::sqrt(1 - set.mu[d] * set.mu[d]) * sineSun * std::cos(phi);
                    std::fill(radiance.begin(), radiance.end(), 0.);
                    if (order == 1)
                        sky.singleAlong(ray, muSun, nu, false, radiance.data());
                    else
                        sky.multipleAlong(ray, previous, muSun, nu, radiance.data());
                    if (ray.hitsGround) {
                        const double muSunGround = ray.ground.sunScale * muSun + ray.ground.nuScale * nu;
                        if (order == 1)
                            sun.groundIrradiance(muSunGround, irradiance.data());
                        else
                            previous.interpolateGround(muSunGround, irradiance.data());
                        for (int w = 0; w < wavelengths; ++w)
                            radiance[w] += ray.groundTransmittance[w] * medium.groundAlbedo[w] / pi * irradiance[w];
                    }
                    for (double& value : radiance)
                        value = std::max(value, 0.); // a cut series may undershoot
                    const double solidAngle = set.weight[d] * 2 * pi / azimuths;
                    for (int l = 0; l <= settings.degree; ++l)
                        for (int m = 0; m <= std::min(l, azimuthal); ++m) {
                            const double y = solidAngle * factors[harmonicIndex(l, m)] * std::cos(m * phi);
                            for (int w = 0; w < wavelengths; ++w)
                                moments[harmonicIndex(l, m) * wavelengths + w] += y * radiance[w];
                        }
                    if (altitude == 0 && set.mu[d] > 0)
                        for (int w = 0; w < wavelengths; ++w)
                            current.groundIrradiance[j * wavelengths + w] += solidAngle * set.mu[d] * radiance[w];
                }
            }
        };
        std::vector<std::thread> threads;
        for (int t = 0; t < threadCount; ++t)
            threads.emplace_back([&, t] {
                for (int i = t; i < grid.altitudeCount() * grid.sunCount(); i += threadCount)
                    gather(i / grid.sunCount(), i % grid.sunCount());
            });
        for (auto& thread : threads)
            thread.join();
        for (size_t i = 0; i < total.values.size(); ++i)
            total.values[i] += current.values[i];
        for (size_t i = 0; i < total.groundIrradiance.size(); ++i)
            total.groundIrradiance[i] += current.groundIrradiance[i];
        previous = std::move(current);
        previous.sunChords = sunChords;
        previous.bentDegree = sunChords > 0 ? bentDegree(optics) : -1;
        toLogRatios(previous);
    }
    toLogRatios(total);
    return total;
}

} // namespace sky::physics
