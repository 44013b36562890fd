// The sky of a finished field: rays from the observer, which meet other points of the grid in every azimuth.

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
    Fold(int degree, int points) : degree_(degree), terms_(2 * degree + 1), folded_(static_cast<std::size_t>(points * terms_)), known_(static_cast<std::size_t>(points)) {}

    void begin(const Lane* lower, const Lane* upper, float share, const Lane* coefficients)
    {
        lower_ = lower;
        upper_ = upper;
        share_ = share;
        coefficients_ = coefficients;
        std::fill(known_.begin(), known_.end(), char(0));
    }

    /// Adds `weight` times the light at a point; `mirrored` swaps the sides.
    void add(int point, float weight, bool mirrored, const float* cosines, const float* sines, Lane& sum)
    {
        Lane* terms = &folded_[static_cast<std::size_t>(point * terms_)];
        if (!known_[static_cast<std::size_t>(point)]) {
            fold(point, terms);
            known_[static_cast<std::size_t>(point)] = 1;
        }
        Lane value = terms[0];
        for (int m = 1; m <= degree_; ++m)
            value += cosines[m] * terms[m] + (mirrored ? -sines[m] : sines[m]) * terms[degree_ + m];
        sum += weight * value;
    }

private:
    void fold(int point, Lane* terms) const
    {
        const int harmonics = allHarmonics(degree_);
        const Lane *a = lower_ + point * harmonics, *b = upper_ + point * harmonics;
        std::fill_n(terms, terms_, Lane{});
        int sine = physics::harmonicCount(degree_);
        for (int l = 0, lm = 0; l <= degree_; ++l)
            for (int m = 0; m <= l; ++m, ++lm) {
                terms[m] += coefficients_[lm] * (a[lm] + share_ * (b[lm] - a[lm]));
                if (m > 0) {
                    terms[degree_ + m] += coefficients_[lm] * (a[sine] + share_ * (b[sine] - a[sine]));
                    ++sine;
                }
            }
    }
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

ViewLight ScatteredField::view(const std::vector<ViewRay>& views, const std::vector<double>& azimuths) const
{
    const State& s = *state_;
    const AirRays& air = *s.air;
    const int wavelengths = air.wavelengths, degree = air.degree, count = static_cast<int>(azimuths.size());
    const std::size_t size = views.size() * azimuths.size() * static_cast<std::size_t>(wavelengths);
    ViewLight result{count, wavelengths, std::vector<float>(size), std::vector<float>(size), std::vector<float>(size), std::vector<float>(size)};
    if (s.total.moments.empty())
        return result;

    // Directions here, and their waves.
    std::vector<float> turned, cosines, sines; // [azimuth], [azimuth][m]
    for (const double azimuth : azimuths) {
        const double here = s.frame.azimuthOf(azimuth);
        turned.push_back(static_cast<float>(here));
        for (int m = 0; m <= degree; ++m) {
            cosines.push_back(static_cast<float>(std::cos(m * here)));
            sines.push_back(static_cast<float>(std::sin(m * here)));
        }
    }
    const auto store = [&](const Lane& light, std::size_t ray, int azimuth, int group, std::vector<float>& eclipsed, std::vector<float>& uneclipsed) {
        for (int i = 0; i < waves && group * waves + i < wavelengths; ++i) {
            const auto at = (ray * azimuths.size() + static_cast<std::size_t>(azimuth)) * static_cast<std::size_t>(wavelengths) +
                            static_cast<std::size_t>(group * waves + i);
            eclipsed[at] = std::max(0.f, light[i]);
            uneclipsed[at] = std::max(0.f, light[waves + i]);
        }
    };
    const float observer = static_cast<float>(s.frame.observer());
    const int terms = physics::harmonicCount(degree);
    base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(air.profile, air.optics, 2);
        Fold fold(degree, s.grid.points());
        Lanes sums;
        for (std::size_t v = static_cast<std::size_t>(thread); v < views.size(); v += static_cast<std::size_t>(threads)) {
            const ViewRay& view = views[v];
            const auto ray = tracer.trace(view.altitude, view.mu, air.settings.viewNodes, view.hitsGround);
            const Lanes coefficients = air.coefficientsOf(ray);
            const int nodes = static_cast<int>(ray.nodes.size());
            const auto distanceOf = [&](const physics::RayNodes::Node& n) {
                return static_cast<float>(view.groundDistance +
                                          groundDistance(air.profile.planet().radius, n.sunScale, n.nuScale, view.mu));
            };
            for (int g = 0; g < air.groups; ++g) {
                sums.assign(azimuths.size(), Lane{});
                for (int k = 0; k < nodes; ++k) {
                    const auto& node = ray.nodes[static_cast<std::size_t>(k)];
                    const float distance = distanceOf(node);
                    const Place place = air.levels.place(node.altitude, 0);
                    fold.begin(s.momentsAt(s.total, g, place.level), s.momentsAt(s.total, g, place.level + 1), place.share,
                               &coefficients[static_cast<std::size_t>((g * nodes + k) * terms)]);
                    for (int a = 0; a < count; ++a) {
                        const auto i = static_cast<std::size_t>(a);
                        const Corners corners(s.grid, distance * std::cos(turned[i]), observer + distance * std::sin(turned[i]));
                        for (int c = 0; c < 16; ++c)
                            fold.add(corners.point[c], corners.weight[c], corners.mirrored[c], &cosines[i * (static_cast<std::size_t>(degree) + 1)],
                                     &sines[i * (static_cast<std::size_t>(degree) + 1)], sums[i]);
                    }
                }
                for (int a = 0; a < count; ++a)
                    store(sums[static_cast<std::size_t>(a)], v, a, g, result.eclipsed, result.uneclipsed);
                if (!view.hitsGround)
                    continue;
                const float distance = distanceOf(ray.ground);
                for (int a = 0; a < count; ++a) {
                    const auto i = static_cast<std::size_t>(a);
                    const Corners corners(s.grid, distance * std::cos(turned[i]), observer + distance * std::sin(turned[i]));
                    Lane sum{};
                    for (int c = 0; c < 16; ++c)
                        sum += corners.weight[c] * s.total.irradiance[static_cast<std::size_t>(g) * s.points() + static_cast<std::size_t>(corners.point[c])];
                    store(sum, v, a, g, result.groundEclipsed, result.groundUneclipsed);
                }
            }
        }
    });
    return result;
}

} // namespace sky::eclipse
