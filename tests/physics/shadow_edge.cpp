#include "physics/shadow_edge.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;

namespace {

/// Light of a ray with equal weights between its nodes: half of it at the ends.
double lightOf(const std::vector<double>& above, double sunRadius)
{
    const auto visible = visibleAlong(above, sunRadius);
    double light = 0;
    for (std::size_t k = 0; k < visible.size(); ++k)
        light += visible[k] * (k == 0 || k + 1 == visible.size() ? 0.5 : 1) / static_cast<double>(visible.size() - 1);
    return light;
}

} // namespace

TEST_CASE("shadow's edge: a point-like Sun sinks along a ray and its light fades evenly, without steps")
{
    // Eleven nodes whose horizons are passed one after the other, 1e-3 rad apart.
    double last = 1;
    for (double sunk = -2e-3; sunk < 12e-3; sunk += 1e-5) {
        std::vector<double> above;
        for (int k = 0; k <= 10; ++k)
            above.push_back(k * 1e-3 - sunk);
        const double light = lightOf(above, 0);
        CHECK(light <= last + 1e-15);
        CHECK(last - light < 0.0015); // a step of the Sun is a thousandth of the ray; steps would be of 0.1
        CHECK(light == Approx(std::clamp(1 - sunk / 10e-3, 0., 1.)).margin(0.005)); // a twentieth of a gap
        last = light;
    }
    CHECK(last == 0);
}

TEST_CASE("shadow's edge: where the Sun stands alike along the ray, and at a lonely node, its own disc is what counts")
{
    const double radius = 0.0047;
    for (const double above : {-0.0047, -0.002, 0., 0.001, 0.0047}) {
        CHECK(visibleAlong(above, above, above, radius) == visibleDiscFraction(above, radius));
        CHECK(visibleAlong(std::vector<double>{above}, radius) == std::vector<double>{visibleDiscFraction(above, radius)});
    }
    // Of a disc much larger than the gaps as much as of the disc alone: to the square of their ratio.
    CHECK(visibleAlong(0.9e-3, 1e-3, 1.1e-3, radius) == Approx(visibleDiscFraction(1e-3, radius)).epsilon(1e-3));
}

TEST_CASE("shadow's edge: neighbours that see more of the Sun add to what a node counts for, the same from both sides")
{
    CHECK(visibleAlong(-1e-3, -1e-4, 5e-3, 0.) > 0.5);
    CHECK(visibleAlong(-1e-3, -1e-4, 5e-3, 0.) == visibleAlong(5e-3, -1e-4, -1e-3, 0.));
    CHECK(visibleAlong(-1e-3, 0., 1e-3, 0.) == 0.5);
}
