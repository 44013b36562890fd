#include "physics/limb.hpp"
#include "base/angles.hpp"
#include "base/not_negative.hpp"
#include "physics/quadrature.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace sky::physics {

LimbDepths::LimbDepths(std::vector<double> elevations, std::vector<double> depths)
    : elevations_(std::move(elevations)), depths_(std::move(depths)), wavelengths_(static_cast<int>(depths_.size() / elevations_.size()))
{
}

void LimbDepths::meanDepth(const double top, const double radius, const bool withSine, double* const result) const
{
    // The elevation is top - 2 radius sin^2(t / 2), which takes the root out of the chord's length: dA ~ sin^2 t dt.
    const auto angleOf = [&](double elevation) { return 2 * std::asin(std::sqrt(std::clamp((top - elevation) / (2 * radius), 0., 1.))); };
    const double lowest = angleOf(0);
    constexpr int leastPanels = 8;
    std::vector<double> edges;
    for (int i = 0; i <= leastPanels; ++i)
        edges.push_back(lowest * i / leastPanels);
    for (const double e : elevations_)
        if (e > top - 2 * radius && e < top)
            edges.push_back(angleOf(e));
    std::sort(edges.begin(), edges.end());

    static const auto rule = gaussLegendre(2);
    std::size_t k = std::clamp<std::size_t>(std::upper_bound(elevations_.begin(), elevations_.end(), top) - elevations_.begin(), 1,
                                            elevations_.size() - 1) -
                    1;
    const auto depthAt = [&](double elevation, int w) {
        const double x = (elevation - elevations_[k]) / (elevations_[k + 1] - elevations_[k]);
        const double* at = &depths_[k * wavelengths_ + w];
        return at[0] + x * (at[wavelengths_] - at[0]);
    };
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = depthAt(top, w); // a sum of exponentials without underflow needs a common offset
    std::vector<double> mean(wavelengths_, 0.);
    double weights = 0;
    for (std::size_t panel = 0; panel + 1 < edges.size(); ++panel)
        for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
            const double half = 0.5 * (edges[panel + 1] - edges[panel]), t = edges[panel] + half * (1 + rule.nodes[q]);
            const double elevation = std::max(0., top - 2 * radius * std::pow(std::sin(0.5 * t), 2));
            while (k > 0 && elevation < elevations_[k])
                --k;
            const double weight = rule.weights[q] * half * std::pow(std::sin(t), 2) * (withSine ? std::sin(elevation) : 1);
            weights += weight;
            for (int w = 0; w < wavelengths_; ++w)
                mean[w] += weight * std::exp(result[w] - depthAt(elevation, w));
        }
    if (weights > 0)
        for (int w = 0; w < wavelengths_; ++w)
            result[w] = base::notNegative(result[w] - std::log(mean[w] / weights));
}

} // namespace sky::physics
