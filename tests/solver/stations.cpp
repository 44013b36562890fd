#include "solver/stations.hpp"
#include "../montecarlo/sample_air.hpp"
#include "physics/optics.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace sky;
using solver::Stations;

namespace {

constexpr double bend = 0.015, tolerance = 1e-3;

struct Air {
    physics::Medium medium = test::sampleEarth(test::Aerosol::Yes);
    physics::Profile profile{medium};
    physics::Optics optics = physics::makeOptics(medium, 4, true);
    physics::RayTracer tracer{profile, optics};
};

/// Angle at the planet's centre between the start of a ray and a place on it.
double angleOf(const physics::RayNodes& ray, const physics::RayNodes::Node& place)
{
    const double mu = ray.nodes.front().mu;
    return std::atan2(place.nuScale * std::sqrt(1 - mu * mu), place.sunScale + place.nuScale * mu);
}

/// Light along a ray whose source depends on that angle as `source` does: node by node, and by stations.
template<class Source>
std::pair<double, double> sums(const physics::RayNodes& ray, const Stations& stations, Source&& source)
{
    double exact = 0, shared = 0;
    for (std::size_t k = 0; k < stations.shares.size(); ++k) {
        const auto& share = stations.shares[k];
        const double angle = angleOf(ray, k < ray.nodes.size() ? ray.nodes[k] : ray.ground);
        if (share.seen == 0)
            continue;
        exact += double(share.seen) * source(angle);
        shared += double(share.seen) * double(share.nearer) * source(angleOf(ray, stations.places[share.station]));
        if (share.farther > 0)
            shared += double(share.seen) * double(share.farther) * source(angleOf(ray, stations.places[share.station + 1]));
    }
    return {exact, shared};
}

} // namespace

TEST_CASE("stations: all light of a ray, each node's between two neighbours")
{
    Air air;
    for (const double altitude : {0., 3e3, 5e4})
        for (const double mu : {-0.9, -0.02, 0.001, 0.1, 0.5, 1.})
            for (const bool fromGround : {false, true}) {
                const bool hits = mu < -0.5;
                const auto ray =
                    air.tracer.trace(altitude, altitude == 0 ? std::abs(mu) : mu, 10, hits && altitude > 0, physics::NodesFor::Field);
                const Stations stations(ray, air.medium.groundAlbedo, fromGround, bend, tolerance);
                REQUIRE(stations.shares.size() == 11);
                REQUIRE(stations.places.size() <= 11);
                double seen = 0;
                for (const auto& share : stations.shares) {
                    seen += double(share.seen);
                    if (share.seen == 0)
                        continue;
                    REQUIRE(share.nearer + share.farther == Approx(1).margin(1e-6));
                    REQUIRE(share.nearer >= 0);
                    REQUIRE(share.farther >= 0);
                    REQUIRE(share.station + (share.farther > 0 ? 1 : 0) < static_cast<int>(stations.places.size()));
                }
                CHECK(seen == Approx(1).margin(1e-5));
                CHECK((stations.shares.back().seen > 0) == (fromGround && ray.hitsGround));
            }
}

TEST_CASE("stations: one straight up, few inside a cloud's depth, all where none may err")
{
    Air air;
    const auto up = air.tracer.trace(0, 1, 10, false, physics::NodesFor::Field);
    CHECK(Stations(up, air.medium.groundAlbedo, true, bend, tolerance).places.size() == 1);
    const auto slant = air.tracer.trace(0, 0.3, 10, false, physics::NodesFor::Field);
    const Stations exact(slant, air.medium.groundAlbedo, true, bend, 0);
    CHECK(exact.places.size() == 10);
    for (const auto& share : exact.shares)
        CHECK((share.seen == 0 || share.nearer == 1 || share.farther == 1));
    const auto some = Stations(slant, air.medium.groundAlbedo, true, bend, tolerance).places.size();
    CHECK(some < 10);
    CHECK(some > 1);
}

TEST_CASE("stations: light linear in the angle is exact, light that bends errs within the tolerance")
{
    Air air;
    for (const double altitude : {0., 1e3, 3e4})
        for (const double mu : {0.002, 0.05, 0.2, 0.6}) {
            const auto ray = air.tracer.trace(altitude, mu, 12, false, physics::NodesFor::Field);
            const Stations stations(ray, air.medium.groundAlbedo, true, bend, tolerance);
            const auto gaps = static_cast<double>(stations.places.size());
            if (stations.places.size() > 1) {
                const auto [exact, shared] = sums(ray, stations, [](double angle) { return 1 + angle / bend; });
                CHECK(shared == Approx(exact).epsilon(1e-5));
            }
            const auto [exact, shared] =
                sums(ray, stations, [](double angle) { return 1 + std::cos(angle / bend); }); // curvature <= 1 / bend^2
            CHECK(std::abs(shared - exact) <= gaps * tolerance + 1e-6);
        }
}
