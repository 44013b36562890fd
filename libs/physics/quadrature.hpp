#pragma once
#include <vector>

namespace sky::physics {

/// Nodes and weights of a quadrature rule.
struct Quadrature {
    std::vector<double> nodes;
    std::vector<double> weights;
};

/// Gauss-Legendre rule of `count` points on [a, b]: exact for polynomials up to degree 2 count - 1.
/// Newton iteration on the Legendre recurrence (Press et al., Numerical Recipes 4.6).
Quadrature gaussLegendre(int count, double a = -1, double b = 1);

} // namespace sky::physics
