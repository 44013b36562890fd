// Fewer places than nodes: what they keep of the nodes' light, and what they cost.
#include "eclipse/stations.hpp"
#include <catch2/catch.hpp>
#include <cmath>

using namespace sky::eclipse;

namespace {

/// A ray that rises through levels: nodes ever wider apart, light that fades.
struct Ray {
    std::vector<Place> nodes;
    std::vector<double> weight;

    explicit Ray(float length, int count = 12)
    {
        double sum = 0;
        for (int k = 0; k < count; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(count - 1);
            nodes.push_back({k / 2, k % 2 ? 0.75f : 0.25f, length * t * t});
            weight.push_back(std::exp(-5. * static_cast<double>(t)));
            sum += weight.back();
        }
        for (double& w : weight)
            w /= sum;
    }

    /// Light by the nodes themselves of a field that changes as f(distance) along the ground and by g per level.
    template<class Along>
    double light(Along&& along) const
    {
        double sum = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k)
            sum += weight[k] * along(static_cast<double>(nodes[k].distance)) * (1 + static_cast<double>(nodes[k].level + nodes[k].share));
        return sum;
    }
    /// The same by stations.
    template<class Along>
    double light(const Sharing& sharing, Along&& along) const
    {
        double sum = 0;
        for (const Station& station : sharing.places.stations)
            for (const auto& part : sharing.parts)
                if (part.entry >= station.first && part.entry < station.first + station.count)
                    sum += weight[static_cast<std::size_t>(part.node)] * static_cast<double>(part.share) *
                           along(static_cast<double>(station.distance)) * (1 + sharing.places.levels[static_cast<std::size_t>(part.entry)]);
        return sum;
    }
};

} // namespace

TEST_CASE("eclipse stations: fields linear in distance and level keep all of their light")
{
    for (const float length : {0.f, 100.f, 30e3f, 300e3f}) {
        const Ray ray(length);
        const auto sharing = shareOut(ray.nodes, ray.weight, 50e3, 5e-3);
        const auto linear = [](double x) { return 3 - x / 200e3; };
        CHECK(ray.light(sharing, linear) == Approx(ray.light(linear)).epsilon(1e-5)); // single precision
    }
}

TEST_CASE("eclipse stations: chords of a curved field cost what was allowed")
{
    // exp(x / scale) changes by itself within the scale; near the ray's start, where the weights are, its second derivative is its value.
    const double scale = 50e3;
    const auto curved = [&](double x) { return std::exp(-x / scale); };
    for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
        const Ray ray(100e3f);
        const auto sharing = shareOut(ray.nodes, ray.weight, scale, tolerance);
        const double gained = ray.light(sharing, curved) / ray.light(curved) - 1;
        CHECK(gained >= 0);             // chords of a convex curve lie above it
        CHECK(gained <= 2 * tolerance); // the light counts here by its level too
    }
}

TEST_CASE("eclipse stations: short rays need few, and without tolerance every node is one")
{
    const Ray steep(2e3f), level(800e3f);
    CHECK(shareOut(steep.nodes, steep.weight, 50e3, 5e-3).places.stations.size() == 2);
    CHECK(shareOut(level.nodes, level.weight, 50e3, 5e-3).places.stations.size() > 6);
    CHECK(shareOut(level.nodes, level.weight, 50e3, 0).places.stations.size() == level.nodes.size());
    CHECK(shareOut({}, {}, 50e3, 5e-3).places.stations.empty());
    CHECK(shareOut({{3, 0.5f, 0}}, {1.}, 50e3, 5e-3).places.stations.size() == 1);
}
