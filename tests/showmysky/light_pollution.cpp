// Light pollution in pictures and numbers: the even glow, from both sources.
#include "showmysky/photometry.hpp"
#include "sky_for_tests.hpp"
#include <catch2/catch.hpp>

using namespace showmysky;
using namespace showmysky::testing;

namespace {

SceneSettings night(double altitude, double luminance, Source source = Source::moments)
{
    auto settings = scene(altitude, 170, source);
    settings.layers.lightPollution = true;
    settings.lightPollutionLuminance = luminance;
    return settings;
}

std::vector<Luminance> drawn(Sky& sky, const SceneSettings& settings)
{
    sky.setSettings(settings);
    sky.draw(panorama(), 128, 64);
    return sky.readLuminance();
}

} // namespace

TEST_CASE("light pollution is drawn as it is computed for each direction alone", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    for (const double altitude : {0., 3000., 20e3, 400e3})
        for (const bool alone : {true, false}) {
            auto settings = night(altitude, 2);
            if (alone)
                settings.layers.zeroOrder = settings.layers.singleScattering = settings.layers.multipleScattering = false;
            drawn(sky, settings);
            for (const int y : {3, 12, 22, 28, 31, 32, 36, 50, 62})
                for (const int x : {5, 70}) {
                    const double truth = luminanceOf(sky.pixelSpectralRadiance(x, y), sky.wavelengths());
                    INFO("altitude " << altitude << ", pixel " << x << ", " << y);
                    const double value = static_cast<double>(sky.pixelLuminance(x, y).y);
                    CHECK(value == Approx(truth).epsilon(0.01).margin(2e-6)); // tables of 64 views, at the limb seen from space too
                }
        }
}

TEST_CASE("light pollution is the same from moments and textures, linear, and nothing where it is off", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    for (const double altitude : {0., 5000.}) {
        const auto moments = drawn(sky, night(altitude, 1)), textures = drawn(sky, night(altitude, 1, Source::textures));
        CHECK(differences(textures, moments).back() < 0.01);
        const auto twice = drawn(sky, night(altitude, 2));
        auto off = night(altitude, 1);
        off.layers.lightPollution = false;
        const auto dark = drawn(sky, off), none = drawn(sky, night(altitude, 0));
        for (std::size_t i = 0; i < moments.size(); ++i) {
            CHECK(twice[i].y == Approx(2 * moments[i].y).epsilon(1e-4).margin(1e-9));
            CHECK(dark[i].y < 1e-6f);
            CHECK(none[i].y == dark[i].y);
        }
    }
}

TEST_CASE("the photometer answers light pollution as the renderer draws it", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const Photometer photometer(SHOWMYSKY_TEST_MODEL);
    std::vector<double> spectrum(photometer.wavelengthsNm().size());
    for (const double altitude : {0., 7000., 300e3})
        for (const double zenith : {0.1, 1.5, 1.8, 3.}) {
            auto settings = night(altitude, 3);
            settings.layers.zeroOrder = settings.layers.singleScattering = settings.layers.multipleScattering = false;
            sky.setSettings(settings);
            const auto seen = sky.spectralRadiance(directionOf(0.7, zenith));
            photometer.radiance({altitude, 3, 0, zenith, 0.7}, Photometer::lightPollution, spectrum.data());
            for (std::size_t w = 0; w < seen.size(); ++w)
                CHECK(3 * spectrum[w] == Approx(seen[w]).epsilon(1e-9));
        }
    const auto straightDown = photometer.luminance({0, 3, 0, 3.1, 0}, Photometer::lightPollution);
    CHECK(straightDown.Y > 1); // the ground's own light, and a little that the air sends back
    CHECK(straightDown.Y < 1.1);
}

TEST_CASE("a luminance of the ground that is none is refused", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    CHECK_THROWS_AS(sky.setSettings(night(0, -1)), Error);
    CHECK_THROWS_AS(sky.setSettings(night(0, NAN)), Error);
}
