#include "montecarlo/phase.hpp"

#include "montecarlo/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sky::montecarlo {
namespace {

constexpr std::size_t guideBins = 4096;
constexpr double linearWithin = 0.01; // the sampled density departs from the true one by about this much at most
constexpr int maxHalvings = 8;

} // namespace

PhaseTable::PhaseTable(const std::vector<double>& angles, const std::vector<double>& values) : angles_(angles), values_(values)
{
    for (const double v : values_)
        logs_.push_back(v > 0 ? std::log(v) : 0);
    for (std::size_t bin = 0; bin < guideBins; ++bin) {
        const double angle = std::numbers::pi * static_cast<double>(bin) / guideBins;
        const auto after = std::upper_bound(angles_.begin() + 1, angles_.end() - 1, angle);
        guide_.push_back(static_cast<std::size_t>(after - angles_.begin()) - 1);
    }

    const auto ring = [this](double angle) { return 2 * std::numbers::pi * std::sin(angle) * value(angle); };
    const Rule gauss = gaussLegendre(8);
    nodes_.push_back(angles_.front());
    // Halve each interval until the density on the sphere is nearly linear in the angle.
    const auto refine = [&](const auto& self, double a, double b, int halvings) -> void {
        const double middle = 0.5 * (a + b), straight = 0.5 * (ring(a) + ring(b));
        if (halvings < maxHalvings && std::abs(ring(middle) - straight) > linearWithin * ring(middle)) {
            self(self, a, middle, halvings + 1);
            self(self, middle, b, halvings + 1);
            return;
        }
        nodes_.push_back(b);
        for (std::size_t k = 0; k < gauss.node.size(); ++k)
            integral_ += 0.5 * (b - a) * gauss.weight[k] * ring(middle + 0.5 * (b - a) * gauss.node[k]);
    };
    for (std::size_t i = 0; i + 1 < angles_.size(); ++i)
        refine(refine, angles_[i], angles_[i + 1], 0);

    cumulative_.push_back(0);
    for (const double node : nodes_)
        density_.push_back(std::max(0.0, ring(node)));
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
        cumulative_.push_back(cumulative_.back() + 0.5 * (density_[i] + density_[i + 1]) * (nodes_[i + 1] - nodes_[i]));
}

std::size_t PhaseTable::intervalOf(double angle) const
{
    const double bins = static_cast<double>(guideBins);
    const auto bin = static_cast<std::size_t>(std::clamp(angle / std::numbers::pi * bins, 0.0, bins - 1));
    std::size_t i = guide_[bin];
    if (angle < angles_[i + 1] || i + 2 >= angles_.size())
        return i;
    const std::size_t last = bin + 1 < guideBins ? guide_[bin + 1] + 1 : angles_.size() - 1;
    const auto after =
        std::upper_bound(angles_.begin() + static_cast<std::ptrdiff_t>(i) + 1, angles_.begin() + static_cast<std::ptrdiff_t>(last), angle);
    i = static_cast<std::size_t>(after - angles_.begin()) - 1;
    return std::min(i, angles_.size() - 2);
}

double PhaseTable::value(double angle) const
{
    const std::size_t i = intervalOf(angle);
    const double t = std::clamp((angle - angles_[i]) / (angles_[i + 1] - angles_[i]), 0.0, 1.0);
    if (values_[i] > 0 && values_[i + 1] > 0)
        return std::exp(logs_[i] + t * (logs_[i + 1] - logs_[i]));
    return values_[i] + t * (values_[i + 1] - values_[i]);
}

PhaseTable::Sample PhaseTable::sample(double u) const
{
    const double total = cumulative_.back(), target = u * total;
    const auto after = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, target);
    const auto i = static_cast<std::size_t>(after - cumulative_.begin()) - 1;
    // Invert q0 d + (q1 - q0) d^2 / (2 width) = rest by the form of the root that does not cancel.
    const double width = nodes_[i + 1] - nodes_[i], q0 = density_[i], q1 = density_[i + 1];
    const double rest = target - cumulative_[i];
    const double root = std::sqrt(std::max(0.0, q0 * q0 + 2 * (q1 - q0) / width * rest));
    const double d = q0 + root > 0 ? std::clamp(2 * rest / (q0 + root), 0.0, width) : 0.5 * width;
    const double density = q0 + (q1 - q0) * d / width, angle = nodes_[i] + d;
    if (!(density > 0))
        return {angle, 0};
    return {angle, 2 * std::numbers::pi * std::sin(angle) * value(angle) / density * (total / integral_)};
}

} // namespace sky::montecarlo
