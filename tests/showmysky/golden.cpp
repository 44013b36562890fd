// Pictures as they were found right, by the eye: the last guard, for what no law or judge looks at.
//
// Where a picture differs for a good reason, look at the new one and keep it:
//     SHOWMYSKY_KEEP_GOLDEN=1 build/release/tests/showmysky/test_showmysky "golden*"

#include "perception.hpp"
#include "sky_for_tests.hpp"

#include <cstdlib>
#include <filesystem>
#include <png.h>

using namespace showmysky;
using namespace showmysky::testing;

namespace {

struct Golden {
    std::string name;
    SceneSettings settings;
    Camera camera;
    double white; ///< luminance shown as white, cd m^-2
};

std::vector<Golden> goldenScenes()
{
    const Camera fisheye{Projection::fisheye, 180 * degree, 0.3, 90 * degree, 0};
    const Camera ahead{Projection::perspective, 90 * degree, 0.3, 20 * degree, 0};
    auto mirror = scene(200, 80);
    mirror.pseudoMirror = true;
    auto disc = scene(0, 89);
    disc.layers.solarDisc = true;
    auto eclipse = scene(1000, 50);
    eclipse.eclipse = EclipseMode::on;
    eclipse.moon = {eclipse.sun.azimuth, eclipse.sun.zenithAngle, 360e6};
    return {{"day", scene(0, 40), panorama(), 1.6e4},
            {"day-fisheye", scene(0, 60), fisheye, 1e4},
            {"day-textures", scene(0, 40, Source::textures), panorama(), 1.6e4},
            {"sunset", disc, ahead, 8e3},
            {"twilight", scene(0, 95), ahead, 80},
            {"late-twilight", scene(0, 100), fisheye, 0.15},
            {"mirror", mirror, ahead, 2e4},
            {"stratosphere", scene(30e3, 70), panorama(), 1.2e4},
            {"orbit", scene(800e3, 65), {Projection::perspective, 70 * degree, 0.3, -35 * degree, 0}, 1.2e4},
            {"total-eclipse", eclipse, panorama(), 30}};
}

constexpr int width = 96, height = 64;

Shown shown(Sky& sky, const Golden& golden)
{
    sky.setSettings(golden.settings);
    sky.draw(golden.camera, width, height);
    const auto picture = sky.readLuminance();
    Shown result{width, height, {}};
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x) {
            const Luminance& pixel = picture[static_cast<std::size_t>(y * width + x)];
            const sky::physics::XYZ xyz{static_cast<double>(pixel.x) / golden.white, static_cast<double>(pixel.y) / golden.white,
                                        static_cast<double>(pixel.z) / golden.white};
            for (const double channel : sky::physics::linearSrgb(xyz))
                result.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * sky::physics::encodeSrgb(std::clamp(channel, 0., 1.)))));
        }
    return result;
}

void write(const std::filesystem::path& path, const Shown& picture)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    if (!png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr))
        FAIL(path.string() << " can't be written: " << image.message);
}

std::optional<Shown> read(const std::filesystem::path& path)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path.c_str()))
        return std::nullopt;
    image.format = PNG_FORMAT_RGB;
    Shown result{static_cast<int>(image.width), static_cast<int>(image.height), std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
    if (!png_image_finish_read(&image, nullptr, result.rgb.data(), 0, nullptr))
        return std::nullopt;
    return result;
}

/// Empty if nobody sees a difference worth a word; otherwise what it is.
std::string visibleDifference(const Shown& picture, const Shown& golden)
{
    if (picture.width != golden.width || picture.height != golden.height)
        return "the sizes differ";
    const auto differences = colourDifferences(picture, golden);
    double mean = 0;
    for (const double difference : differences)
        mean += difference / static_cast<double>(differences.size());
    // Just noticeable is 2. Single pixels may cross an edge (horizon, disc) on another driver.
    const double most = quantile(differences, 0.99), largest = differences.back();
    if (most < 2 && largest < 8 && mean < 0.5)
        return {};
    return "colour differences: mean " + std::to_string(mean) + " (below 0.5 wanted), 99 % below " + std::to_string(most) +
           " (2), largest " + std::to_string(largest) + " (8)";
}

} // namespace

TEST_CASE("golden: pictures look as they did", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    namespace fs = std::filesystem;
    Sky sky = loadedSky(*context);
    const fs::path kept = fs::path(SKY_TEST_DATA) / "golden";
    for (const Golden& golden : goldenScenes()) {
        CAPTURE(golden.name);
        const Shown picture = shown(sky, golden);
        const fs::path path = kept / (golden.name + ".png");
        if (std::getenv("SHOWMYSKY_KEEP_GOLDEN")) {
            write(path, picture);
            continue;
        }
        const auto before = read(path);
        const std::string difference = before ? visibleDifference(picture, *before) : "there is no " + path.string();
        if (difference.empty())
            continue;
        const fs::path now = fs::path(SHOWMYSKY_TEST_MODEL).parent_path() / (golden.name + "-now.png");
        write(now, picture);
        FAIL_CHECK("The picture `" << golden.name << "` is not what it was: " << difference << ". It is now in " << now.string()
                                   << "; if that is right, run this test with SHOWMYSKY_KEEP_GOLDEN=1.");
    }
}

TEST_CASE("golden: a Sun two degrees lower, an aerosol less or a greener sky would be noticed", "[gl]")
{
    const auto context = sky::gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    for (const Golden& golden : goldenScenes()) {
        CAPTURE(golden.name);
        const Shown right = shown(sky, golden);
        CHECK(visibleDifference(right, right).empty());
        if (golden.name == "day-textures" || golden.name == "mirror" || golden.settings.eclipse == EclipseMode::on)
            continue; // much as others; and the last one's Sun would leave the Moon behind
        Golden lower = golden;
        lower.settings.sun.zenithAngle += 2 * degree;
        CHECK_FALSE(visibleDifference(shown(sky, lower), right).empty());
        // Haze shows by day and from below.
        if (golden.settings.sun.zenithAngle > 89.5 * degree || golden.settings.altitude > 10e3)
            continue;
        Golden clearer = golden;
        clearer.settings.layers.hiddenScatterers = {sky.scatterers().back()};
        CHECK_FALSE(visibleDifference(shown(sky, clearer), right).empty());
    }
    Shown right{2, 1, {90, 120, 160, 40, 50, 60}}, greener = right;
    for (std::size_t i = 1; i < greener.rgb.size(); i += 3)
        greener.rgb[i] = static_cast<std::uint8_t>(greener.rgb[i] + 6);
    CHECK_FALSE(visibleDifference(greener, right).empty());
}
