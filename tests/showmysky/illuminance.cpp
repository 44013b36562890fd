// Illuminance by what a Moon leaves of the Sun's disc, against closed forms.

#include "illuminance.hpp"
#include "base/angles.hpp"
#include <catch2/catch.hpp>
#include <cmath>

using namespace showmysky;
using sky::base::pi;

namespace {

constexpr double radius = 0.0046, solidAngle = 2 * pi * radius * radius / 2;

std::vector<Texel> evenly(float low, float high)
{
    std::vector<Texel> colours;
    for (int k = 0; k < 33; ++k)
        colours.push_back({low, low + (high - low) * static_cast<float>(k) / 32, 0, 1});
    return colours;
}

} // namespace

TEST_CASE("illuminance: what a Moon leaves of the disc has its area, and its middle where the closed form says")
{
    for (const double moon : {0.9, 0.99, 1.0, 1.02, 1.06})
        for (const double separation : {0., 0.003, 0.0301, 0.061, 0.2, 0.9, 1.5, 1.95, 2.2})
            for (const double up : {-1., 0.3, 1.}) {
                CAPTURE(moon, separation, up);
                const sky::physics::Discs<double> discs{radius, moon * radius, separation * radius};
                const double left = sky::physics::visibleFraction(discs);
                Illuminance light;
                // Y grows from 0 to 2 across the disc: over what is left, its mean is 1 and the middle's height.
                addCrescentIlluminance(evenly(0, 2), 0.6, {discs, up, {}}, 0, light);
                CHECK(static_cast<double>(light.sunFacing[3]) == Approx(left * solidAngle).epsilon(1e-3).margin(1e-12));
                const double height = up * sky::physics::middleOfVisible(discs) / radius;
                CHECK(static_cast<double>(light.sunFacing[1]) == Approx(left * solidAngle * (1 + height)).epsilon(2e-3).margin(1e-12));
                if (left > 0)
                    CHECK(static_cast<double>(light.sunHorizontal[3] / light.sunFacing[3]) ==
                          Approx(std::sin(0.6 + radius * height)).epsilon(1e-4));
            }
}

TEST_CASE("illuminance: a disc that nothing hides is the same by chords and by radii, above the horizon and on it")
{
    for (const double elevation : {0.5, 0.002, 0., -0.002}) {
        CAPTURE(elevation);
        Illuminance byChords, byRadii;
        addSunIlluminance(evenly(0.2f, 2), elevation, radius, 0, byChords);
        addCrescentIlluminance(evenly(0.2f, 2), elevation, {{radius, radius, 3 * radius}, 0.4, {}}, 0, byRadii);
        CHECK(byRadii.sunFacing[1] == Approx(byChords.sunFacing[1]).epsilon(1e-3));
        CHECK(byRadii.sunHorizontal[1] == Approx(byChords.sunHorizontal[1]).epsilon(0.01)); // sines in the middle of 32 segments
    }
}

TEST_CASE("illuminance: a disc that is darker at its limb has as much light, and more of it in its middle")
{
    const Texel exponents{0.3f, 0.6f, 0.8f, 0.5f};
    const std::vector<Texel> colours(33, Texel{1, 1, 1, 1});
    Illuminance whole, ring;
    addCrescentIlluminance(colours, 0.6, {{radius, radius, 3 * radius}, 1, exponents}, 0, whole);
    addCrescentIlluminance(colours, 0.6, {{radius, 0.9 * radius, 0}, 1, exponents}, 0, ring);
    for (std::size_t c = 0; c < 4; ++c) {
        CHECK(static_cast<double>(whole.sunFacing[c]) == Approx(solidAngle).epsilon(2e-3));
        // Over the ring: (1 - r^2)^(1 + a/2) of the light stands outside of r.
        CHECK(static_cast<double>(ring.sunFacing[c]) ==
              Approx(solidAngle * std::pow(1 - 0.81, 1 + 0.5 * static_cast<double>(exponents[c]))).epsilon(5e-3));
    }
}
