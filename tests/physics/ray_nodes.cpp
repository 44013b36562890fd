#include "media.hpp"
#include "physics/ray.hpp"
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

using namespace sky::physics;

TEST_CASE("ray nodes: closer than cells, each has its share of a thin layer's light")
{
    // Twenty cells, two hundred nodes: thin even air, seen at a slant, scatters as much in every gap.
    const auto medium = sky::test::layer(1e-3, 1, 0, sky::test::isotropicPhase);
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 2, false);
    RayTracer tracer(profile, optics);
    constexpr int nodes = 200;
    const RayNodes ray = tracer.trace(0, 0.5, nodes, false);
    const double whole = std::accumulate(ray.weights.begin(), ray.weights.end(), 0.);
    CHECK(whole == Approx(2e-3).epsilon(2e-3)); // attenuated by half of itself
    double centre = 0;
    for (int k = 0; k < nodes; ++k) {
        INFO("node " << k);
        // Half the gaps on both sides, in a layer of 1000 m; attenuation and the bending of the ground are less than 0.3 %.
        const double before = ray.nodes[std::max(k - 1, 0)].altitude, after = ray.nodes[std::min(k + 1, nodes - 1)].altitude;
        CHECK(ray.weights[k] == Approx(whole * (after - before) / 2000).epsilon(0.02));
        centre += ray.weights[k] * ray.nodes[k].altitude / whole;
    }
    CHECK(centre == Approx(500).epsilon(1e-3));
}

TEST_CASE("ray nodes: where light comes from, not in empty air nor behind opaque air")
{
    // Two layers in a vacuum, the lower one so thick that a few metres of it hide the rest.
    const auto medium = sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase),
                                               {0, 100, 100.001, 200, 200.001, 800, 800.001, 900, 900.001, 1000}, //
                                               {0, 0, 1e5, 1e5, 0, 0, 1, 1, 0, 0});
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 2, false);
    RayTracer tracer(profile, optics);
    for (const auto nodesFor : {NodesFor::Sunlight, NodesFor::Field}) {
        const RayNodes ray = tracer.trace(1000, -0.7, 40, true, nodesFor);
        const auto within = [&](double low, double high) {
            return std::count_if(ray.nodes.begin(), ray.nodes.end(),
                                 [&](const RayNodes::Node& node) { return node.altitude >= low && node.altitude <= high; });
        };
        CHECK(within(799.99, 900.01) + within(199, 200.01) >= 30); // others where the shadow may begin
        CHECK(within(799.99, 900.01) >= 6);
        CHECK(within(199, 200.01) >= 6);
    }
}

TEST_CASE("ray nodes: nothing of what is above an opaque layer, though the last node in clear air is far before it")
{
    // Grazing rays that leave the layer at its lower edge, and meet it again, some kilometres on.
    const auto medium = sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), {0, 100, 100.001, 200, 200.001, 1000},
                                               {0, 0, 1e3, 1e3, 0, 0});
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 2, false);
    RayTracer tracer(profile, optics);
    for (const double mu : {-5e-4, -1e-3, -2e-3, -4e-3})
        for (const auto nodesFor : {NodesFor::Sunlight, NodesFor::Field}) {
            INFO("mu " << mu);
            const RayNodes ray = tracer.trace(100.002, mu, 10, false, nodesFor);
            double below = 0, above = 0;
            for (std::size_t k = 0; k < ray.nodes.size(); ++k)
                (ray.nodes[k].altitude < 150 ? below : above) += ray.weights[k];
            CHECK(below == Approx(1).epsilon(1e-3)); // all that can be seen
            CHECK(above < 1e-12);
        }
}

TEST_CASE("ray nodes: cut at nodes, a cell's light keeps its amount and its centre")
{
    for (const double centre : {0.2, 0.45, 0.5, 0.62}) {
        std::vector<CellPart> parts;
        cutAtNodes({0, 1}, {0, 0.15, 0.15, 0.4, 0.9, 1}, parts);
        REQUIRE(parts.size() == 4);
        const std::vector<double> positions{0, 0.15, 0.15, 0.4, 0.9, 1};
        double amount = 0, moment = 0;
        for (const CellPart& part : parts) {
            const double slope = std::clamp(6 * centre - 3, -1., 1.);
            const auto light = PartLight<double>(part).of<double>({slope, centre - 0.5 - slope / 6});
            amount += light.share;
            moment += light.share * positions[part.node] + light.far * (positions[part.node + 1] - positions[part.node]);
        }
        CHECK(amount == Approx(1).epsilon(1e-6));
        CHECK(moment == Approx(centre).epsilon(1e-6));
    }
}
