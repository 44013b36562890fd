#include "physics/limb.hpp"
#include "base/angles.hpp"
#include "physics/geometry.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::base::pi;

namespace {

constexpr double radius = 0.0047;

/// Depths over `rays` even steps from the horizon to five radii above it.
template<class DepthAt>
LimbDepths limb(const DepthAt& depthAt, int rays = 501)
{
    std::vector<double> elevations, depths;
    for (int i = 0; i < rays; ++i) {
        elevations.push_back(5 * radius * i / (rays - 1));
        depths.push_back(depthAt(elevations.back()));
    }
    return {elevations, depths};
}

double meanTransmittance(const LimbDepths& depths, double top, bool withSine = false)
{
    double result = 0;
    depths.meanDepth(top, radius, withSine, &result);
    return std::exp(-result);
}

} // namespace

TEST_CASE("limb: even air dims every part of the disc alike, however little of it shows")
{
    const auto even = limb([](double) { return 0.7; }, 2);
    for (const double top : {0., 1e-12, 1e-5, 0.5 * radius, radius, 2 * radius, 4 * radius})
        for (const bool withSine : {false, true})
            CHECK(meanTransmittance(even, top, withSine) == Approx(std::exp(-0.7)).epsilon(1e-12));
}

TEST_CASE("limb: of a disc behind an opaque layer with a sharp edge, the segment above the edge is seen")
{
    const double edge = 0.8 * radius;
    const auto layer = limb([&](double elevation) {
        return elevation < edge - 0.005 * radius ? 150. : 0.;
    }); // the ray at the edge is the first that sees light
    for (const double top : {0.9 * radius, radius, 1.5 * radius, 2 * radius, 2.5 * radius}) {
        const double above = top - radius;
        INFO("upper limb at " << top / radius << " radii");
        CHECK(meanTransmittance(layer, top) ==
              Approx(visibleDiscFraction(above - edge, radius) / visibleDiscFraction(above, radius))
                  .margin(1e-4)); // light between that ray and the one below falls within 1/150 of the step
    }
    // Weighed with the height over the horizon: the upper half of a disc has its centroid 4 radii / (3 pi) above the middle.
    CHECK(meanTransmittance(limb([&](double elevation) { return elevation < 2 * radius ? 150. : 0.; }), 3 * radius, true) ==
          Approx(0.5 * (2 + 4 / (3 * pi)) / 2).epsilon(1e-3));
}

TEST_CASE("limb: depths that change evenly over the whole disc have the moments of a disc")
{
    const double slope = 0.3 / radius; // 0.3 from the centre to a limb; mean square of the height is a quarter of the radius'
    const auto even = limb([&](double elevation) { return 5 - slope * elevation; });
    CHECK(meanTransmittance(even, 3 * radius) ==
          Approx(std::exp(-(5 - slope * 2 * radius)) * (1 + 0.5 * 0.25 * 0.09 + 0.125 / 24 * 0.0081)).epsilon(1e-6));
}
