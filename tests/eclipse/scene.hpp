#pragma once
// An Earth of four wavelengths, a Sun and a Moon, and the field of higher orders around a camera.

#include "../montecarlo/sample_air.hpp"
#include "base/angles.hpp"
#include "eclipse/field.hpp"
#include "physics/moments.hpp"
#include <cmath>

namespace sky::eclipse::test {

constexpr double degrees = sky::base::degree;

/// Coarser than the settings of a user: what is tested doesn't depend on them, or says so.
inline FieldSettings coarse()
{
    FieldSettings s;
    s.altitudes = 8;
    s.along = 13;
    s.across = 7;
    s.degree = 3;
    s.groundDirections = 3;
    s.limbDirections = 2;
    s.skyDirections = 4;
    s.directNodes = 12;
    s.nodes = 6;
    s.sunlightAltitudes = 20;
    s.viewNodes = 10;
    return s;
}

struct Earth {
    physics::Medium medium;
    physics::Profile profile;
    physics::Optics optics;
    physics::SunTable sun;
    std::shared_ptr<const AirRays> rays;

    explicit Earth(const FieldSettings& settings = coarse(), int degree = 5)
        : medium(sky::test::sampleEarth(sky::test::Aerosol::Yes)), profile(medium), optics(physics::makeOptics(medium, degree, true)),
          sun(profile, optics, medium.sunAngularRadius, 32, 64), rays(traceAir(medium, profile, optics, settings))
    {
    }

    /// Sun at an elevation towards `north` (rad, from North over West); the Moon higher and more to the left by so much, rad.
    physics::EclipseBodies bodies(double sunElevation, double moonHigher = 0, double moonLeft = 0, double altitude = 0,
                                  double north = 0) const
    {
        physics::EclipseBodies b;
        b.planet = profile.planet();
        b.cameraAltitude = altitude;
        b.sunAngularRadius = medium.sunAngularRadius;
        b.moonDistance = 371925e3;
        const auto direction = [&](double elevation, double azimuth, double left) {
            const double x = std::cos(elevation) * std::cos(left), y = std::sin(left);
            return std::array<double, 3>{x * std::cos(azimuth) - y * std::sin(azimuth), x * std::sin(azimuth) + y * std::cos(azimuth),
                                         std::sin(elevation) * std::cos(left)};
        };
        b.sunDirection = direction(sunElevation, north, 0);
        b.moonDirection = direction(sunElevation + moonHigher, north, moonLeft);
        return b;
    }

    ScatteredField solved(const physics::EclipseBodies& b, const Orders& orders = {}, SunlightLeft left = {}) const
    {
        ScatteredField field(rays, sun, b, orders, std::move(left));
        while (!field.step()) {
        }
        return field;
    }

    /// Rays from the camera up to the zenith, and from up in the air down to the ground.
    std::vector<ViewRay> views(double altitude = 0) const
    {
        std::vector<ViewRay> result;
        for (const double elevation : {-80., -20., -5., -0.5, 1., 5., 20., 50., 90.}) {
            const double mu = std::sin(elevation * degrees);
            if (elevation > 0 || altitude > 0)
                result.push_back({altitude, mu, physics::hitsGround(profile.planet(), altitude, mu), 0});
        }
        return result;
    }
};

inline const std::vector<double> azimuths{0., 0.7, 1.9, 3.1, -0.7, -1.9, -3.1};

} // namespace sky::eclipse::test
