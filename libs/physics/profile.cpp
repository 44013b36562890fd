#include "physics/profile.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

double interpolate(double n0, double n1, double x) { return n0 > 0 && n1 > 0 ? n0 * std::pow(n1 / n0, x) : n0 + x * (n1 - n0); }

/// Densities below this share of a species' greatest column are followed only loosely.
constexpr double negligibleShare = 1e-7;

bool chordFits(const Medium& medium, const std::vector<double>& negligible, size_t a, size_t b, double tolerance)
{
    const auto& h = medium.altitudes;
    // A chord must not bridge a jump's foot: equality at every node in between is enough.
    for (size_t s = 0; s < medium.species.size(); ++s) {
        const auto& n = medium.species[s].numberDensity;
        for (size_t k = a + 1; k < b; ++k) {
            const double fit = interpolate(n[a], n[b], (h[k] - h[a]) / (h[b] - h[a]));
            if (std::abs(fit - n[k]) > tolerance * n[k] + negligible[s])
                return false;
        }
    }
    return true;
}

} // namespace

Profile::Profile(const Medium& medium, const double tolerance)
    : planet_{medium.planetRadius, medium.topOfAtmosphere}, species_(static_cast<int>(medium.species.size()))
{
    const auto& h = medium.altitudes;
    std::vector<double> negligible(species_);
    for (int s = 0; s < species_; ++s) {
        const auto& n = medium.species[s].numberDensity;
        double column = 0;
        for (size_t k = 0; k + 1 < h.size(); ++k)
            column += 0.5 * (n[k] + n[k + 1]) * (h[k + 1] - h[k]);
        negligible[s] = negligibleShare * column / planet_.topOfAtmosphere;
    }

    shells_.push_back(h.front());
    for (size_t a = 0; a + 1 < h.size();) {
        // Longest chord by doubling, then bisection.
        size_t good = a + 1, step = 1, bad = h.size();
        while (good + step < h.size() && chordFits(medium, negligible, a, good + step, tolerance)) {
            good += step;
            step *= 2;
        }
        bad = std::min(good + step, h.size());
        while (bad - good > 1) {
            const size_t middle = (good + bad) / 2;
            (middle < h.size() && chordFits(medium, negligible, a, middle, tolerance) ? good : bad) = middle;
        }
        double steepness = 0;
        for (int s = 0; s < species_; ++s) {
            const auto& n = medium.species[s].numberDensity;
            const bool logarithmic = n[a] > 0 && n[good] > 0;
            const double slope = (logarithmic ? std::log(n[good] / n[a]) : n[good] - n[a]) / (h[good] - h[a]);
            segments_.push_back({logarithmic ? std::log(n[a]) : n[a], slope, logarithmic});
            if (std::max(n[a], n[good]) > 100 * negligible[s])
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
    finer.segments_.clear();
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
                Segment segment = segments_[k * species_ + s];
                segment.start += segment.slope * (finer.shells_.back() - shells_[k]);
                finer.segments_.push_back(segment);
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

void Profile::densities(const int interval, const double altitude, double* const values) const
{
    const double dh = altitude - shells_[interval];
    for (int s = 0; s < species_; ++s) {
        const auto& segment = segments_[interval * species_ + s];
        const double x = segment.start + segment.slope * dh;
        values[s] = segment.logarithmic ? std::exp(x) : std::max(0., x);
    }
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
