// From luminance to levels of a screen: the shaders against closed forms and the CPU's colour functions.

#include "blue_noise.hpp"
#include "developer.hpp"
#include "gl/context_for_tests.hpp"
#include "physics/colour.hpp"
#include <cmath>
#include <numeric>
#include <set>

using namespace showmysky;
using namespace showmysky::app;
namespace gl = sky::gl;

namespace {

/// A picture to develop, and what comes out.
struct Darkroom {
    explicit Darkroom(const gl::Api& api_) : api(api_), developer(api_) {}

    Levels develop(const std::vector<Luminance>& pixels, int width, const Development& development, double exposure = 0)
    {
        const int height = static_cast<int>(pixels.size()) / width;
        gl::Texture2D texture(api, "test", gl::TextureFormat::rgba32f, width, height);
        std::vector<float> values;
        for (const auto& p : pixels)
            values.insert(values.end(), {p.x, p.y, p.z, p.scotopic});
        texture.upload(values);
        return developer.levels(texture.name(), width, height, development, exposure);
    }
    Levels patch(const Luminance& light, const Development& development, int side = 64)
    {
        return develop(std::vector<Luminance>(static_cast<std::size_t>(side * side), light), side, development);
    }

    gl::Api api;
    Developer developer;
};

std::optional<gl::HeadlessContext> context()
{
    gl::HeadlessOptions options;
    options.version = {3, 3, false};
    return gl::testing::context(options);
}

Development plain()
{
    Development development;
    development.curve = ToneCurve::linear;
    development.dithering = Dithering::none;
    return development;
}

/// Grey of D65 white.
Luminance grey(double luminance)
{
    return {static_cast<float>(0.9504559 * luminance), static_cast<float>(luminance), static_cast<float>(1.0890578 * luminance),
            static_cast<float>(2 * luminance)};
}

double mean(const Levels& levels)
{
    return std::accumulate(levels.rgb.begin(), levels.rgb.end(), 0.) / static_cast<double>(levels.rgb.size());
}

std::array<int, 3> firstPixel(const Levels& levels) { return {levels.rgb.at(0), levels.rgb.at(1), levels.rgb.at(2)}; }

} // namespace

TEST_CASE("development: sRGB agrees with the CPU's formulas", "[gl]")
{
    const auto gpu = context();
    if (!gpu)
        return;
    Darkroom room(gpu->api());
    for (const auto& xyz : {sky::physics::XYZ{0.2, 0.25, 0.3}, {0.5, 0.4, 0.2}, {0.001, 0.0011, 0.002}, {0.9, 0.95, 1.}}) {
        const auto levels = room.patch({static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2]), 0}, plain(), 1);
        const auto rgb = sky::physics::linearSrgb(xyz);
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(levels.rgb[c] == Approx(255 * sky::physics::encodeSrgb(rgb[c])).margin(0.51)); // rounding
    }
}

TEST_CASE("development: dithering keeps the mean, rounding doesn't", "[gl]")
{
    const auto gpu = context();
    if (!gpu)
        return;
    Darkroom room(gpu->api());
    for (const auto dithering : {Dithering::ordered, Dithering::blueNoise})
        for (const auto depth : {Depth::bits666, Depth::bits888})
            for (const double level : {0.7, 20.3, 101.49, 200.9}) {
                Development development = plain();
                development.dithering = dithering;
                development.depth = depth;
                const double light = sky::physics::decodeSrgb(level / 255);
                const auto levels = room.patch(grey(light), development);
                // 64 thresholds in 8 x 8, 4096 in blue noise: the mean is a multiple of a step / 64, then of 1 / 255 by
                // rounding.
                const double step = depth == Depth::bits888 ? 1 : 255. / 63;
                CHECK(mean(levels) == Approx(level).margin(step / 64 + (depth == Depth::bits888 ? 0.01 : 0.5)));
                std::set<int> values(levels.rgb.begin(), levels.rgb.end());
                CHECK(values.size() == 2);
            }
    CHECK(mean(room.patch(grey(sky::physics::decodeSrgb(20.3 / 255)), plain())) == Approx(20));
}

TEST_CASE("development: the depth decides how many levels there are", "[gl]")
{
    const auto gpu = context();
    if (!gpu)
        return;
    Darkroom room(gpu->api());
    std::vector<Luminance> ramp;
    for (int i = 0; i < 1024; ++i)
        ramp.push_back(grey(sky::physics::decodeSrgb(i / 1023.)));
    const std::pair<Depth, std::array<std::size_t, 3>> expected[] = {
        {Depth::bits565, {32, 64, 32}}, {Depth::bits666, {64, 64, 64}}, {Depth::bits888, {256, 256, 256}}};
    for (const auto& [depth, counts] : expected) {
        Development development = plain();
        development.depth = depth;
        const auto levels = room.develop(ramp, 1024, development);
        for (std::size_t c = 0; c < 3; ++c) {
            std::set<int> values;
            for (std::size_t i = c; i < levels.rgb.size(); i += 3)
                values.insert(levels.rgb[i]);
            CHECK(values.size() == counts[c]);
        }
    }
}

TEST_CASE("development: colour modes show what they say", "[gl]")
{
    const auto gpu = context();
    if (!gpu)
        return;
    Darkroom room(gpu->api());
    const auto shown = [&](const Luminance& light, ColourMode mode, bool gradual = true) {
        Development development = plain();
        development.colours = mode;
        development.gradualClipping = gradual;
        return firstPixel(room.patch(light, development, 1));
    };
    const auto level = [](double linear) { return static_cast<int>(std::lround(255 * sky::physics::encodeSrgb(linear))); };
    const Luminance light{0.2f, 0.25f, 0.3f, 0.6f};
    const auto rgb = sky::physics::linearSrgb({0.2, 0.25, 0.3});
    CHECK(shown(light, ColourMode::photopic) == std::array{level(0.25), level(0.25), level(0.25)});
    CHECK(shown(light, ColourMode::scotopic) == std::array{level(0.6), level(0.6), level(0.6)});
    CHECK(shown(light, ColourMode::x)[0] == level(0.2));
    CHECK(shown(light, ColourMode::z)[0] == level(0.3));
    CHECK(shown(light, ColourMode::red)[1] == level(rgb[0]));
    CHECK(shown(light, ColourMode::green)[1] == level(rgb[1]));
    CHECK(shown(light, ColourMode::blue)[1] == level(rgb[2]));
    CHECK(shown(light, ColourMode::xyzChromaticitySmooth) == std::array{level(0.2 / 0.75), level(0.25 / 0.75), level(0.3 / 0.75)});
    CHECK(shown(light, ColourMode::xyzChromaticityBright) == std::array{level(0.2 / 0.3), level(0.25 / 0.3), 255});
    const double sum = rgb[0] + rgb[1] + rgb[2], most = std::max({rgb[0], rgb[1], rgb[2]});
    CHECK(shown(light, ColourMode::srgbChromaticitySmooth)[0] == level(rgb[0] / sum));
    CHECK(shown(light, ColourMode::srgbChromaticityBright)[0] == level(rgb[0] / most));
    // Chromaticity and hue don't depend on brightness.
    const Luminance brighter{2e3f, 2.5e3f, 3e3f, 6e3f};
    for (const auto mode : {ColourMode::xyzChromaticitySmooth, ColourMode::srgbChromaticityBright, ColourMode::hue})
        CHECK(shown(brighter, mode) == shown(light, mode));
    const auto hue = shown(light, ColourMode::hue);
    CHECK(*std::max_element(hue.begin(), hue.end()) == 255);
    CHECK(*std::min_element(hue.begin(), hue.end()) == 0);
    CHECK(shown({}, ColourMode::hue) == std::array{0, 0, 0});
    CHECK(shown({}, ColourMode::xyzChromaticityBright) == std::array{0, 0, 0});
    // A red too bright: cut off it keeps no green; gradually it fades towards white, and far too bright it is white.
    const Luminance red{0.82f, 0.43f, 0.04f, 0.f};
    CHECK(shown(red, ColourMode::srgb, true)[1] > shown(red, ColourMode::srgb, false)[1]);
    CHECK(shown({8.2f, 4.3f, 0.4f, 0}, ColourMode::srgb, true) == std::array{255, 255, 255});
    CHECK(shown({8.2f, 4.3f, 0.4f, 0}, ColourMode::srgb, false)[2] < 10);
}

TEST_CASE("development: glare scatters light and keeps its sum", "[gl]")
{
    const auto gpu = context();
    if (!gpu)
        return;
    Darkroom room(gpu->api());
    Development development = plain();
    std::vector<Luminance> pixels(128 * 128);
    pixels[64 * 128 + 64] = grey(1e3);
    const auto at = [](const Levels& levels, int x, int y) { return int(levels.rgb[3 * static_cast<std::size_t>(y * 128 + x)]); };
    CHECK(at(room.develop(pixels, 128, development), 70, 64) == 0);
    development.glare = 1;
    const auto glaring = room.develop(pixels, 128, development);
    CHECK(at(glaring, 64, 64) == 255);
    CHECK(at(glaring, 68, 64) > at(glaring, 80, 64));
    CHECK(at(glaring, 80, 64) > 0);
    // An even sky stays what it is.
    CHECK(mean(room.develop(std::vector<Luminance>(128 * 128, grey(0.3)), 128, development)) ==
          Approx(255 * sky::physics::encodeSrgb(0.3)).margin(0.51));
}

TEST_CASE("development: a sample has the exposure of the whole picture", "[gl]")
{
    const auto gpu = context();
    if (!gpu)
        return;
    Darkroom room(gpu->api());
    Picture picture{400, 300, {}};
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 400; ++x)
            picture.pixels.push_back(grey(1000 * std::exp(0.01 * y) * (1 + 0.5 * std::sin(0.05 * x))));
    gl::Texture2D texture(gpu->api(), "test", gl::TextureFormat::rgba32f, 400, 300);
    std::vector<float> values;
    for (const auto& p : picture.pixels)
        values.insert(values.end(), {p.x, p.y, p.z, p.scotopic});
    texture.upload(values);
    CHECK(automaticExposure(room.developer.sample(texture.name())) == Approx(automaticExposure(picture)).margin(0.01));
}

TEST_CASE("blue noise: each threshold once, and no low frequencies")
{
    constexpr int side = 32;
    const auto noise = blueNoise(side);
    std::set<float> values(noise.begin(), noise.end());
    REQUIRE(values.size() == side * side);
    CHECK(*values.begin() == Approx(0.5 / (side * side)));
    CHECK(*values.rbegin() == Approx(1 - 0.5 / (side * side)));
    const auto power = [&](int fx, int fy) {
        double re = 0, im = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double phase = 2 * 3.14159265358979 * (fx * x + fy * y) / side;
                const double value = static_cast<double>(noise[static_cast<std::size_t>(y * side + x)]) - 0.5;
                re += value * std::cos(phase);
                im += value * std::sin(phase);
            }
        return (re * re + im * im) / (side * side);
    };
    double low = 0, high = 0; // white noise would have the variance, 1/12, in both
    int lows = 0, highs = 0;
    for (int fy = -side / 2; fy < side / 2; ++fy)
        for (int fx = -side / 2; fx < side / 2; ++fx) {
            const double f = std::hypot(fx, fy);
            if (f > 0 && f <= side / 8.)
                low += power(fx, fy), ++lows;
            else if (f > side / 3.)
                high += power(fx, fy), ++highs;
        }
    CHECK(low / lows < 0.1 / 12);
    CHECK(high / highs > 1. / 12);
}
