#pragma once
// Gauss-Legendre rules, computed here because the judge shares no formula with the judged.

#include <cmath>
#include <numbers>
#include <vector>

namespace sky::montecarlo {

struct Rule {
    std::vector<double> node;   ///< in (-1, 1)
    std::vector<double> weight; ///< sum 2
};

/// Gauss-Legendre rule with n nodes: Newton's iteration on P_n from Tricomi's estimate of its zeros.
inline Rule gaussLegendre(int n)
{
    Rule rule{std::vector<double>(n), std::vector<double>(n)};
    for (int i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
        for (int iteration = 0; iteration < 12; ++iteration) {
            double p = 1, previous = 0;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
                previous = p;
                p = next;
            }
            slope = n * (x * p - previous) / (x * x - 1);
            x -= p / slope;
        }
        rule.node[i] = x;
        rule.weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
    return rule;
}

} // namespace sky::montecarlo
