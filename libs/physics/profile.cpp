#include "physics/profile.hpp"
#include "base/lanes.hpp"
#include "physics/optics.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

/// Densities below this share of a species' greatest column are followed only loosely.
constexpr double negligibleShare = 1e-7;

/// The densities of a species on the nodes of a medium, and chords between them.
struct Curve {
    const std::vector<double>& altitudes;
    const std::vector<double>& densities;
    double negligible; ///< m^-3

    /// Whether a chord from one node to another follows the density as far as `tolerance`. It must not bridge a jump's foot: equality at every
    /// node in between is enough.
    ///   logarithmic  straight is the logarithm, not the density
    bool followedBy(size_t a, size_t b, bool logarithmic, double tolerance) const
    {
        const double from = densities[a], to = densities[b], length = altitudes[b] - altitudes[a];
        for (size_t k = a + 1; k < b; ++k) {
            const double x = (altitudes[k] - altitudes[a]) / length;
            const double fit = logarithmic ? from * std::pow(to / from, x) : from + x * (to - from);
            if (std::abs(fit - densities[k]) > tolerance * densities[k] + negligible)
                return false;
        }
        return true;
    }
    /// Neighbours are joined as the medium has it. Farther apart, where the logarithm is not straight the density itself may be: where it goes to
    /// zero, chords of the logarithm would go on for hundreds of shells.
    bool logarithmic(size_t a, size_t b, double tolerance) const
    {
        return densities[a] > 0 && densities[b] > 0 && followedBy(a, b, true, tolerance);
    }
    bool followed(size_t a, size_t b, double tolerance) const { return logarithmic(a, b, tolerance) || followedBy(a, b, false, tolerance); }
};

/// Densities `dh` above a shell: of all species at once, for that is where the time of a ray goes.
SKY_WIDEST_VECTORS
void densitiesAlong(const double* __restrict start, const double* __restrict slope, const double* __restrict logarithmic, int species,
                    double dh, double* __restrict values)
{
    for (int s = 0; s < species; ++s) {
        const double x = start[s] + slope[s] * dh;
        values[s] = logarithmic[s] > 0 ? base::expLane(x) : x > 0 ? x : 0;
    }
}

} // namespace

Profile::Profile(const Medium& medium, const double tolerance)
    : planet_{medium.planetRadius, medium.topOfAtmosphere}, species_(static_cast<int>(medium.species.size()))
{
    const auto& h = medium.altitudes;
    std::vector<Curve> curves;
    for (const auto& species : medium.species)
        curves.push_back({h, species.numberDensity, negligibleShare * verticalColumn(medium, species) / planet_.topOfAtmosphere});
    const auto followed = [&](size_t a, size_t b) {
        return std::all_of(curves.begin(), curves.end(), [&](const Curve& curve) { return curve.followed(a, b, tolerance); });
    };

    shells_.push_back(h.front());
    for (size_t a = 0; a + 1 < h.size();) {
        // Longest chord by doubling, then bisection.
        size_t good = a + 1, step = 1, bad = h.size();
        while (good + step < h.size() && followed(a, good + step)) {
            good += step;
            step *= 2;
        }
        bad = std::min(good + step, h.size());
        while (bad - good > 1) {
            const size_t middle = (good + bad) / 2;
            (middle < h.size() && followed(a, middle) ? good : bad) = middle;
        }
        double steepness = 0;
        for (const Curve& curve : curves) {
            const auto& n = curve.densities;
            const bool logarithmic = curve.logarithmic(a, good, tolerance);
            const double slope = (logarithmic ? std::log(n[good] / n[a]) : n[good] - n[a]) / (h[good] - h[a]);
            segments_.add(logarithmic ? std::log(n[a]) : n[a], slope, logarithmic);
            if (std::max(n[a], n[good]) > 100 * curve.negligible)
                steepness = std::max(steepness, logarithmic ? std::abs(slope) : 1 / (h[good] - h[a]));
        }
        steepness_.push_back(steepness);
        shells_.push_back(h[good]);
        a = good;
    }
}

Profile Profile::withShellsAt(const std::vector<double>& altitudes) const
{
    const double closest = 1e-7 * planet_.topOfAtmosphere; // to a shell that is there
    Profile finer = *this;
    finer.shells_ = {shells_.front()};
    finer.segments_ = {};
    finer.steepness_.clear();
    for (size_t k = 0; k + 1 < shells_.size(); ++k) {
        std::vector<double> ends;
        for (const double h : altitudes)
            if (h > shells_[k] + closest && h < shells_[k + 1] - closest)
                ends.push_back(h);
        std::sort(ends.begin(), ends.end());
        ends.push_back(shells_[k + 1]);
        for (const double end : ends) {
            for (int s = 0; s < species_; ++s) {
                const size_t at = k * species_ + s;
                finer.segments_.add(segments_.start[at] + segments_.slope[at] * (finer.shells_.back() - shells_[k]), segments_.slope[at],
                                    segments_.logarithmic[at]);
            }
            finer.steepness_.push_back(steepness_[k]);
            finer.shells_.push_back(end);
        }
    }
    return finer;
}

int Profile::intervalAt(const double altitude) const
{
    const auto above = std::upper_bound(shells_.begin(), shells_.end(), altitude) - shells_.begin();
    return static_cast<int>(std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(shells_.size()) - 1)) - 1;
}

void Profile::Segments::add(const double atStart, const double along, const double isLogarithmic)
{
    start.push_back(atStart);
    slope.push_back(along);
    logarithmic.push_back(isLogarithmic);
}

void Profile::densities(const int interval, const double altitude, double* const values) const
{
    const size_t first = size_t(interval) * species_;
    densitiesAlong(&segments_.start[first], &segments_.slope[first], &segments_.logarithmic[first], species_, altitude - shells_[interval],
                   values);
}

double depthInShell(const Profile& profile, const std::vector<double>& crossSections, const int interval, const double altitude)
{
    constexpr int points = 8; // shells may be scale heights thick
    const double bottom = profile.shells()[interval], thickness = altitude - bottom;
    std::vector<double> n(crossSections.size());
    double mean = 0;
    for (int q = 0; q < points; ++q) {
        profile.densities(interval, bottom + thickness * (q + 0.5) / points, n.data());
        for (size_t s = 0; s < n.size(); ++s)
            mean += n[s] * crossSections[s] / points;
    }
    return mean * thickness;
}

std::vector<double> depthBelowShells(const Profile& profile, const std::vector<double>& crossSections)
{
    const auto& shells = profile.shells();
    std::vector<double> depth(shells.size(), 0.);
    for (size_t k = 0; k + 1 < shells.size(); ++k)
        depth[k + 1] = depth[k] + depthInShell(profile, crossSections, static_cast<int>(k), shells[k + 1]);
    return depth;
}

double dipOfAir(const Profile& profile, const std::vector<double>& crossSections)
{
    const auto depth = depthBelowShells(profile, crossSections);
    const auto& planet = profile.planet();
    size_t k = 0;
    while (k + 1 < depth.size() && depth.back() - depth[k] > 1e-5 * depth.back())
        ++k;
    return -horizonElevation(planet, std::max(profile.shells()[k], 1e-3 * planet.topOfAtmosphere));
}

} // namespace sky::physics
