// Directions, heights and Suns at which other programs showed black pixels, stripes, seams and stairs. docs/stress.md

#include "base/angles.hpp"
#include "photometry_gather.hpp"
#include "photometry_model.hpp"
#include "showmysky/photometry.hpp"
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace {

using showmysky::Photometer;
using View = Photometer::View;

using sky::base::degree;
using sky::base::pi;
constexpr unsigned sky = Photometer::singleScattering | Photometer::multipleScattering;

const Photometer& photometer()
{
    static const Photometer light(SHOWMYSKY_TEST_MODEL);
    return light;
}

const Photometer& doubles()
{
    static const Photometer light(SHOWMYSKY_TEST_MODEL, Photometer::Method::reference);
    return light;
}

std::vector<double> radiance(const View& view, unsigned layers = sky, const Photometer& light = photometer())
{
    std::vector<double> spectrum(light.wavelengthsNm().size());
    light.radiance(view, layers, spectrum.data());
    return spectrum;
}

/// Largest relative difference of two spectra that must be radiances.
double difference(const std::vector<double>& a, const std::vector<double>& b)
{
    double largest = 0;
    for (std::size_t w = 0; w < a.size(); ++w) {
        REQUIRE(std::isfinite(a[w]));
        REQUIRE(a[w] >= 0);
        largest = std::max(largest, std::abs(a[w] - b[w]) / std::max({a[w], b[w], 1e-300}));
    }
    return largest;
}

double dip(double altitude)
{
    const double R = photometer().planetRadius();
    return std::atan2(std::sqrt(altitude * (altitude + 2 * R)), R);
}

double ulps(double x, int count)
{
    for (int i = 0; i < std::abs(count); ++i)
        x = std::nextafter(x, count > 0 ? 10. : -10.);
    return std::clamp(x, 0., pi);
}

} // namespace

TEST_CASE("views at the Sun and away from it, exactly and within units of the last place")
{
    for (const double sun : {0., 1e-9, 0.3, 1.2, 1.57, 1.6})
        for (const bool away : {false, true}) {
            const double zenith = away ? pi - sun : sun, azimuth = away ? pi : 0;
            const auto exact = radiance({0, sun, 0, zenith, azimuth}, Photometer::wholeSky);
            for (int shift = -4; shift <= 4; ++shift) {
                INFO("Sun " << sun << " away " << away << " shift " << shift);
                CHECK(difference(radiance({0, sun, 0, ulps(zenith, shift), azimuth}, Photometer::wholeSky), exact) < 1e-5); // floats
                CHECK(difference(radiance({0, sun, ulps(1, shift) - 1, zenith, azimuth}, Photometer::wholeSky), exact) < 1e-5);
            }
        }
}

TEST_CASE("turning camera and Sun together changes nothing, wherever they point")
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 5000; ++i) {
        const double turn = 20 * unit(random) - 10, sun = pi * unit(random), azimuth = i % 2 ? 0 : 2 * pi * unit(random);
        const double view = i % 3 ? std::acos(2 * unit(random) - 1) : sun;
        // The difference of two azimuths loses some 2e-15 rad; the rest is floats.
        REQUIRE(difference(radiance({0, sun, turn, view, azimuth + turn}), radiance({0, sun, 0, view, azimuth})) < 1e-5);
    }
}

TEST_CASE("what is added up anywhere in ordinary air is light: nothing less than none that answers would take for darkness")
{
    const showmysky::PhotometryModel model(SHOWMYSKY_TEST_MODEL);
    const showmysky::FastGather gather(model.medium, model.optics, model.sun, &*model.moments, {}, &model.aureole);
    showmysky::FastScratch scratch;
    std::vector<double> light(static_cast<std::size_t>(model.medium.wavelengthCount()));
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 5000; ++i) {
        const double mu = 2 * unit(random) - 1, muSun = 2 * unit(random) - 1, altitude = i % 4 * model.medium.topOfAtmosphere / 3;
        const double nu = std::clamp(mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(pi * unit(random)), -1., 1.);
        gather.radiance(scratch, altitude, mu, muSun, nu, {i % 3 > 0, true, i % 3 > 1}, light.data());
        INFO("altitude " << altitude << " view " << mu << " Sun " << muSun << " nu " << nu);
        REQUIRE(*std::min_element(light.begin(), light.end()) >= 0);
    }
}

TEST_CASE("angles as small as a thousandth of the Sun's radius are resolved, at the Sun and at the horizon")
{
    // Aureole: from step to step of 1e-5 degrees the radiance moves smoothly, where single-precision cosines would make stairs of 0.02.
    double before = 0, beforeThat = 0;
    for (int i = 0; i <= 2000; ++i) {
        const double light = radiance({0, 1, 0, 1 + (0.2 + 1e-5 * i) * degree, 0}, Photometer::singleScattering)[8];
        if (i > 1)
            REQUIRE(std::abs(light - 2 * before + beforeThat) < 3e-6 * light); // rounding of floats, thrice
        beforeThat = before;
        before = light;
    }
}

TEST_CASE("at the Sun and at the horizon, single precision follows double precision from hundredth to hundredth of the Sun's radius")
{
    // What the two differ by otherwise, nodes along the ray, hardly changes over such steps; a cosine in single precision would make stairs of 7 % of the
    // Sun's radius, and an arccosine good to 1e-4 rad stairs of 2 %.
    const auto follows = [](const View& start, double step, double bound) {
        double smallest = 1e300, largest = 0;
        for (int i = 1; i <= 60; ++i) {
            View view = start;
            view.viewZenithAngle += i * step;
            const double ratio =
                radiance(view, Photometer::singleScattering)[8] / radiance(view, Photometer::singleScattering, doubles())[8];
            smallest = std::min(smallest, ratio);
            largest = std::max(largest, ratio);
        }
        INFO("altitude " << start.altitude << " from " << start.viewZenithAngle << " step " << step << ": " << largest / smallest - 1);
        CHECK(largest / smallest - 1 < bound);
    };
    const double step = 4.65e-5; // rad
    for (const double from : {0., 0.002, 0.01})
        for (const int side : {-1, 1})
            follows({0, 1, 0, 1 + side * from, 0}, side * step, 3e-5);
    for (const double altitude : {0., 1e3, 12e3})
        for (const int side : {-1, 1})
            if (side < 0 || altitude > 0)
                follows({altitude, 1, 0, 0.5 * pi + dip(altitude), 0.7}, side * step, 3e-5);
}

TEST_CASE("at the horizon, sky is what lies before the ground and, dimmed by that, what lies behind it")
{
    const auto& light = photometer();
    const std::size_t count = light.wavelengthsNm().size();
    std::vector<double> whole(count), behindAlone(count);
    light.transmittance(0, 0.5 * pi, behindAlone.data());
    for (const double altitude : {1., 100., 2e3, 12e3, 60e3, 100e3})
        for (const double sun : {20. * degree, 75. * degree, 88. * degree}) {
            const double horizon = 0.5 * pi + dip(altitude), aside = 1e-9; // rad: to either side
            const auto above = radiance({altitude, sun, 0, horizon - aside, 0}), below = radiance({altitude, sun, 0, horizon + aside, 0});
            const auto behind = radiance({0, std::abs(sun - dip(altitude)), 0, 0.5 * pi, sun > dip(altitude) ? 0 : pi});
            light.transmittance(altitude, horizon - aside, whole.data());
            for (std::size_t w = 0; w < count; ++w) {
                INFO("altitude " << altitude << " Sun " << sun << " wavelength " << w);
                const double expected = below[w] + whole[w] / behindAlone[w] * behind[w];
                CHECK(above[w] == Approx(expected).epsilon(0.004)); // nodes along three rays
            }
        }
}

TEST_CASE("steps of a thousandth of a degree across the horizon: no stripe on either side")
{
    for (const double altitude : {0., 1.7, 1e3, 12e3, 100e3})
        for (const int side : {-1, 1}) { // to the sky, to the ground
            if (side == 1 && altitude < 1e3)
                continue; // the way to the ground, and with it the light before it, truly bends there
            double last[2]{};
            int count = 0;
            for (int i = 1; i <= 300; ++i) {
                const double view = 0.5 * pi + dip(altitude) + side * i * 1e-3 * degree;
                const double light = radiance({altitude, 1, 0, view, 0.7})[8];
                REQUIRE(std::isfinite(light));
                if (++count > 2) {
                    INFO("altitude " << altitude << " side " << side << " step " << i);
                    REQUIRE(std::abs(light - 2 * last[1] + last[0]) < 0.005 * light);
                }
                last[0] = last[1];
                last[1] = light;
            }
        }
}

TEST_CASE("heights of a hair, of a person, and within units of the last place of the top")
{
    const double top = photometer().topOfAtmosphere();
    for (const double view : {0.2, 1.2, 0.5 * pi, 1.65, 2.5}) {
        const View ground{0, 1, 0, view, 0.5};
        for (const auto& [altitude, bound] : {std::pair{1e-4, 1e-4}, {1e-2, 1e-3}, {1.7, 5e-3}}) {
            View above = ground;
            above.altitude = altitude;
            INFO("view " << view << " altitude " << altitude);
            const double changed = difference(radiance(above), radiance(ground));
            if (view <= 0.5 * pi) // further down, the ground is at once farther than none
                CHECK(changed < bound);
        }
        const auto at = radiance({top, 1, 0, view, 0.5});
        for (const double altitude : {std::nextafter(top, 0.), std::nextafter(top, 2 * top), top + 1}) {
            INFO("view " << view << " altitude - top " << altitude - top);
            const auto light = radiance({altitude, 1, 0, view, 0.5});
            if (view > 0.5 * pi)
                CHECK(difference(light, at) < 1e-3);
            else // no air before the eye, or a millionth of a hair of it
                CHECK(*std::max_element(light.begin(), light.end()) < 1e-12);
        }
    }
}

TEST_CASE("the sky is its own mirror image about the Sun's vertical, without a seam there or opposite")
{
    for (const double sun : {30 * degree, 85 * degree, 95 * degree}) {
        for (int i = 0; i <= 40; ++i) {
            const double azimuth = 4.5 * i * degree;
            CHECK(difference(radiance({0, sun, 0, 1.1, azimuth}), radiance({0, sun, 0, 1.1, -azimuth})) < 1e-6);
        }
        for (const double middle : {0., pi}) { // from left to right through the vertical plane
            std::vector<double> light;
            for (int i = -20; i <= 20; ++i)
                light.push_back(radiance({0, sun, 0, 1.1, middle + 0.1 * i * degree})[8]);
            for (std::size_t i = 1; i + 1 < light.size(); ++i)
                CHECK(std::abs(light[i - 1] - 2 * light[i] + light[i + 1]) < 1e-4 * light[i]);
        }
    }
}

TEST_CASE("the Sun sinks from 5 degrees above the horizon to 18 below: never negative, never brighter, no stairs")
{
    const auto& light = photometer();
    const std::size_t count = light.wavelengthsNm().size();
    for (const double altitude : {0., 10e3}) {
        std::vector<double> direct(count), diffuse(count);
        double brightest = 0, last[2]{}, beam = 1e300;
        for (int i = 0; i <= 2300; ++i) {
            const double sun = (85 + 0.01 * i) * degree;
            INFO("altitude " << altitude << " Sun " << 85 + 0.01 * i);
            const double zenith = radiance({altitude, sun, 0, 0, 0})[8];
            REQUIRE(std::isfinite(zenith));
            REQUIRE(zenith >= 0);
            brightest = std::max(brightest, zenith);
            if (zenith > 1e-9 * brightest && i > 1) {
                REQUIRE(zenith <= last[1] * (1 + 1e-4));
                REQUIRE(std::abs(std::log(zenith) - 2 * std::log(last[1]) + std::log(last[0])) < 0.002); // of 0.1 to 0.5 % a step
            }
            last[0] = last[1];
            last[1] = zenith;
            if (i % 20 == 0) {
                light.horizontalIrradiance(altitude, sun, direct.data(), diffuse.data());
                for (std::size_t w = 0; w < count; ++w)
                    REQUIRE((direct[w] >= 0 && diffuse[w] >= 0 && std::isfinite(direct[w] + diffuse[w])));
                REQUIRE(direct[8] <= beam);
                beam = direct[8];
            }
        }
        CHECK(beam == 0);
    }
}
