#include "eclipse/frame.hpp"
#include "base/angles.hpp"
#include "eclipse/grid.hpp"
#include "scene.hpp"
#include <catch2/catch.hpp>

using namespace sky::eclipse;
using namespace sky::eclipse::test;
using sky::base::pi;

namespace {

double distance(const Vector& a, const Vector& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

} // namespace

TEST_CASE("frame: the observer is the origin of the camera's frame, wherever the Moon is")
{
    const Earth earth;
    for (const double left : {-0.03, -1e-5, 0., 0.004, 0.03})
        for (const double elevation : {-0.05, 0.3, 1.2, pi / 2}) {
            CAPTURE(left, elevation);
            const Frame frame(earth.bodies(elevation, 0.002, left, 4e3, 2.1));
            const auto axes = frame.axesAt(0, frame.observer());
            CHECK(frame.observer() >= 0);
            CHECK(distance(frame.position(axes, 4e3), {0, 0, 0}) < 1e-6 * 6.4e6); // rounding of radii, in double
            CHECK(distance(axes.up, {0, 0, 1}) < 1e-9);
        }
}

TEST_CASE("frame: the planet's centre, Sun and Moon lie in the mirror plane")
{
    const Earth earth;
    const auto bodies = earth.bodies(0.5, 0.001, 0.01);
    const Frame frame(bodies);
    const auto axes = frame.axesAt(300e3, 0); // on the plane: `across` is its normal
    const Vector centre{0, 0, -bodies.planet.radius};
    for (const auto& [direction, far] : {std::pair{bodies.sunDirection, bodies.sunDistance}, {bodies.moonDirection, bodies.moonDistance}}) {
        const auto place = sky::physics::placeOfBody(bodies.planet, 0, direction, far);
        double off = 0;
        for (std::size_t i = 0; i < 3; ++i)
            off += (place[i] - centre[i]) * axes.across[i];
        CHECK(std::abs(off) < 1e-9 * far);
    }
    CHECK(frame.sunAt(axes)[1] == Approx(0).margin(1e-9));
    CHECK(frame.sunAt(axes)[0] > 0); // x runs towards the Sun
}

TEST_CASE("frame: the shadow stands where the geometry of the eclipse has it")
{
    const Earth earth;
    const auto bodies = earth.bodies(0.6, 0.001); // the Moon above the Sun: its shadow falls behind the observer
    const auto ground = sky::physics::groundShadow(sky::physics::makeShadow(bodies), bodies);
    REQUIRE(ground.central);
    const Frame frame(bodies);
    CHECK(frame.observer() == Approx(0).margin(1));
    CHECK(frame.shadowSunSine() == Approx(std::sin(ground.sunElevation)).margin(0.01));
    // The axis enters the sphere of a tenth of the air's height: 12 km or less above the ground, so much farther along.
    CHECK(frame.shadow() == Approx(-std::hypot(ground.place[0], ground.place[1])).margin(12e3 / std::tan(ground.sunElevation)));
}

TEST_CASE("frame: a direction at the observer keeps its angle to the Sun")
{
    const Earth earth;
    for (const double left : {-0.01, 0.01}) {
        const auto bodies = earth.bodies(0.6, 0, left, 0, 1.3);
        const Frame frame(bodies);
        const auto sun = frame.sunAt(frame.axesAt(0, frame.observer()));
        const double sunAzimuth = std::atan2(sun[1], sun[0]);
        for (const double azimuth : {0., 1., 4.}) {
            const double here = frame.azimuthOf(azimuth);
            CHECK(std::cos(here - sunAzimuth) == Approx(std::cos(azimuth - 1.3)).margin(1e-4)); // parallax of the Sun: 4e-5
        }
    }
}

TEST_CASE("line: cubics are reproduced but for the end intervals, parabolas in all of a mirrored line")
{
    const Line line({0, 1, 2.5f, 4, 7}, true);
    const auto value = [&](float x, auto f) {
        const auto n = line.at(x);
        double sum = 0, weights = 0;
        for (int i = 0; i < 4; ++i) {
            const int k = n.index[i];
            const float p = k < 0 ? -line.points()[std::size_t(-k)] : line.points()[std::size_t(k)];
            sum += double(n.weight[i]) * f(double(n.mirrored ? -p : p));
            weights += double(n.weight[i]);
        }
        CHECK(weights == Approx(1).margin(1e-6));
        return sum;
    };
    for (const float x : {-3.9f, -2.f, -0.3f, 0.f, 0.5f, 1.7f, 3.3f}) {
        CHECK(value(x, [](double p) { return 2 - p + 0.3 * p * p; }) == Approx(2 - double(x) + 0.3 * double(x) * double(x)).epsilon(1e-5));
    }
    CHECK(value(100, [](double p) { return p; }) == Approx(7)); // beyond the end its value counts
}

TEST_CASE("clustered points increase, reach both ends and crowd at both centres")
{
    const auto nodes = clusteredNodes(-1e6, 2e6, {0, 1e6}, {50e3, 100e3}, 31);
    REQUIRE(nodes.size() == 31);
    CHECK(nodes.front() == -1e6);
    CHECK(nodes.back() == 2e6);
    double atCentre = 0, farOff = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        REQUIRE(nodes[i] > nodes[i - 1]);
        if (nodes[i - 1] <= 0 && nodes[i] > 0)
            atCentre = nodes[i] - nodes[i - 1];
        if (nodes[i - 1] <= 5e5 && nodes[i] > 5e5)
            farOff = nodes[i] - nodes[i - 1];
    }
    CHECK(atCentre < 0.5 * farOff);
}
