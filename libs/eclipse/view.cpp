// The sky of a finished field: rays from the observer, which meet other points of the grid in every azimuth.

#include "base/not_negative.hpp"
#include "base/parallel.hpp"
#include "eclipse/state.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace sky::eclipse {

namespace {

/// Light below this is darkness, where a quotient has no meaning.
constexpr float dark = 1e-33f;

float ratioOf(float eclipsed, float uneclipsed) { return uneclipsed > dark ? std::clamp(eclipsed / uneclipsed, 0.f, 1.f) : 1.f; }

/// Light that the points of one level pair send at one zenith angle: factors of cos(m phi), then sin(m phi), kept per point.
class Fold
{
public:
    Fold(int degree, int points)
        : degree_(degree), terms_(2 * degree + 1), folded_(static_cast<std::size_t>(points * terms_)),
          known_(static_cast<std::size_t>(points))
    {
    }

    void begin(const Lane* lower, const Lane* upper, float share, const Lane* coefficients)
    {
        lower_ = lower;
        upper_ = upper;
        share_ = share;
        coefficients_ = coefficients;
        std::fill(known_.begin(), known_.end(), char(0));
    }

    /// The folded light of a point.
    const Lane* at(int point)
    {
        Lane* terms = &folded_[static_cast<std::size_t>(point * terms_)];
        auto& known = known_[static_cast<std::size_t>(point)];
        if (!known)
            foldPoint(degree_, lower_ + point * allHarmonics(degree_), upper_ + point * allHarmonics(degree_), share_, coefficients_,
                      terms);
        known = 1;
        return terms;
    }

private:
    int degree_, terms_;
    Lanes folded_; // [point][term]
    std::vector<char> known_;
    const Lane *lower_ = nullptr, *upper_ = nullptr, *coefficients_ = nullptr;
    float share_ = 0;
};

/// The points around a place and their weights.
struct Corners {
    int point[16];
    float weight[16];
    bool mirrored[16];
    Corners(const Grid& grid, float x, float y)
    {
        const Neighbours i = grid.x.at(x), j = grid.y.at(y);
        for (int c = 0; c < 16; ++c) {
            const int row = j.index[c / 4];
            point[c] = std::abs(row) * grid.x.count() + i.index[c % 4];
            weight[c] = j.weight[c / 4] * i.weight[c % 4];
            mirrored[c] = j.mirrored != (row < 0);
        }
    }
};

} // namespace

float ViewLight::skyRatio(int ray, int azimuth, int wavelength) const
{
    const auto i = static_cast<std::size_t>((ray * azimuths + azimuth) * wavelengths + wavelength);
    return ratioOf(eclipsed[i], uneclipsed[i]);
}

float ViewLight::groundRatio(int ray, int azimuth, int wavelength) const
{
    const auto i = static_cast<std::size_t>((ray * azimuths + azimuth) * wavelengths + wavelength);
    return ratioOf(groundEclipsed[i], groundUneclipsed[i]);
}

class TracedViews
{
public:
    struct Ray {
        bool hitsGround;
        std::vector<Place> places; ///< of the nodes
        float groundDistance;
        Lanes coefficients; ///< [group][node][lm]
    };
    std::vector<Ray> rays;
};

std::shared_ptr<const TracedViews> traceViews(const AirRays& air, const std::vector<ViewRay>& views)
{
    auto result = std::make_shared<TracedViews>();
    result->rays.resize(views.size());
    base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(air.profile, air.optics, 2);
        for (std::size_t v = static_cast<std::size_t>(thread); v < views.size(); v += static_cast<std::size_t>(threads)) {
            const ViewRay& view = views[v];
            const auto ray = tracer.trace(view.altitude, view.mu, air.settings.viewNodes, view.hitsGround);
            const auto distanceOf = [&](const physics::RayNodes::Node& n) {
                return view.groundDistance + groundDistance(air.profile.planet().radius, n.sunScale, n.nuScale, view.mu);
            };
            auto& traced = result->rays[v];
            traced.hitsGround = view.hitsGround;
            for (const auto& node : ray.nodes)
                traced.places.push_back(air.levels.place(node.altitude, distanceOf(node)));
            traced.groundDistance = static_cast<float>(distanceOf(ray.ground));
            traced.coefficients = air.coefficientsOf(ray);
        }
    });
    return result;
}

std::shared_ptr<const TracedViews> traceNodes(const AirRays& air, const std::vector<physics::RayNodes>& rays, const std::vector<double>& mu)
{
    auto result = std::make_shared<TracedViews>();
    const auto row = static_cast<std::size_t>(air.scatterers * air.wavelengths);
    physics::RayNodes one;
    for (std::size_t r = 0; r < rays.size(); ++r)
        for (std::size_t k = 0; k < rays[r].nodes.size(); ++k) {
            const auto& node = rays[r].nodes[k];
            one.nodes.assign(1, node);
            one.weights.assign(&rays[r].weights[k * row], &rays[r].weights[k * row] + row);
            const double distance = groundDistance(air.profile.planet().radius, node.sunScale, node.nuScale, mu[r]);
            result->rays.push_back({false, {air.levels.place(node.altitude, distance)}, 0, air.coefficientsOf(one)});
        }
    return result;
}

ViewLight ScatteredField::view(const std::vector<ViewRay>& views, const std::vector<double>& azimuths) const
{
    return view(*traceViews(*state_->air, views), azimuths);
}

ViewLight ScatteredField::view(const TracedViews& views, const std::vector<double>& azimuths) const
{
    return state_->look(state_->total, views, azimuths);
}

ViewLight ScatteredField::State::look(const Light& light, const TracedViews& views, const std::vector<double>& azimuths) const
{
    const int wavelengths = air->wavelengths, degree = light.degree, count = static_cast<int>(azimuths.size());
    const std::size_t size = views.rays.size() * azimuths.size() * static_cast<std::size_t>(wavelengths);
    ViewLight result{
        count, wavelengths, std::vector<float>(size), std::vector<float>(size), std::vector<float>(size), std::vector<float>(size)};
    if (light.moments.empty())
        return result;

    // Directions here, and their waves.
    std::vector<float> turned, cosines, sines; // [azimuth], [azimuth][m]
    for (const double azimuth : azimuths) {
        const double here = frame.azimuthOf(azimuth);
        turned.push_back(static_cast<float>(here));
        for (int m = 0; m <= degree; ++m) {
            cosines.push_back(static_cast<float>(std::cos(m * here)));
            sines.push_back(static_cast<float>(std::sin(m * here)));
        }
    }
    const auto store = [&](const Lane& lane, std::size_t ray, int azimuth, int group, std::vector<float>& eclipsed,
                           std::vector<float>& uneclipsed) {
        for (int i = 0; i < waves && group * waves + i < wavelengths; ++i) {
            const auto at = (ray * azimuths.size() + static_cast<std::size_t>(azimuth)) * static_cast<std::size_t>(wavelengths) +
                            static_cast<std::size_t>(group * waves + i);
            eclipsed[at] = base::notNegative(lane[i]);
            uneclipsed[at] = base::notNegative(lane[waves + i]);
        }
    };
    const float observer = static_cast<float>(frame.observer());
    const int terms = physics::harmonicCount(air->degree);
    base::parallel([&](int thread, int threads) {
        Fold fold(degree, grid.points());
        Lanes sums;
        std::vector<Corners> corners;
        const auto standAt = [&](float distance) { // the points around a place on the ray, in every azimuth
            corners.clear();
            for (const float azimuth : turned)
                corners.emplace_back(grid, distance * std::cos(azimuth), observer + distance * std::sin(azimuth));
        };
        for (std::size_t v = static_cast<std::size_t>(thread); v < views.rays.size(); v += static_cast<std::size_t>(threads)) {
            const auto& ray = views.rays[v];
            const int nodes = static_cast<int>(ray.places.size());
            for (int g = 0; g < air->groups; ++g) {
                sums.assign(azimuths.size(), Lane{});
                for (int k = 0; k < nodes; ++k) {
                    const Place& place = ray.places[static_cast<std::size_t>(k)];
                    standAt(place.distance);
                    fold.begin(momentsAt(light, g, place.level), momentsAt(light, g, place.level + 1), place.share,
                               &ray.coefficients[static_cast<std::size_t>((g * nodes + k) * terms)]);
                    for (std::size_t a = 0; a < azimuths.size(); ++a) {
                        const std::size_t first = a * (static_cast<std::size_t>(degree) + 1);
                        const Lane* points[16];
                        for (int c = 0; c < 16; ++c)
                            points[c] = fold.at(corners[a].point[c]);
                        addFolded(degree, 16, points, corners[a].weight, corners[a].mirrored, &cosines[first], &sines[first], sums[a]);
                    }
                }
                for (int a = 0; a < count; ++a)
                    store(sums[static_cast<std::size_t>(a)], v, a, g, result.eclipsed, result.uneclipsed);
                if (!ray.hitsGround)
                    continue;
                standAt(ray.groundDistance);
                const Lane* irradiance = &light.irradiance[static_cast<std::size_t>(g) * points()];
                for (int a = 0; a < count; ++a) {
                    Lane sum{};
                    for (int c = 0; c < 16; ++c)
                        sum += corners[static_cast<std::size_t>(a)].weight[c] * irradiance[corners[static_cast<std::size_t>(a)].point[c]];
                    store(sum, v, a, g, result.groundEclipsed, result.groundUneclipsed);
                }
            }
        }
    });
    return result;
}

} // namespace sky::eclipse
