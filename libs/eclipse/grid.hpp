#pragma once
// The points of the field over the ground, and where a shift along a ray's azimuth leads from each of them.

#include "eclipse/frame.hpp"
#include "eclipse/settings.hpp"

namespace sky::eclipse {

/// Four neighbouring points of a line and their weights; negative indices are those beyond the mirror plane.
struct Neighbours {
    int index[4];
    float weight[4];
    bool mirrored; ///< the place is on the other side of the mirror plane: swap the sides
};

/// Points of a line, increasing, m, with cubic interpolation between them: Hermite's, the slope at a point that of the parabola
/// through it and its neighbours. Beyond the ends the value at the end counts.
class Line
{
public:
    Line() = default;
    /// \param mirrored the line begins at 0, and goes on beyond as its own image
    explicit Line(std::vector<float> points, bool mirrored = false);

    const std::vector<float>& points() const { return points_; }
    int count() const { return static_cast<int>(points_.size()); }
    bool mirrored() const { return mirrored_; }
    Neighbours at(float position) const;
    /// With `factor` intervals for every one.
    Line refined(int factor) const;

private:
    struct Interval {
        int index[4];
        float start, inverseGap;
        float slopes[2][4]; ///< at its two ends, times the gap, of the four neighbours
    };
    std::vector<float> points_;
    std::vector<Interval> intervals_;
    bool mirrored_ = false;
};

/// The points over the ground: lines along the mirror plane (x) and away from it (y).
struct Grid {
    Line x, y;
    int points() const { return x.count() * y.count(); }
};

/// Points clustered at the observer and at the shadow.
Grid makeGrid(const Frame& frame, const FieldSettings& settings);

/// Midpoints of equal parts of the turn, in quarters: with t_q = (q + 1/2) 2 pi / count, q < count / 4, the azimuths
/// t_q, pi - t_q, pi + t_q, -t_q have indices q, count/2 - 1 - q, count/2 + q, count - 1 - q.
struct Turn {
    int count, degree;
    std::vector<float> cosines, sines; ///< [q][m]: cos(m t_q), sin(m t_q)
    Turn(int count, int degree);
    double azimuth(int index) const;
    int mirror(int index) const { return count - 1 - index; }
};

/// [event]: the directions of its light; the last of all later events.
///   degree  of the first
std::vector<Turn> turnsOf(const FieldSettings& settings, int degree);

} // namespace sky::eclipse
