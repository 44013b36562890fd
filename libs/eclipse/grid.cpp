#include "eclipse/grid.hpp"
#include "base/angles.hpp"
#include <algorithm>
#include <cmath>

namespace sky::eclipse {

namespace {

using base::pi;

/// How far from the observer the shadow still draws points to itself, m: farther away it is out of the field's sight.
constexpr double sight = 2000e3;

} // namespace

Line::Line(std::vector<float> points, const bool mirrored) : points_(std::move(points)), mirrored_(mirrored)
{
    const int n = count();
    const auto pointAt = [&](int i) { return i < 0 ? -points_[static_cast<std::size_t>(-i)] : points_[static_cast<std::size_t>(i)]; };
    for (int k = 0; k + 1 < n; ++k) {
        const bool before = k > 0 || mirrored_, after = k + 2 < n;
        Interval v{{before ? k - 1 : 0, k, k + 1, after ? k + 2 : k + 1}, pointAt(k), 0, {}};
        const float gap = pointAt(k + 1) - pointAt(k);
        v.inverseGap = 1 / gap;
        // The parabola's slope in the middle of two intervals a, b: (a/b (next - this) + b/a (this - last)) / (a + b).
        const auto slope = [&](float* weights, float a, float b) {
            const float scale = gap / (a + b);
            weights[0] -= scale * b / a;
            weights[1] += scale * (b / a - a / b);
            weights[2] += scale * a / b;
        };
        if (before)
            slope(v.slopes[0], pointAt(k) - pointAt(k - 1), gap);
        else {
            v.slopes[0][1] = -1;
            v.slopes[0][2] = 1;
        }
        if (after)
            slope(v.slopes[1] + 1, gap, pointAt(k + 2) - pointAt(k + 1));
        else {
            v.slopes[1][1] = -1;
            v.slopes[1][2] = 1;
        }
        intervals_.push_back(v);
    }
}

Neighbours Line::at(const float position) const
{
    const float x = mirrored_ ? std::abs(position) : position;
    const auto above = std::upper_bound(points_.begin(), points_.end(), x) - points_.begin();
    const auto& v = intervals_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, count() - 1)) - 1];
    const float t = std::clamp((x - v.start) * v.inverseGap, 0.f, 1.f), u = 1 - t;
    const float h10 = t * u * u, h11 = -t * t * u, h01 = t * t * (3 - 2 * t);
    Neighbours result{{v.index[0], v.index[1], v.index[2], v.index[3]}, {}, mirrored_ && position < 0};
    for (int i = 0; i < 4; ++i)
        result.weight[i] = h10 * v.slopes[0][i] + h11 * v.slopes[1][i];
    result.weight[1] += 1 - h01;
    result.weight[2] += h01;
    return result;
}

Line Line::refined(const int factor) const
{
    std::vector<float> result;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
        for (int k = 0; k < factor; ++k)
            result.push_back(points_[i] + (points_[i + 1] - points_[i]) * static_cast<float>(k) / static_cast<float>(factor));
    result.push_back(points_.back());
    return Line(result, mirrored_);
}

Grid makeGrid(const Frame& frame, const FieldSettings& settings)
{
    // Seen along the ground, a shadow is longer by one over the sine of the Sun's elevation.
    const double shadow = std::clamp(frame.shadow(), -sight, sight), slope = std::max(0.1, frame.shadowSunSine());
    const auto x = clusteredNodes(std::min(0., shadow) - settings.reach, std::max(0., shadow) + settings.reach, {0., shadow},
                                  {settings.core, settings.core / slope}, settings.along);
    const double first = frame.observer() - settings.reach;
    const auto y = clusteredNodes(std::max(0., first), frame.observer() + settings.reach, {0., frame.observer()},
                                  {settings.core, settings.core}, settings.across);
    return {Line({x.begin(), x.end()}), Line({y.begin(), y.end()}, first <= 0)};
}

Turn::Turn(const int count_, const int degree_) : count(count_), degree(degree_)
{
    for (int q = 0; q < count / 4; ++q)
        for (int m = 0; m <= degree; ++m) {
            cosines.push_back(static_cast<float>(std::cos(m * azimuth(q))));
            sines.push_back(static_cast<float>(std::sin(m * azimuth(q))));
        }
}

std::vector<Turn> turnsOf(const FieldSettings& settings, const int degree)
{
    std::vector<Turn> turns{{settings.azimuths, degree}};
    for (int later = degree - 1; later >= settings.leastDegree; --later) // the fewer waves, the fewer azimuths tell them apart
        turns.emplace_back(std::min(settings.azimuths, (2 * later + 4) / 4 * 4), later);
    return turns;
}

double Turn::azimuth(const int index) const { return 2 * pi * (index + 0.5) / count; }

} // namespace sky::eclipse
