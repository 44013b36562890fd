#include "physics/quadrature.hpp"
#include "base/angles.hpp"
#include <cmath>

namespace sky::physics {

Quadrature gaussLegendre(const int count, const double a, const double b)
{
    using base::pi;
    Quadrature rule{std::vector<double>(count), std::vector<double>(count)};
    const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
    for (int i = 0; i < (count + 1) / 2; ++i) {
        double x = std::cos(pi * (i + 0.75) / (count + 0.5));
        double derivative = 1;
        for (int iteration = 0; iteration < 100; ++iteration) {
            double p = 1, previous = 0;
            for (int k = 0; k < count; ++k) {
                const double next = ((2 * k + 1) * x * p - k * previous) / (k + 1);
                previous = p;
                p = next;
            }
            derivative = count * (x * p - previous) / (x * x - 1);
            const double step = p / derivative;
            x -= step;
            if (std::abs(step) < 1e-15)
                break;
        }
        const double weight = 2 / ((1 - x * x) * derivative * derivative);
        rule.nodes[i] = centre - half * x;
        rule.nodes[count - 1 - i] = centre + half * x;
        rule.weights[i] = rule.weights[count - 1 - i] = half * weight;
    }
    return rule;
}

} // namespace sky::physics
