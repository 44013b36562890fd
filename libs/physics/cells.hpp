#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace sky::physics {

/// How a stretch of a ray is divided into cells: evenly; or, where it is too thick for even cells to resolve the first optical depths,
/// as a sinh from its near end, so that the first cell is as deep as wanted and each of the others some part larger than the last.
/// (Even cells of a cloud with optical depth 1e5 along the ray would put all its light into a fraction of the first.)
class CellDivision
{
public:
    /// \param depth      optical depth of the stretch
    /// \param cellDepth  wanted of the first cell
    CellDivision(double from, double to, int count, double depth, double cellDepth) : from_(from), length_(to - from), count_(count)
    {
        const double excess = std::min(depth / (count * cellDepth), 1e12); // sinh(a) / a
        if (!(excess > 1))
            return;
        stretch_ = std::min(std::sqrt(6 * (excess - 1)), std::log(2 * excess) + 1);
        for (int i = 0; i < 3; ++i)
            stretch_ = std::asinh(excess * stretch_);
        scale_ = 1 / std::sinh(stretch_);
    }
    /// Distance at the far end of cell `index`, 1..count.
    double end(int index) const
    {
        const double x = static_cast<double>(index) / count_;
        return from_ + length_ * (stretch_ > 0 ? scale_ * std::sinh(stretch_ * x) : x);
    }

    int count() const { return count_; }
    /// Length of the last cell in lengths of an even one, about; 0 or less than 1 where all are even or nearly so.
    double growth() const { return stretch_; }

private:
    double from_, length_;
    int count_;
    double stretch_ = 0, scale_ = 0;
};

/// The largest that a cell may be.
struct CellLimits {
    double steepness = 0.5; ///< change of the logarithm of a density
    double length = 0.05;   ///< share of the whole ray
    double depth = 0.5;     ///< optical; attenuation inside cells is exact
};

/// A stretch of a ray between two shells of the profile.
struct Stretch {
    double from, to;  ///< m, along the ray
    double ray;       ///< m, length of the whole ray
    double steepness; ///< change of the logarithm of the density that changes most
    double depth;     ///< optical depth, were all as dense as in the middle
    double near;      ///< optical depth, were all as dense as where the ray enters
};

/// Cells fine enough for density, for the angle turned, and for the first optical depths inside a thick layer.
inline CellDivision divided(const Stretch& stretch, const CellLimits& limits)
{
    constexpr double mostByDepth = 64, mostCells = 256;
    const double depth = stretch.near > mostByDepth * limits.depth ? std::max(stretch.depth, stretch.near) : stretch.depth;
    const double bySteepness = stretch.steepness / limits.steepness;
    const double byLength = (stretch.to - stretch.from) / (stretch.ray * limits.length);
    const double byDepth = std::min(depth / limits.depth, mostByDepth);
    const int cells = static_cast<int>(std::clamp(std::ceil(std::max({bySteepness, byLength, byDepth})), 1., mostCells));
    const CellDivision division(stretch.from, stretch.to, cells, std::max(depth, stretch.near), limits.depth);
    if (!(stretch.near > depth && division.growth() > 1))
        return division;
    // Air that thins out: its far part keeps cells no longer than even ones.
    return {stretch.from, stretch.to, static_cast<int>(std::min(cells * division.growth(), mostCells)), stretch.near, limits.depth};
}

/// What the nodes of a ray shall resolve: sunlight with the edge of the planet's shadow, or the field of scattered light, which is smoother but
/// bends more where it is thick.
enum class NodesFor { Sunlight, Field };

/// What a cell has of a ray, or what the whole ray has.
struct NodeShares {
    double light = 0;    ///< scattered towards the viewer, any unit
    double climb = 0;    ///< change of the distance to the horizon, m
    double way = 0;      ///< length, m
    double dimming = 0;  ///< vertical optical depth, mean of the wavelengths
    double halvings = 0; ///< of the way to upper edges of the air: Profile::halvings
    double depth = 0;    ///< optical depth along the ray, mean of the wavelengths
    double bending = 0;  ///< of the field: `dimming`, as far as it is not too deep in thick air for the field to matter there
    double skins = 0;    ///< of the field: `halvings` in the same way; it has few nodes, and its light is elsewhere too

    void operator+=(const NodeShares& other)
    {
        light += other.light;
        climb += other.climb;
        way += other.way;
        dimming += other.dimming;
        halvings += other.halvings;
        depth += other.depth;
        bending += other.bending;
        skins += other.skins;
    }
};

/// Weighs the cells of a ray, in order, by what the viewer can see of them: the deeper they are in thick air, the less can what they do to
/// light matter; cells that scatter nothing count little, and those hidden behind an optical depth of 46 and more not at all. Returns what
/// the whole ray has then.
inline NodeShares weighedAsSeen(std::vector<NodeShares>& cells)
{
    constexpr double unseen = 1e-20; // share of the light that an even ray would send from there
    constexpr double empty = 0.1;    // what air counts that scatters nothing: the shadow may begin in it,
    constexpr double hidden = 46;    // but not behind such an optical depth
    constexpr double far = 12;       // optical depth behind which bending counts half, and edges that sunlight meets
    constexpr double skin = 1;       // the same of edges for the field
    NodeShares whole, seen;
    for (const NodeShares& cell : cells)
        whole += cell;
    if (!(whole.light > 0))
        return whole;
    const double even = unseen * whole.light / whole.way;
    double passed = 0;
    for (NodeShares& cell : cells) {
        const double counts = cell.light > 0 ? cell.light / (cell.light + even * cell.way) : passed < hidden ? empty : 0;
        cell.climb *= counts;
        cell.way *= counts;
        cell.dimming *= counts;
        const double matters = far * far / (far * far + passed * passed);
        cell.bending = cell.dimming * matters;
        cell.skins = cell.halvings * counts * skin / (skin + passed);
        cell.halvings *= counts * matters;
        passed += cell.depth;
        seen += cell;
    }
    return seen;
}

/// The measure of which nodes stand at equal steps: where the light comes from, altitude, length (the shadow may begin anywhere), and in
/// thick air the vertical optical depth, with which sunlight and field change: they are taken as linear between nodes. Under an edge of the
/// air a low Sun lights a skin, and each halving of the way to the edge counts as much.
class NodeMeasure
{
public:
    NodeMeasure(const NodeShares& whole, NodesFor nodesFor)
    {
        const bool sunlight = nodesFor == NodesFor::Sunlight;
        const double skins = sunlight ? whole.halvings : whole.skins, edges = (sunlight ? 0.5 : 0.4) * skins / (8 + skins);
        const double thick = sunlight ? whole.dimming : whole.bending, depth = (sunlight ? 0.3 : 0.8) * thick / (1 + thick);
        const double others = (1 - edges) * (1 - depth), perDepth = per((1 - edges) * depth, thick);
        per_.light = per(0.3 * others, whole.light);
        per_.climb = per(0.2 * others, whole.climb);
        per_.way = per(0.5 * others, whole.way);
        (sunlight ? per_.dimming : per_.bending) = perDepth;
        (sunlight ? per_.halvings : per_.skins) = per(edges, skins);
    }
    /// Of a cell; the whole ray has 1.
    double of(const NodeShares& cell) const
    {
        return per_.light * cell.light + per_.climb * cell.climb + per_.way * cell.way + per_.dimming * cell.dimming +
               per_.halvings * cell.halvings + per_.bending * cell.bending + per_.skins * cell.skins;
    }

private:
    static double per(double share, double all) { return all > 0 ? share / all : 0; }

    NodeShares per_;
};

/// Places nodes at equal steps of a measure, from the start of the ray to the end of the last cell that counts. Were the last node at the end of
/// a ray whose end is hidden, the field there would be taken for that of an opaque layer wherever the gap before it begins in clear air.
///   bounds     [cells + 1], m, along the ray     shares  [cells], weighed as seen     count  nodes, >= 2
///   measured   [cells + 1], the measure cumulated: scratch memory
///   positions  [count], m, not decreasing: what is found
inline void placeNodes(const std::vector<double>& bounds, const std::vector<NodeShares>& shares, const NodeMeasure& measure,
                       const int count, std::vector<double>& measured, std::vector<double>& positions)
{
    constexpr double uncounted = 1e-6; // share of the whole
    const int cells = static_cast<int>(bounds.size()) - 1;
    positions.assign(count, bounds.front());
    if (cells == 0)
        return;
    measured.assign(1, 0);
    for (int c = 0; c < cells; ++c)
        measured.push_back(measured.back() + measure.of(shares[c]));
    int c = 0;
    for (int k = 1; k < count - 1; ++k) {
        const double target = measured[cells] * k / (count - 1);
        while (c + 1 < cells && measured[c + 1] < target)
            ++c;
        const double step = measured[c + 1] - measured[c], x = step > 0 ? std::clamp((target - measured[c]) / step, 0., 1.) : 0.5;
        positions[k] = std::min(bounds[cells], bounds[c] + x * (bounds[c + 1] - bounds[c]));
    }
    while (c + 1 < cells && measured[c + 1] < (1 - uncounted) * measured[cells])
        ++c;
    positions.back() = measured[cells] > 0 ? bounds[c + 1] : bounds[cells];
}

/// What of a cell lies between a node and the next.
struct CellPart {
    int cell, node;
    float begin, end;     ///< 0..1 of the cell
    float offset, length; ///< where the cell begins after the node, and how long it is, in gaps between the two nodes
};

/// Cuts the cells at the nodes, in order. What lies beyond the last node is a part of the last gap, but further away than that is long.
///   bounds  [cells + 1], m, along the ray     nodes  [2 or more], m, not decreasing, from the first bound on
inline void cutAtNodes(const std::vector<double>& bounds, const std::vector<double>& nodes, std::vector<CellPart>& parts)
{
    const int last = static_cast<int>(nodes.size()) - 2;
    parts.resize(bounds.size() + nodes.size());
    CellPart* part = parts.data();
    const auto perGap = [&](int k) { return nodes[k + 1] > nodes[k] ? 1 / (nodes[k + 1] - nodes[k]) : 0.; };
    int k = 0;
    double gaps = perGap(0);
    for (std::size_t c = 0; c + 1 < bounds.size(); ++c) {
        const double from = bounds[c], length = bounds[c + 1] - from, cells = 1 / length;
        for (float begin = 0; begin < 1;) {
            const float end = k >= last ? 1.f : static_cast<float>(std::clamp((nodes[k + 1] - from) * cells, 0., 1.));
            if (end > begin)
                *part++ = {
                    static_cast<int>(c), k, begin, end, static_cast<float>((from - nodes[k]) * gaps), static_cast<float>(length * gaps)};
            begin = std::max(begin, end);
            if (begin < 1)
                gaps = perGap(++k);
        }
    }
    parts.resize(static_cast<std::size_t>(part - parts.data()));
}

/// How the light of a cell with a given centre (0..1 of the cell) lies along it: linearly. Were all of it put at the centre, nodes that are
/// closer than cells would get light by turns.
template<class T>
struct LightAlong {
    T slope;  ///< 6 (centre - 1/2), but no steeper than -1 or 1: more would be negative at one end
    T excess; ///< by how much the centre is beyond what the slope makes of it
};

/// Light of a cell that comes from a part of it: 1 is that of the cell.
template<class T>
struct LightOfPart {
    T share;
    T far; ///< of that, what counts for the node after the part; the rest is for the one before
};

/// What a part gets of any cell's light: polynomials of the slope and the excess.
template<class Scalar>
class PartLight
{
public:
    explicit PartLight(const CellPart& part)
    {
        const Scalar begin = part.begin, end = part.end, half = Scalar(0.5);
        const Scalar middle = half * (begin + end), square = (begin * begin + begin * end + end * end) / 3; // mean of x^2
        share_ = end - begin;
        tilt_ = share_ * (2 * middle - 1);
        const Scalar offset = part.offset;
        scale_ = part.length;
        far_ = offset * share_ + scale_ * share_ * middle;
        farTilt_ = offset * tilt_ + scale_ * share_ * (2 * square - middle);
    }
    /// \tparam T  Scalar, or a vector of them
    template<class T>
    LightOfPart<T> of(const LightAlong<T>& light) const
    {
        const T share = share_ + tilt_ * light.slope;
        return {share, far_ + farTilt_ * light.slope + scale_ * light.excess * share};
    }

private:
    Scalar share_, tilt_, far_, farTilt_, scale_;
};

} // namespace sky::physics
