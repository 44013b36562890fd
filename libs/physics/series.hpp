#pragma once
#include <algorithm>
#include <vector>

namespace sky::physics {

/// What all later events will add to a value, from the last two: events die out as a geometric series once only their slowest
/// mode is left.
inline double geometricTail(double last, double before)
{
    const double ratio = before > 0 ? std::clamp(last / before, 0., 0.999) : 0.;
    return ratio / (1 - ratio) * last;
}

/// Factors c_1 .. c_n for which sum c_k v_k comes nearest to the whole series v_1 + v_2 + ..., where each term follows from the one
/// before by the same linear operator: reduced rank extrapolation (Smith, Ford & Sidi 1987, SIAM Review 29, 199). It finds the
/// x = sum_{k<n} a_k v_k whose own next iterate, v_1 + sum a_k v_{k+1}, differs least from it, and answers with that iterate.
/// Terms that die out slowly (light inside a cloud) thus take about the square root of their number.
///   products  [n][n]: inner products of the terms, in the measure in which the difference shall be least
std::vector<double> seriesFactors(const std::vector<double>& products, int n);

} // namespace sky::physics
