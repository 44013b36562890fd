#include "physics/sun_altitudes.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

/// Between two altitudes of the table that need no other between them: the vertical optical depth, and how far it may be from a
/// straight line in the middle (a low Sun's optical depth is some five times as large while its light still counts). Then the most
/// cells that an interval is divided into.
constexpr double rowOpticalDepth = 0.1, rowCurvature = 1e-3;
constexpr int mostParts = 16;

/// Vertical optical depth, at the clearest wavelength, under which altitudes are no closer: 1e-9 of sunlight gets there from the zenith.
constexpr double dark = 20;

/// Smallest and largest optical depth of the air between two altitudes, of all wavelengths.
std::pair<double, double> opticalDepthBetween(const Profile& profile, const Optics& optics, double from, double to)
{
    constexpr int points = 4;
    std::vector<double> n(optics.species), beta(optics.wavelengths, 0.);
    for (int q = 0; q < points; ++q) {
        const double h = from + (to - from) * (q + 0.5) / points;
        profile.densities(profile.intervalAt(h), h, n.data());
        for (int s = 0; s < optics.species; ++s)
            for (int w = 0; w < optics.wavelengths; ++w)
                beta[w] += n[s] * optics.extinction[s * optics.wavelengths + w] / points;
    }
    const auto [least, most] = std::minmax_element(beta.begin(), beta.end());
    return {*least * (to - from), *most * (to - from)};
}

/// Altitudes between `low` and a jump of density, or the end of the air, above it, downwards: halves the way to the jump until a horizontal ray
/// from there meets little on its way out, since its optical depth goes with the root of that way.
std::vector<double> altitudesUnderJump(const Profile& profile, const Optics& optics, double low, double jump)
{
    constexpr double little = 0.3;
    constexpr int most = 16;
    const double way = jump - low, chord = std::sqrt(way * (2 * (profile.planet().radius + low) + way));
    const double grazing = opticalDepthBetween(profile, optics, low, jump).second * chord / way;
    const int count = grazing > little ? std::min(most, static_cast<int>(2 * std::log2(grazing / little)) + 1) : 0;
    std::vector<double> result;
    for (int i = count; i > 0; --i)
        result.push_back(jump - way * std::ldexp(1., -i));
    return result;
}

} // namespace

std::vector<double> sunAltitudes(const Profile& profile, const Optics& optics, int count)
{
    const auto& p = profile.planet();
    const double narrow = Profile::atOnce * p.topOfAtmosphere;
    std::vector<double> all = altitudeNodes(p, count), jumps{p.topOfAtmosphere};
    const auto& shells = profile.shells();
    for (size_t k = 0; k + 1 < shells.size(); ++k)
        if (shells[k + 1] - shells[k] < narrow) {
            all.push_back(shells[k]);
            jumps.push_back(shells[k]);
            while (k + 1 < shells.size() && shells[k + 1] - shells[k] < narrow) // where a density goes to zero there may be hundreds
                ++k;
            all.push_back(shells[k]);
        }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::vector<double> levels{all.back()};
    double overhead = 0; // vertical optical depth
    for (size_t k = all.size() - 1; k-- > 0;) {
        const double x0 = horizonDistance(p, all[k]), x1 = horizonDistance(p, all[k + 1]), middle = altitudeOfHorizon(p, 0.5 * (x0 + x1));
        const auto [leastBelow, below] = opticalDepthBetween(profile, optics, all[k], middle);
        const auto [leastAbove, above] = opticalDepthBetween(profile, optics, middle, all[k + 1]);
        const double wanted = std::max((below + above) / rowOpticalDepth, std::sqrt(0.5 * std::abs(below - above) / rowCurvature));
        const int parts = overhead > dark ? 1 : std::clamp(static_cast<int>(std::min(wanted, 1e3)) + 1, 1, mostParts);
        if (overhead <= dark && std::find(jumps.begin(), jumps.end(), all[k + 1]) != jumps.end()) {
            const auto under = altitudesUnderJump(profile, optics, altitudeOfHorizon(p, x1 - (x1 - x0) / parts), all[k + 1]);
            levels.insert(levels.end(), under.begin(), under.end());
        }
        for (int i = parts - 1; i > 0; --i)
            levels.push_back(altitudeOfHorizon(p, x0 + (x1 - x0) * i / parts));
        levels.push_back(all[k]);
        overhead += leastBelow + leastAbove;
    }
    std::reverse(levels.begin(), levels.end());
    return levels;
}

} // namespace sky::physics
