// Mouse and keys change the scene as the hand expects.

#include "preview/input.hpp"

#include "view_direction.hpp"
#include <catch2/catch.hpp>
#include <cmath>

using namespace showmysky;
using namespace showmysky::app;
using namespace showmysky::app::preview;

namespace {

constexpr Canvas canvas{1000, 500};
constexpr double degree = 3.14159265358979323846 / 180;

struct Hand {
    SceneOptions scene;
    Pointer pointer;
    Wishes last;

    Hand()
    {
        scene.projection = Projection::equirectangular;
        scene.fieldOfView = 100; // a tenth of a degree per pixel
        scene.pitch = 0;
        scene.sunZenith = 90;
        scene.moonZenith = 90;
    }
    void drag(Button button, Modifiers modifiers, Point from, Point to)
    {
        apply(ButtonPressed{button, modifiers, from});
        apply(PointerMoved{{(from.x + to.x) / 2, (from.y + to.y) / 2}});
        apply(PointerMoved{to});
        apply(ButtonReleased{button, to});
    }
    void apply(const Event& event, bool captured = false) { last = pointer.handle(event, scene, canvas, captured); }
};

} // namespace

TEST_CASE("input: Ctrl+drag moves the Sun as far as the pointer went, and nothing else")
{
    Hand hand;
    SceneOptions expected = hand.scene;
    hand.drag(Button::left, {false, true}, {100, 100}, {200, 50});
    CHECK(hand.scene.sunAzimuth == Approx(10));
    CHECK(hand.scene.sunZenith == Approx(85));
    expected.sunAzimuth = hand.scene.sunAzimuth;
    expected.sunZenith = hand.scene.sunZenith;
    CHECK(hand.scene == expected);
    CHECK_FALSE(hand.last.pick);
    CHECK_FALSE(hand.pointer.dragging());
}

TEST_CASE("input: a Sun that is grabbed by its middle stays under the pointer in every projection")
{
    for (const auto projection : {Projection::perspective, Projection::fisheye, Projection::equirectangular}) {
        Hand hand;
        hand.scene.projection = projection;
        hand.scene.pitch = 20;
        hand.scene.sunZenith = 70; // in the middle
        hand.drag(Button::left, {false, true}, {500, 250}, {700, 150});
        auto expected = directionOf(hand.scene.sunAzimuth * degree, hand.scene.sunZenith * degree);
        const auto shown = builtInDirection(hand.scene.camera(), canvas.width, canvas.height, 700, 350);
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(shown[i] == Approx(expected[i]).margin(1e-9));
    }
}

TEST_CASE("input: a drag outside of the projection moves nothing")
{
    Hand hand;
    hand.scene.projection = Projection::fisheye;
    hand.scene.fieldOfView = 360; // a disc of 1000 pixels across
    hand.apply(ButtonPressed{Button::left, {false, true}, {0, -600}});
    hand.apply(PointerMoved{{20, -600}});
    CHECK(hand.scene.sunAzimuth == 0);
    CHECK(hand.scene.sunZenith == 90);
}

TEST_CASE("input: Ctrl+right drag moves the Moon")
{
    Hand hand;
    hand.drag(Button::right, {false, true}, {0, 0}, {-30, 20});
    CHECK(hand.scene.moonAzimuth == Approx(-3));
    CHECK(hand.scene.moonZenith == Approx(92));
    CHECK(hand.scene.sunAzimuth == 0);
}

TEST_CASE("input: Shift+drag and right drag turn the camera so that the sky follows the pointer")
{
    Hand shift, right;
    shift.drag(Button::left, {true, false}, {10, 10}, {60, 30});
    right.drag(Button::right, {}, {10, 10}, {60, 30});
    CHECK(shift.scene == right.scene);
    CHECK(shift.scene.yaw == Approx(-5).epsilon(0.001)); // at a pitch of up to 2 degrees
    CHECK(shift.scene.pitch == Approx(2));
}

TEST_CASE("input: angles stay within their ranges")
{
    Hand hand;
    hand.scene.fieldOfView = 360; // the whole sky
    hand.drag(Button::left, {false, true}, {500, 1}, {500, 499});
    CHECK(hand.scene.sunZenith == 180);
    hand.drag(Button::right, {}, {0, 0}, {0, 5000});
    CHECK(hand.scene.pitch == 90);
    hand.drag(Button::right, {}, {0, 0}, {5e6, 0});
    CHECK(std::abs(hand.scene.yaw) <= 180);
    CHECK(std::isfinite(hand.scene.yaw));
    hand = Hand();
    hand.scene.sunAzimuth = 179;
    hand.drag(Button::left, {false, true}, {0, 0}, {20, 0});
    CHECK(hand.scene.sunAzimuth == Approx(-179));
}

TEST_CASE("input: a click picks the pixel, a drag doesn't")
{
    Hand hand;
    hand.drag(Button::left, {}, {300, 200}, {301, 202});
    REQUIRE(hand.last.pick);
    CHECK(hand.last.pick->x == 301);
    CHECK(hand.scene == Hand().scene);
    hand.drag(Button::left, {}, {300, 200}, {340, 200});
    CHECK_FALSE(hand.last.pick);
}

TEST_CASE("input: what belongs to a widget leaves the scene alone, but a drag goes on over it")
{
    Hand hand;
    hand.apply(ButtonPressed{Button::left, {false, true}, {10, 10}}, true);
    hand.apply(PointerMoved{{60, 10}}, true);
    hand.apply(WheelTurned{3}, true);
    hand.apply(KeyPressed{Key::tab, {}}, true);
    CHECK_FALSE(hand.last.toggleChrome);
    CHECK(hand.scene == Hand().scene);
    hand.apply(ButtonPressed{Button::left, {false, true}, {400, 10}});
    hand.apply(PointerMoved{{450, 10}}, true);
    hand.apply(ButtonReleased{Button::left, {450, 10}}, true);
    CHECK(hand.scene.sunAzimuth == Approx(5));
    CHECK_FALSE(hand.pointer.dragging());
}

TEST_CASE("input: the wheel zooms within what the projection can show")
{
    Hand hand;
    hand.apply(WheelTurned{1});
    CHECK(hand.scene.fieldOfView == Approx(90));
    hand.apply(WheelTurned{-100});
    CHECK(hand.scene.fieldOfView == 360);
    hand.scene.projection = Projection::perspective;
    hand.apply(WheelTurned{-1});
    CHECK(hand.scene.fieldOfView < 180);
    hand.apply(WheelTurned{1000});
    CHECK(hand.scene.fieldOfView > 0);
}

TEST_CASE("input: keys and dropped files are wishes")
{
    Hand hand;
    const auto wish = [&](const Event& event) {
        hand.apply(event);
        return hand.last;
    };
    CHECK(wish(KeyPressed{Key::tab, {}}).toggleChrome);
    CHECK(wish(KeyPressed{Key::r, {}}).reload);
    CHECK(wish(KeyPressed{Key::escape, {}}).closePick);
    CHECK(wish(KeyPressed{Key::s, {false, true}}).save);
    CHECK_FALSE(wish(KeyPressed{Key::s, {}}).save);
    CHECK(wish(KeyPressed{Key::q, {false, true}}).quit);
    CHECK(wish(Dropped{{"a.atmo"}}).open == std::vector<std::string>{"a.atmo"});
}

TEST_CASE("input: the Moon is put where the Sun is")
{
    Hand hand;
    hand.scene.sunZenith = 33;
    hand.scene.sunAzimuth = -12;
    putMoonOnSun(hand.scene);
    CHECK(hand.scene.moonZenith == 33);
    CHECK(hand.scene.moonAzimuth == -12);
}

TEST_CASE("input: a city is added in the middle of the picture")
{
    Hand hand;
    hand.scene.yaw = 42;
    addCity(hand.scene);
    addCity(hand.scene);
    REQUIRE(hand.scene.cities.size() == 2);
    CHECK(hand.scene.cities[1].azimuth == 42);
    CHECK(hand.scene.cities[1].distance > 2 * hand.scene.cities[1].radius); // not where the camera stands
    CHECK(hand.scene.cities[1].luminance > 0);
}
