// Scenes as text: everything comes back, and mistakes are named by line and column.

#include "scene_file.hpp"

#include "base/error.hpp"
#include "scene_fields.hpp"
#include <catch2/catch.hpp>

using namespace showmysky;
using namespace showmysky::app;

namespace {

std::string complaint(const std::string& text)
{
    SceneOptions scene;
    try {
        readScene(scene, text, "a.scene");
    } catch (const sky::UsageError& error) {
        CHECK(scene == SceneOptions{});
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("scene file: every setting comes back as it was written")
{
    SceneOptions scene;
    scene.altitude = 1234.5678901234567;
    scene.sunZenith = 0.1;
    scene.sunAzimuth = -1e-9;
    scene.sunRadius = 0.25;
    scene.moonZenith = 45.5;
    scene.moonAzimuth = 3;
    scene.moonDistance = 3.6e8;
    scene.fieldOfView = 33;
    scene.yaw = -17;
    scene.pitch = 89;
    scene.lightPollution = 20;
    scene.cities = {{50e3, 30, 5e3, 2, {1, 2.5}}, {12e3, -170, 1e3, 0.5, {}}};
    scene.layers = {"sun", "single"};
    scene.hiddenScatterers = {"molecules", "aerosols"};
    scene.solarSpectrum = {SolarSpectrum::Kind::blackBody, 3500, {}};
    scene.source = Source::textures;
    scene.projection = Projection::fisheye;
    scene.eclipseOrders = 3;
    scene.eclipse = scene.precomputedEclipse = scene.eclipseFine = scene.limbDarkening = scene.onTheFly = scene.mirror = scene.unfiltered =
        true;
    scene.development = {ToneCurve::linear, false, -3.25, ColourMode::hue, false, 0.5, Dithering::blueNoise, Depth::bits565};
    SceneOptions back;
    readScene(back, writeScene(scene), "test");
    CHECK(back == scene);
    // No field was left at its default above, so none can be missing from the file.
    SceneOptions plain;
    for (const auto& field : sceneFields())
        CHECK(field.write(plain) != field.write(scene));
}

TEST_CASE("scene file: an empty list, comments, blanks and other line ends")
{
    SceneOptions scene;
    readScene(scene, "# a comment\r\n\r\n  altitude :\t 10 # here too\r\nlayers:\nexposure: auto", "test");
    CHECK(scene.altitude == 10);
    CHECK(scene.layers.empty());
    CHECK(scene.development.automatic);
}

TEST_CASE("scene file: mistakes are named by file, line and column")
{
    CHECK(complaint("altitude: 1\nsun-zenit: 3") == "a.scene:2:1: there is no setting `sun-zenit`. Did you mean `sun-zenith`?");
    CHECK(complaint("altitude:  up") == "a.scene:1:12: `altitude`: `up` is not a number.");
    CHECK(complaint("# \xc3\xa4\n altitude 3") == "a.scene:2:2: expected `NAME: VALUE`, for instance `altitude: 100`.");
    CHECK(complaint("yaw: 1\nyaw: 2") == "a.scene:2:1: `yaw` is given twice.");
    CHECK(complaint("projection: fisheey").find("a.scene:1:13: `projection`: `fisheey` is not understood; expected") == 0);
    CHECK(complaint("altitude: nan") == "a.scene:1:11: `altitude`: `nan` is not a number.");
    CHECK(complaint("layers: zero, mirth").find("`mirth` is not understood") != std::string::npos);
    CHECK(complaint("eclipse: maybe").find("`maybe` is not understood") != std::string::npos);
    CHECK(complaint("solar-spectrum: black-body:-3").find("has no temperature") != std::string::npos);
    CHECK(complaint(std::string("alti\0tude: 3", 12)).find("a.scene:1:1: there is no setting") == 0);
}
