#pragma once
// The points of the field over the ground, and where a shift along a ray's azimuth leads from each of them.

#include "eclipse/frame.hpp"
#include "eclipse/settings.hpp"

namespace sky::eclipse {

/// Linear interpolation between points `index` and `index + 1` of a line.
struct Between {
    int index;
    float share;
    bool mirrored; ///< on the other side of the mirror plane
};

/// A grid of lines along (x) and across (y) the mirror plane. Beyond its ends the value at the end counts.
struct Grid {
    std::vector<float> x, y; ///< m, increasing
    bool mirrored = false;   ///< y begins on the mirror plane: negative y are known from positive ones

    int along() const { return static_cast<int>(x.size()); }
    int across() const { return static_cast<int>(y.size()); }
    int points() const { return along() * across(); }

    Between alongAt(float position) const;
    Between acrossAt(float position) const;
};

/// Points clustered at the observer and at the shadow.
Grid makeGrid(const Frame& frame, const FieldSettings& settings);
/// The same with `factor` intervals for every one.
Grid refined(const Grid& grid, int factor);

/// Midpoints of equal parts of the turn, in quarters: with t_q = (q + 1/2) 2 pi / count, q < count / 4, the azimuths
/// t_q, pi - t_q, pi + t_q, -t_q have indices q, count/2 - 1 - q, count/2 + q, count - 1 - q.
struct Turn {
    int count, degree;
    std::vector<float> cosines, sines; ///< [q][m]: cos(m t_q), sin(m t_q)
    Turn(int count, int degree);
    double azimuth(int index) const;
    int mirror(int index) const { return count - 1 - index; }
};

} // namespace sky::eclipse
