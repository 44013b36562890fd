#include "physics/levels.hpp"
#include "base/angles.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

/// Optical depth between two levels above which another one is put between them.
constexpr double levelOpticalDepth = 0.3;
/// So many times more of them in an interval with an edge.
constexpr double edgeCrowding = 1.25;
/// The same along a grazing ray, of what is not exponential in altitude: a thin layer high up is thick for a setting Sun. No light grazes
/// through more than the thickest.
constexpr double levelUnevenDepth = 0.4, thickest = 1.6;
/// Optical depth from an edge within which the field bends most; beyond it is that of light that diffuses.
constexpr double edgeDepth = 2;
/// Levels that may be there for each of those evenly spread.
constexpr int mostForEach = 8;
/// Closer levels are one.
constexpr double sameLevel = 1e-6;
/// A change of extinction over such a distance is a jump if it is more than this share of what is there,
constexpr double jumpShare = 0.25;
/// and if extended over the whole atmosphere it had more than this optical depth.
constexpr double jumpDepth = 0.02;

double bendingWithin(const double depth) { return depth < edgeDepth ? depth : edgeDepth * (1 + std::log(depth / edgeDepth)); }

/// The extinction that levels follow.
class Extinction
{
public:
    Extinction(const Profile& profile, const std::vector<double>& crossSections)
        : profile_(profile), crossSections_(crossSections), below_(depthBelowShells(profile, crossSections)), n_(profile.speciesCount())
    {
    }
    double at(int interval, double altitude) const
    {
        profile_.densities(interval, altitude, n_.data());
        double beta = 0;
        for (std::size_t s = 0; s < n_.size(); ++s)
            beta += n_[s] * crossSections_[s];
        return beta;
    }
    double at(double altitude) const { return at(profile_.intervalAt(altitude), altitude); }
    double depthBelow(double altitude) const
    {
        const int k = profile_.intervalAt(altitude);
        return below_[k] + depthInShell(profile_, crossSections_, k, profile_.shells()[k], altitude);
    }
    double depth() const { return below_.back(); }

    /// Optical depth of a grazing ray between two levels, as far as extinction there is not exponential: what a level between them would see.
    double unevenDepth(double low, double high) const
    {
        const double a = at(low), b = at(high);
        double most = 0;
        for (int q = 1; q < 8; ++q) {
            const double x = q / 8., even = a > 0 && b > 0 ? a * std::pow(b / a, x) : a + (b - a) * x;
            most = std::max(most, std::abs(at(low + (high - low) * x) - even));
        }
        const double far = horizonDistance(profile_.planet(), high), near = horizonDistance(profile_.planet(), low);
        return most * std::sqrt((far - near) * (far + near));
    }

private:
    const Profile& profile_;
    const std::vector<double>& crossSections_;
    std::vector<double> below_; // [shell]
    mutable std::vector<double> n_;
};

/// Altitudes where extinction changes at once, increasing: the top too, where air ends there at once.
std::vector<double> jumpsOf(const Profile& profile, const Extinction& extinction)
{
    const auto& shells = profile.shells();
    const double top = profile.planet().topOfAtmosphere;
    std::vector<double> jumps;
    for (int k = 1, next = 2; next < static_cast<int>(shells.size()); k = next++) {
        const double below = extinction.at(k - 1, shells[k]), above = extinction.at(k, shells[k]);
        if (std::abs(above - below) * top > jumpDepth * std::max(1., extinction.depth()))
            jumps.push_back(shells[k]);
        if (!(shells[next] - shells[k] < Profile::atOnce * top))
            continue;
        while (next + 1 < static_cast<int>(shells.size()) && shells[next + 1] - shells[k] < Profile::atOnce * top)
            ++next;
        const double beyond = extinction.at(next - 1, shells[next]), change = std::abs(beyond - above);
        if (change > jumpShare * std::max(above, beyond) && change * top > jumpDepth)
            jumps.push_back(0.5 * (shells[k] + shells[next]));
    }
    if (extinction.at(static_cast<int>(shells.size()) - 2, top) * top > jumpDepth * std::max(1., extinction.depth()))
        jumps.push_back(top);
    return jumps;
}

/// Where levels go between the evenly spread ones and the jumps.
class LevelPlacer
{
public:
    LevelPlacer(const Profile& profile, const Extinction& extinction, int count)
        : extinction_(extinction), top_(profile.planet().topOfAtmosphere), jumps_(jumpsOf(profile, extinction)), bending_(edgeDepths()),
          given_(altitudeNodes(profile.planet(), count))
    {
        given_.insert(given_.end(), jumps_.begin(), jumps_.end());
        std::sort(given_.begin(), given_.end());
    }

    /// \param density  1: as many as there shall be; less: as many fewer
    std::vector<double> place(double density) const
    {
        std::vector<double> levels{0};
        for (const double level : given_) {
            const double last = levels.back();
            if (level - last < sameLevel * top_)
                continue;
            // The field bends within a small optical depth of an edge, the ground among them, so levels crowd there, as the cosines of even
            // angles do.
            const bool edgeBelow = last == 0 || isJump(last), edgeAbove = isJump(level), edge = edgeBelow || edgeAbove;
            const double wanted = density * (edge ? edgeCrowding : 1) * bendingBetween(last, level) / levelOpticalDepth;
            const int forDepth = static_cast<int>(wanted);
            const int forShape =
                edge ? 0 : static_cast<int>(std::sqrt(std::min(extinction_.unevenDepth(last, level), thickest) / levelUnevenDepth));
            const int extra = std::max(forDepth, forShape);
            for (int i = 1; i <= extra; ++i) {
                const double even = static_cast<double>(i) / (extra + 1);
                const double share = edgeBelow && edgeAbove ? 0.5 - 0.5 * std::cos(pi * even)
                                     : edgeBelow            ? 1 - std::cos(0.5 * pi * even)
                                     : edgeAbove            ? std::sin(0.5 * pi * even)
                                                            : even;
                levels.push_back(forDepth > forShape ? bent(last, level, share) : last + (level - last) * share);
            }
            levels.push_back(level);
        }
        levels.back() = top_;
        return levels;
    }

private:
    bool isJump(double level) const { return std::binary_search(jumps_.begin(), jumps_.end(), level); }
    std::vector<double> edgeDepths() const
    {
        std::vector<double> edges{0};
        for (const double jump : jumps_)
            if (jump < top_)
                edges.push_back(extinction_.depthBelow(jump));
        edges.push_back(extinction_.depth());
        return edges;
    }
    double bendingBetween(double low, double high) const
    {
        return bending_(extinction_.depthBelow(high)) - bending_(extinction_.depthBelow(low));
    }
    /// Altitude between two up to which the field bends by a share of what it does between them.
    double bent(double low, double high, double share) const
    {
        const double from = bending_(extinction_.depthBelow(low)), wanted = from + share * bendingBetween(low, high);
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (low + high);
            (bending_(extinction_.depthBelow(middle)) < wanted ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    const Extinction& extinction_;
    const double top_;
    const std::vector<double> jumps_;
    const BendingDepth bending_;
    std::vector<double> given_;
};

} // namespace

BendingDepth::BendingDepth(std::vector<double> edges) : edges_(std::move(edges)), bending_{0}
{
    for (std::size_t i = 1; i < edges_.size(); ++i)
        bending_.push_back(bending_.back() + 2 * bendingWithin(0.5 * (edges_[i] - edges_[i - 1])));
}

double BendingDepth::operator()(const double depth) const
{
    const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, depth) - edges_.begin();
    const double fromBelow = std::max(0., depth - edges_[above - 1]), fromAbove = std::max(0., edges_[above] - depth);
    return fromBelow < fromAbove ? bending_[above - 1] + bendingWithin(fromBelow) : bending_[above] - bendingWithin(fromAbove);
}

std::vector<double> fieldLevels(const Profile& profile, const std::vector<double>& largestExtinction, const int count)
{
    const Extinction extinction(profile, largestExtinction);
    const LevelPlacer placer(profile, extinction, count);
    auto levels = placer.place(1);
    const auto most = static_cast<std::size_t>(mostForEach * count);
    if (levels.size() > most) {
        const std::size_t least = placer.place(0).size();
        levels = placer.place(least < most ? double(most - least) / double(levels.size() - least) : 0);
    }
    return levels;
}

} // namespace sky::physics
