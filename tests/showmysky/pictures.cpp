// What is drawn, against the same light computed in other ways.

#include "sky_for_tests.hpp"

using namespace showmysky;
using namespace showmysky::testing;

TEST_CASE("picture: a pixel has the luminance of its spectrum on the CPU", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    struct Case {
        double altitude, sunZenithDeg;
    };
    for (const auto& [altitude, sunZenithDeg] : {Case{0, 30}, Case{0, 85}, Case{0, 94}, Case{2000, 60}, Case{20e3, 91}, Case{300e3, 70}}) {
        CAPTURE(altitude, sunZenithDeg);
        sky.setSettings(scene(altitude, sunZenithDeg));
        sky.draw(panorama(), 96, 48);
        std::vector<double> errors;
        for (int y = 2; y < 48; y += 5)
            for (int x = 1; x < 96; x += 7) {
                const double exact = luminanceOf(sky.pixelSpectralRadiance(x, y), sky.wavelengths());
                const double drawn = static_cast<double>(sky.pixelLuminance(x, y).y);
                if (exact > 1e-9)
                    errors.push_back(std::abs(drawn / exact - 1));
            }
        std::sort(errors.begin(), errors.end());
        CHECK(errors.size() > 20);
        // 32 x 33 rays, 48 and 20 nodes against 96 and 24: what the issue of drawing fast costs.
        CHECK(quantile(errors, 0.5) < 0.003);
        CHECK(quantile(errors, 0.95) < 0.02);
    }
}

TEST_CASE("picture: 4D textures and moments show the same sky", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    REQUIRE(sky.hasSource(Source::textures));
    for (const double zenith : {30., 80., 93.}) {
        CAPTURE(zenith);
        sky.setSettings(scene(1000, zenith));
        sky.draw(panorama(), 200, 100);
        const auto moments = sky.readLuminance();
        sky.setSettings(scene(1000, zenith, Source::textures));
        REQUIRE(sky.draw(panorama(), 200, 100));
        const auto errors = differences(sky.readLuminance(), moments);
        CHECK(quantile(errors, 0.5) < 0.01);
    }
}

TEST_CASE("picture: OpenGL ES 3.0 with half floats shows what desktop OpenGL shows", "[gl]")
{
    const auto big = sky::gl::testing::context(desktop());
    auto small = sky::gl::testing::context(embedded());
    if (!big || !small)
        return;
    Sky onEmbedded = loadedSky(*small);
    std::vector<std::vector<Luminance>> pictures;
    for (const double zenith : {40., 92.}) {
        onEmbedded.setSettings(scene(500, zenith));
        onEmbedded.draw(panorama(), 200, 100);
        pictures.push_back(onEmbedded.readLuminance());
    }
    auto context = sky::gl::HeadlessContext(desktop());
    Sky onDesktop = loadedSky(context);
    int i = 0;
    for (const double zenith : {40., 92.}) {
        CAPTURE(zenith);
        onDesktop.setSettings(scene(500, zenith));
        onDesktop.draw(panorama(), 200, 100);
        // Two roundings to 11 bits, and the fourth power of a third.
        const auto errors = differences(pictures[static_cast<std::size_t>(i++)], onDesktop.readLuminance(), 1e-3);
        CHECK(quantile(errors, 0.5) < 2e-3);
        CHECK(quantile(errors, 0.99) < 6e-3);
    }
    small->makeCurrent();
}

TEST_CASE("picture: layers add up to the whole", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    auto settings = scene(3000, 75);
    sky.setSettings(settings);
    sky.draw(panorama(), 100, 50);
    const auto whole = sky.readLuminance();
    std::vector<Luminance> sum(whole.size());
    const auto names = sky.scatterers();
    REQUIRE(names.size() == 2);
    for (int part = 0; part < 4; ++part) {
        settings.layers = {};
        settings.layers.zeroOrder = part == 0;
        settings.layers.multipleScattering = part == 1;
        settings.layers.singleScattering = part >= 2;
        if (part >= 2)
            settings.layers.hiddenScatterers = {names[part == 2 ? 1 : 0]};
        sky.setSettings(settings);
        sky.draw(panorama(), 100, 50);
        const auto one = sky.readLuminance();
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i].y += one[i].y;
    }
    // The tables of ground and multiple scattering are interpolated together or apart, hence not exactly zero.
    CHECK(quantile(differences(sum, whole), 0.99) < 1e-3);
}

TEST_CASE("picture: no jump while the Sun sets", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    const Camera zenith{Projection::fisheye, 170 * degree, 0, 90 * degree, 0};
    std::vector<double> brightness;
    for (double sun = 86; sun < 98; sun += 0.1) {
        sky.setSettings(scene(0, sun));
        sky.draw(zenith, 32, 32);
        double sum = 0;
        for (const auto& pixel : sky.readLuminance())
            sum += static_cast<double>(pixel.y);
        brightness.push_back(std::log(sum));
    }
    // Dusk is smooth: in logarithms a tenth of a degree never bends the curve by more than this share of a stop.
    for (std::size_t i = 1; i + 1 < brightness.size(); ++i) {
        CAPTURE(i);
        CHECK(brightness[i] < brightness[i - 1]);
        CHECK(std::abs(brightness[i + 1] - 2 * brightness[i] + brightness[i - 1]) < 0.01);
    }
}

TEST_CASE("picture: the ground meets the sky at the horizon and nowhere else", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    sky.setSettings(scene(0, 70));
    // One column, two degrees high: pixels of 0.02 degrees.
    sky.draw({Projection::equirectangular, 0.2 * degree, 1.2, 0, 0}, 10, 100);
    const auto picture = sky.readLuminance();
    int jumps = 0;
    for (int y = 1; y < 100; ++y) {
        const auto below = static_cast<double>(picture[static_cast<std::size_t>(10 * (y - 1))].y);
        const auto above = static_cast<double>(picture[static_cast<std::size_t>(10 * y)].y);
        if (std::abs(above / below - 1) > 0.02) {
            ++jumps;
            CHECK(y == 50);
        }
    }
    CHECK(jumps == 1);
}
