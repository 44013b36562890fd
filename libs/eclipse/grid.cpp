#include "eclipse/grid.hpp"
#include <algorithm>
#include <cmath>

namespace sky::eclipse {

namespace {

constexpr double pi = 3.14159265358979323846;

Between between(const std::vector<float>& nodes, const float position)
{
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), position) - nodes.begin();
    const auto k = std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(nodes.size()) - 1) - 1;
    const float low = nodes[static_cast<std::size_t>(k)], high = nodes[static_cast<std::size_t>(k) + 1];
    return {static_cast<int>(k), std::clamp((position - low) / (high - low), 0.f, 1.f), false};
}

std::vector<float> finer(const std::vector<float>& nodes, int factor)
{
    std::vector<float> result;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        for (int k = 0; k < factor; ++k)
            result.push_back(nodes[i] + (nodes[i + 1] - nodes[i]) * static_cast<float>(k) / static_cast<float>(factor));
    result.push_back(nodes.back());
    return result;
}

/// How far from the observer the shadow still draws points to itself, m: farther away it is out of the field's sight.
constexpr double sight = 2000e3;

} // namespace

Between Grid::alongAt(const float position) const { return between(x, position); }

Between Grid::acrossAt(const float position) const
{
    Between result = between(y, mirrored ? std::abs(position) : position);
    result.mirrored = mirrored && position < 0;
    return result;
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
    Grid grid;
    grid.x.assign(x.begin(), x.end());
    grid.y.assign(y.begin(), y.end());
    grid.mirrored = first <= 0;
    return grid;
}

Grid refined(const Grid& grid, const int factor) { return {finer(grid.x, factor), finer(grid.y, factor), grid.mirrored}; }

Turn::Turn(const int count_, const int degree_) : count(count_), degree(degree_)
{
    for (int q = 0; q < count / 4; ++q)
        for (int m = 0; m <= degree; ++m) {
            cosines.push_back(static_cast<float>(std::cos(m * azimuth(q))));
            sines.push_back(static_cast<float>(std::sin(m * azimuth(q))));
        }
}

double Turn::azimuth(const int index) const { return 2 * pi * (index + 0.5) / count; }

} // namespace sky::eclipse
