// Light scattered twice in totality, summed over the sphere at points of one line of sight: no harmonics, no grid, no map.
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "eclipse/frame.hpp"
#include "physics/directions.hpp"
#include "physics/harmonics.hpp"
#include "physics/ray.hpp"
#include "scene.hpp"
#include <catch2/catch.hpp>
#include <mutex>

using namespace sky;
using namespace sky::eclipse;
using namespace sky::eclipse::test;
using physics::RayNodes;
using physics::RayTracer;

namespace {

using sky::base::pi;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Radiance of the second order, [wavelength], without and with the Moon's shadow.
struct SecondOrder {
    std::vector<double> uneclipsed, eclipsed;
};

class Summed
{
public:
    Summed(const Earth& earth, const physics::EclipseBodies& bodies)
        : air(earth), sun(earth.profile, earth.optics, earth.medium.sunAngularRadius), shadow(physics::makeShadow(bodies)),
          towardsSun(bodies.sunDirection)
    {
    }

    /// Seen from the ground towards a unit vector above the horizon.
    SecondOrder towards(const Vector& view) const
    {
        const int wavelengths = air.optics.wavelengths;
        SecondOrder sum{std::vector<double>(wavelengths, 0.), std::vector<double>(wavelengths, 0.)};
        const auto seen = RayTracer(air.profile, air.optics).trace(0, view[2], 24, false, physics::NodesFor::Field);
        std::mutex mutex;
        base::parallel([&](int thread, int threads) {
            SecondOrder part{std::vector<double>(wavelengths, 0.), std::vector<double>(wavelengths, 0.)};
            for (std::size_t k = thread; k < seen.nodes.size(); k += threads)
                addFrom(view, seen, k, part);
            const std::lock_guard lock(mutex);
            for (int w = 0; w < wavelengths; ++w) {
                sum.uneclipsed[w] += part.uneclipsed[w];
                sum.eclipsed[w] += part.eclipsed[w];
            }
        });
        return sum;
    }

private:
    void addFrom(const Vector& view, const RayNodes& seen, std::size_t k, SecondOrder& sum) const
    {
        const auto& node = seen.nodes[k];
        const double R = air.profile.planet().radius, r = R + node.altitude, s = node.nuScale * r;
        const Vector place{s * view[0], s * view[1], s * view[2]}, up{place[0] / r, place[1] / r, (place[2] + R) / r};
        const double level = std::sqrt(1 - up[0] * up[0]);
        const Vector ahead{level, -up[0] * up[1] / level, -up[0] * up[2] / level};
        const Vector aside{up[1] * ahead[2] - up[2] * ahead[1], up[2] * ahead[0] - up[0] * ahead[2], up[0] * ahead[1] - up[1] * ahead[0]};
        physics::MomentSettings settings;
        settings.groundDirections = settings.skyDirections = 16;
        settings.limbDirections = 8;
        constexpr int azimuths = 48;
        const auto directions = physics::directionsAt(air.profile.planet(), node.altitude, settings);
        RayTracer tracer(air.profile, air.optics, 1.5);
        const int wavelengths = air.optics.wavelengths, scatterers = static_cast<int>(air.optics.scatterers.size());
        std::vector<double> uneclipsed(wavelengths), eclipsed(wavelengths), phase(wavelengths);
        for (std::size_t d = 0; d < directions.mu.size(); ++d) {
            const double mu = directions.mu[d], flat = std::sqrt(1 - mu * mu);
            const auto ray = tracer.trace(node.altitude, mu, 48, directions.hitsGround[d]);
            for (int a = 0; a < azimuths; ++a) {
                const double phi = 2 * pi * (a + 0.5) / azimuths;
                Vector from; // where the light comes from
                for (int i = 0; i < 3; ++i)
                    from[i] = mu * up[i] + flat * (std::cos(phi) * ahead[i] + std::sin(phi) * aside[i]);
                addOnce(place, from, dot(up, towardsSun), ray, uneclipsed, eclipsed);
                for (int i = 0; i < scatterers; ++i) {
                    physics::phaseFunctionAt(air.medium, air.medium.species[air.optics.scatterers[i]],
                                             std::acos(std::clamp(dot(from, view), -1., 1.)), phase.data());
                    for (int w = 0; w < wavelengths; ++w) {
                        const double share =
                            directions.weight[d] * 2 * pi / azimuths * seen.weights[(k * scatterers + i) * wavelengths + w] * phase[w];
                        sum.uneclipsed[w] += share * uneclipsed[w];
                        sum.eclipsed[w] += share * eclipsed[w];
                    }
                }
            }
        }
    }

    /// Light that was scattered once, or reflected, and arrives along a ray.
    void addOnce(const Vector& place, const Vector& from, double muSun, const RayNodes& ray, std::vector<double>& uneclipsed,
                 std::vector<double>& eclipsed) const
    {
        const int wavelengths = air.optics.wavelengths, scatterers = static_cast<int>(air.optics.scatterers.size());
        const double nu = std::clamp(dot(from, towardsSun), -1., 1.);
        std::vector<double> light(wavelengths), left(wavelengths), phases(scatterers * wavelengths);
        for (int i = 0; i < scatterers; ++i)
            physics::phaseFunctionAt(air.medium, air.medium.species[air.optics.scatterers[i]], std::acos(nu), &phases[i * wavelengths]);
        std::fill(uneclipsed.begin(), uneclipsed.end(), 0.);
        std::fill(eclipsed.begin(), eclipsed.end(), 0.);
        const auto sunAt = [&](const RayNodes::Node& n) {
            const double s = n.nuScale * (air.profile.planet().radius + n.altitude);
            return shadow.visibleSun({place[0] + s * from[0], place[1] + s * from[1], place[2] + s * from[2]});
        };
        const auto riseAt = [&](const RayNodes::Node& n, const Vector& offset) {
            const double R = air.profile.planet().radius, r = R + n.altitude, s = n.nuScale * r;
            double rise = offset[2] * R / r;
            for (int i = 0; i < 3; ++i)
                rise += offset[i] * (place[i] + s * from[i]) / r;
            return rise;
        };
        for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
            const auto& n = ray.nodes[k];
            sun.transmittance(n.altitude, n.sunScale * muSun + n.nuScale * nu, light.data());
            const auto seen = sunAt(n);
            sun.transmittance(n.altitude, n.sunScale * muSun + n.nuScale * nu, left.data(), riseAt(n, seen.aside));
            for (int i = 0; i < scatterers; ++i)
                for (int w = 0; w < wavelengths; ++w) {
                    const double scattered = ray.weights[(k * scatterers + i) * wavelengths + w] * phases[i * wavelengths + w];
                    uneclipsed[w] += scattered * light[w];
                    eclipsed[w] += seen.share * scattered * left[w];
                }
        }
        if (!ray.hitsGround)
            return;
        const double muSunThere = ray.ground.sunScale * muSun + ray.ground.nuScale * nu;
        const auto seen = sunAt(ray.ground);
        sun.groundIrradiance(muSunThere, light.data());
        sun.groundIrradiance(muSunThere, left.data(), riseAt(ray.ground, seen.aside));
        for (int w = 0; w < wavelengths; ++w) {
            const double reflected = ray.groundTransmittance[w] * air.medium.groundAlbedo[w] / pi;
            uneclipsed[w] += reflected * light[w];
            eclipsed[w] += seen.share * reflected * left[w];
        }
    }

    const Earth& air;
    physics::SunTable sun;
    physics::Shadow shadow;
    Vector towardsSun;
};

} // namespace

TEST_CASE("eclipse field: the second order over the red horizon of totality is the sum over the sphere")
{
    const Earth earth(FieldSettings{}, 5);
    REQUIRE(*std::max_element(earth.optics.truncation.begin(), earth.optics.truncation.end()) == 0); // the sum leaves no peak out
    const auto bodies = earth.bodies(40 * degrees);
    const Summed summed(earth, bodies);
    const auto field = earth.solved(bodies, {2});
    const double mu = std::cos(88 * degrees), flat = std::sin(88 * degrees);
    for (const double azimuth : {3 * degrees, 120 * degrees}) {
        const auto sum = summed.towards({flat * std::cos(azimuth), flat * std::sin(azimuth), mu});
        const auto light = field.view({{0, mu, false}}, {azimuth});
        for (int w = 2; w < earth.optics.wavelengths; ++w) { // 579 and 673 nm
            INFO("azimuth " << azimuth / degrees << " wavelength " << w);
            // Measured: 0.4 and 0.8 % too little, 0.0 and 0.1 %.
            CHECK(double(light.skyRatio(0, 0, w)) == Approx(sum.eclipsed[w] / sum.uneclipsed[w]).epsilon(0.012));
        }
    }
}
