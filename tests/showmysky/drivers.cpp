// Drivers differ in their functions and filters: what is drawn must not.

#include "gl/poor_driver.hpp"
#include "gl/shader_interceptor.hpp"
#include "sky_for_tests.hpp"

using namespace showmysky;
using namespace showmysky::testing;

namespace {

/// By day, at sunset with the disc, in twilight, from high up, in an eclipse; drawn with every projection.
std::vector<std::vector<Luminance>> pictures(const sky::gl::Loader& loader)
{
    std::vector<std::vector<Luminance>> result;
    Sky sky(SHOWMYSKY_TEST_MODEL, loader);
    sky.loadAll();
    auto eclipse = scene(1000, 50);
    eclipse.eclipse = EclipseMode::on;
    eclipse.moon = {eclipse.sun.azimuth, eclipse.sun.zenithAngle, 360e6};
    for (const auto& settings : {scene(0, 40), scene(0, 89), scene(0, 97), scene(30e3, 91), scene(0, 40, Source::textures), eclipse}) {
        sky.setSettings(settings);
        for (const auto& camera : {panorama(), Camera{Projection::fisheye, 180 * degree, 0.3, 90 * degree, 0},
                                   Camera{Projection::perspective, 90 * degree, 0.3, 20 * degree, 0}}) {
            sky.draw(camera, 96, 64);
            result.push_back(sky.readLuminance());
        }
    }
    return result;
}

} // namespace

TEST_CASE("drivers: pictures depend little on a driver that uses up the errors it may make", "[gl]")
{
    const auto good = sky::gl::testing::context(desktop());
    if (!good)
        return;
    const auto reference = pictures(good->loader());
    for (const char* noise : {"poor_random(x)", "1.0"}) {
        CAPTURE(noise);
        sky::gl::testing::ShaderInterceptor interceptor(sky::gl::testing::poorDriver(noise));
        const auto poor = sky::gl::testing::context(desktop());
        REQUIRE(poor);
        const auto drawn = pictures(interceptor.loader(poor->loader()));
        REQUIRE(interceptor.shaders() > 1);
        for (std::size_t i = 0; i < reference.size(); ++i) {
            const auto errors = differences(drawn[i], reference[i]);
            CAPTURE(i);
            // Weights of 8 bits: 1/512 of the step between two texels of the tables, by some per cent; the arithmetic adds less than 1e-5.
            CHECK(quantile(errors, 0.5) < 2e-4);
            CHECK(errors.back() < 2e-3);
        }
    }
}
