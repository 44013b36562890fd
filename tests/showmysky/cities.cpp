// Cities in pictures and numbers.
#include "showmysky/photometry.hpp"
#include "sky_for_tests.hpp"
#include <catch2/catch.hpp>
#include <chrono>
#include <ctime>

using namespace showmysky;
using namespace showmysky::testing;

namespace {

SceneSettings night(double altitude, std::vector<City> cities)
{
    auto settings = scene(altitude, 175);
    settings.layers.lightPollution = true;
    settings.cities = std::move(cities);
    return settings;
}

std::string refusal(Sky& sky, std::vector<City> cities)
{
    try {
        sky.setSettings(night(0, std::move(cities)));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("cities are drawn as they are computed for each direction alone; they add up and scale", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const City near{15e3, 0.6, 4e3, 2, {}}, far{60e3, 5.5, 4e3, 1, {}};
    const Camera camera = panorama();
    for (const double altitude : {2., 8000.}) {
        sky.setSettings(night(altitude, {near, far}));
        sky.draw(camera, 256, 128);
        const auto both = sky.readLuminance();
        int lit = 0, ground = 0;
        std::vector<double> off;
        for (int y = 20; y < 124; y += 6)
            for (int x = 3; x < 256; x += 12) {
                const double truth = luminanceOf(sky.pixelSpectralRadiance(x, y), sky.wavelengths());
                const double value = static_cast<double>(sky.pixelLuminance(x, y).y);
                CHECK(std::isfinite(value));
                CHECK(value >= 0);
                if (truth > 1e-5)
                    off.push_back(std::abs(value / truth - 1));
                lit += truth > 1e-5 ? 1 : 0;
                ground += truth > 0.5 ? 1 : 0;
            }
        std::sort(off.begin(), off.end());
        REQUIRE(lit > 100);
        CHECK((ground > 0) == (altitude > 100)); // the discs themselves, from above
        CHECK(quantile(off, 0.5) < 0.02);        // 24 views a half and 17 azimuths
        CHECK(quantile(off, 0.95) < 0.15);

        City bright = near;
        bright.luminance *= 3;
        const auto picture = [&](std::vector<City> cities) {
            sky.setSettings(night(altitude, std::move(cities)));
            sky.draw(camera, 256, 128);
            return sky.readLuminance();
        };
        const auto first = picture({near}), second = picture({far}), tripled = picture({bright});
        for (std::size_t i = 0; i < both.size(); i += 7) {
            CHECK(both[i].y == Approx(first[i].y + second[i].y).epsilon(1e-3).margin(1e-6));
            CHECK(tripled[i].y == Approx(3 * first[i].y).epsilon(1e-3).margin(1e-6));
        }
    }
}

TEST_CASE("the edge of a city's disc stands where the geometry says", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const double altitude = 5000, R = sky.planetRadius();
    const City city{30e3, 1, 5e3, 1, {}};
    sky.setSettings(night(altitude, {city}));
    // Depth below the horizontal of the ground `distance` away.
    const auto depthOf = [&](double distance) {
        const double angle = distance / R;
        return std::atan2(altitude + 2 * R * std::pow(std::sin(angle / 2), 2), R * std::sin(angle));
    };
    const auto luminanceAt = [&](double depth, double azimuth) {
        const Camera camera{Projection::perspective, 1e-4, azimuth, -depth, 0};
        sky.draw(camera, 2, 2);
        return static_cast<double>(sky.pixelLuminance(1, 1).y);
    };
    for (const double edge : {25e3, 35e3}) {
        const double inwards = edge < 30e3 ? 1 : -1;
        CHECK(luminanceAt(depthOf(edge + inwards * 100), 1) > 0.2);
        CHECK(luminanceAt(depthOf(edge - inwards * 100), 1) < 0.1);
    }
    const double width = std::asin(std::sin(5e3 / R) / std::sin(30e3 / R)); // azimuth of the tangent
    CHECK(luminanceAt(depthOf(30e3), 1 + 0.95 * width) > 0.2);
    CHECK(luminanceAt(depthOf(30e3), 1 - 0.95 * width) > 0.2);
    CHECK(luminanceAt(depthOf(30e3), 1 + 1.05 * width) < 0.1);
}

TEST_CASE("the photometer answers cities as the renderer draws them, with spectra of their own", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const Photometer photometer(SHOWMYSKY_TEST_MODEL);
    const std::size_t count = photometer.wavelengthsNm().size();
    std::vector<double> white(count, 5.);
    const std::vector<City> cities{{20e3, 1, 4e3, 2, {}}, {40e3, 2, 4e3, 1, white}};
    auto settings = night(100, cities);
    settings.layers.zeroOrder = settings.layers.singleScattering = settings.layers.multipleScattering = false;
    sky.setSettings(settings);
    std::vector<double> spectrum(count);
    for (const double zenith : {0.2, 1.3, 1.7}) {
        const Photometer::View view{100, 3, 0, zenith, 1.4};
        photometer.cityRadiance(&view, 1, cities, spectrum.data());
        const auto seen = sky.spectralRadiance(directionOf(1.4, zenith));
        for (std::size_t w = 0; w < count; ++w)
            CHECK(spectrum[w] == Approx(seen[w]).epsilon(1e-6));
    }
    // A spectrum is a shape: its scale is the luminance's.
    auto scaled = cities;
    for (double& value : scaled[1].spectrum)
        value *= 1e-3;
    const Photometer::View up{0, 3, 0, 0, 0};
    std::vector<double> other(count);
    photometer.cityRadiance(&up, 1, cities, spectrum.data());
    photometer.cityRadiance(&up, 1, scaled, other.data());
    for (std::size_t w = 0; w < count; ++w)
        CHECK(other[w] == Approx(spectrum[w]).epsilon(1e-9));
}

TEST_CASE("cities that can't be are refused with a sentence", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    using Catch::Contains;
    CHECK_THAT(refusal(sky, {{-1, 0, 1e3, 1, {}}}), Contains("km away"));
    CHECK_THAT(refusal(sky, {{1e3, NAN, 1e3, 1, {}}}), Contains("azimuth"));
    CHECK_THAT(refusal(sky, {{1e3, 0, 0, 1, {}}}), Contains("radius"));
    CHECK_THAT(refusal(sky, {{1e3, 0, 1e3, -1, {}}}), Contains("luminance"));
    CHECK_THAT(refusal(sky, {{1e3, 0, 1e3, 1, {1, 2}}}), Contains("one value for each"));
    CHECK_THAT(refusal(sky, {{1e3, 0, 1e3, 1, std::vector<double>(sky.wavelengths().size(), 0.)}}), Contains("visible"));
}

TEST_CASE("a city of a new radius is lit while the scene before goes on being drawn", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const Camera camera = panorama();
    CHECK_FALSE(sky.drawPrepared(camera, 64, 32)); // nothing has been prepared
    const auto before = night(0, {{20e3, 1, 3e3, 2, {}}}), after = night(0, {{20e3, 1, 2e3, 2, {}}, {9e3, 4, 1e3, 1, {}}});
    const auto pictureOf = [&](Sky& drawer, const Camera& where) {
        drawer.draw(where, 64, 32);
        return drawer.readLuminance();
    };
    const auto same = [](const std::vector<Luminance>& a, const std::vector<Luminance>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Luminance& p, const Luminance& q) {
            return p.x == q.x && p.y == q.y && p.z == q.z && p.scotopic == q.scotopic;
        });
    };
    Camera turned = camera;
    turned.yaw = 2;
    sky.setSettings(before);
    const auto first = pictureOf(sky, camera), firstTurned = pictureOf(sky, turned);
    REQUIRE_FALSE(same(first, firstTurned));

    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    sky.setSettings(after);
    Clock::duration longest{};
    for (bool done = false, odd = false; !done; odd = !odd) {
        const auto begin = Clock::now();
        const Progress progress = sky.prepareStep();
        longest = std::max(longest, Clock::now() - begin);
        done = progress.done;
        if (done || progress.activity != "Lighting cities")
            continue;
        sky.drawPrepared(odd ? camera : turned, 64, 32);
        CHECK(same(sky.readLuminance(), odd ? first : firstTurned));
    }
    CHECK(longest < (Clock::now() - start) / 4); // two fields, a second each, would be nearly all of it
    const auto second = pictureOf(sky, camera);
    CHECK_FALSE(same(second, first));

    // Settings that change while threads work on others, and a picture at once.
    Sky other = loadedSky(*context);
    other.setSettings(before);
    CHECK_FALSE(other.prepareStep().done);
    other.setSettings(after);
    CHECK(same(pictureOf(other, camera), second));
    // Nobody waits for what nobody wants.
    other.setSettings(night(0, {{20e3, 1, 5e3, 2, {}}}));
    CHECK_FALSE(other.prepareStep().done);
    other.setSettings(scene(0, 60));
    CHECK(pictureOf(other, camera).at(64 * 20).y > 0);
}

TEST_CASE("a Sky that is destroyed calls off the light of its cities", "[gl]")
{
    auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    const auto works = [&](bool toTheEnd) { // processor time of all threads
        auto sky = std::make_unique<Sky>(loadedSky(*context));
        sky->setSettings(night(0, {{20e3, 1, 3e3, 2, {}}}));
        const Progress first = sky->prepareStep();
        REQUIRE(first.activity == "Lighting cities");
        const auto before = std::clock();
        while (toTheEnd && sky->prepareStep().activity == "Lighting cities") {
        }
        sky.reset();
        return static_cast<double>(std::clock() - before);
    };
    const double all = works(true);
    CHECK(works(false) < 0.1 * all);
}
