#pragma once
// Straight lines between the nodes of tables: values for which they are right in the mean, and values on them.

#include <cstddef>
#include <vector>

namespace sky::physics {

/// Positions of nodes that are evenly spread: 0, 1, .. points - 1.
std::vector<double> evenly(std::size_t points);

/// Shifts the values of a table between which straight lines are drawn so that the lines are right in the mean: by -h^2 f'' / 12, where a line through
/// f itself errs by h^2 f'' / 12 (its projection onto piecewise linear functions, to second order). Optical depth bends one way nearly everywhere,
/// and light that comes from everywhere would lack what the chords have too much. Next to a bend that is no curve nothing is shifted, nor are the ends.
///   positions  [points], not decreasing
///   values     [point][count], >= 0 and kept so, `stride` apart from point to point
void straighten(const std::vector<double>& positions, double* values, std::size_t stride, int count);

/// Fills a table by straight lines between the points that are known.
///   known      indices of points, increasing, at least the first and the last
///   positions  [points], not decreasing
///   values     [point][count], `stride` apart from point to point
void drawLines(const std::vector<std::size_t>& known, const std::vector<double>& positions, double* values, std::size_t stride, int count);

} // namespace sky::physics
