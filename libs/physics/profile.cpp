#include "physics/profile.hpp"
#include "base/lanes.hpp"
#include "physics/optics.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace sky::physics {

namespace {

/// Densities below this share of a species' greatest column are followed only loosely.
constexpr double negligibleShare = 1e-7;

/// The densities of a species on the nodes of a medium, and chords between them.
struct Curve {
    const std::vector<double>& altitudes;
    const std::vector<double>& densities;
    double negligible; ///< m^-3

    /// Whether a chord from one node to another follows the density as far as `tolerance`. It must not bridge a jump's foot: equality at
    /// every node in between is enough.
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
    /// Neighbours are joined as the medium has it. Farther apart, where the logarithm is not straight the density itself may be: where it
    /// goes to zero, chords of the logarithm would go on for hundreds of shells.
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
    halvings_.assign(steepness_.size(), 0.);
    findUpperEdges(medium);
}

void Profile::findUpperEdges(const Medium& medium)
{
    constexpr double left = 0.5;   // air ends where at most this share of its extinction is left
    constexpr double little = 0.3; // optical depth
    constexpr int least = 3, most = 20;
    std::vector<double> largest;
    for (const Species& species : medium.species)
        largest.push_back(*std::max_element(species.extinctionCrossSection.begin(), species.extinctionCrossSection.end()));
    std::vector<double> n(species_);
    const auto extinctionAt = [&](int interval, double altitude) {
        densities(interval, altitude, n.data());
        return std::inner_product(n.begin(), n.end(), largest.begin(), 0.);
    };
    for (int end = static_cast<int>(shells_.size()) - 1; end > 0; --end) {
        const double edge = shells_[end], above = end + 1 < static_cast<int>(shells_.size()) ? extinctionAt(end, edge) : 0;
        int k = end - 1; // the first interval below that is not narrow
        while (k > 0 && shells_[k + 1] - shells_[k] < atOnce * planet_.topOfAtmosphere)
            --k;
        const double atEnd = extinctionAt(k, shells_[k + 1]), below = atEnd > 0 ? atEnd : extinctionAt(k, shells_[k]);
        if (!(below > 0 && above <= left * below))
            continue;
        end = k + 1;
        const auto depthUnder = [&](double way) {
            double depth = 0;
            for (int i = intervalAt(edge - way); i < static_cast<int>(shells_.size()) - 1 && shells_[i] < edge; ++i)
                depth += depthInShell(*this, largest, i, std::max(edge - way, shells_[i]), shells_[i + 1]);
            return depth;
        };
        // The lowest Sun that lights what is below shines along the horizontal, or from the upper limb of a disc.
        const auto slantDepth = [&](double way) {
            const double slant = std::sqrt(2 * (planet_.radius + edge) / way + 1);
            return depthUnder(way) * (medium.sunAngularRadius > 0 ? std::min(slant, 1 / medium.sunAngularRadius) : slant);
        };
        double way = edge;
        while (depthUnder(way) > 1)
            way /= 2;
        int halvings = 0;
        while (halvings < most && slantDepth(std::ldexp(way, -halvings)) > little)
            ++halvings;
        if (halvings >= least)
            edges_.push_back({edge, way, halvings});
    }
    std::reverse(edges_.begin(), edges_.end());
}

int Profile::forShadows(const int usual, const double sunRadius) const
{
    constexpr double blurred = 20; // diameters of the Sun in the dip for which the usual nodes are enough: an edge 100 km above the Earth
    constexpr double most = 3;
    double highest = 0;
    for (const UpperEdge& edge : edges_)
        if (edge.altitude < (1 - atOnce) * planet_.topOfAtmosphere)
            highest = std::max(highest, edge.altitude);
    const double detail = -horizonElevation(planet_, highest) / std::max(2 * blurred * sunRadius, 1e-30);
    return static_cast<int>(std::lround(usual * std::clamp(detail, 1., most)));
}

Profile Profile::withShellsUnderEdges() const
{
    std::vector<double> altitudes;
    for (const UpperEdge& edge : edges_)
        for (int i = 0; i <= edge.halvings; ++i)
            altitudes.push_back(edge.altitude - std::ldexp(edge.way, -i));
    Profile finer = withShellsAt(altitudes, 1e-12);
    size_t k = 0;
    for (const UpperEdge& edge : edges_) {
        const double skin = std::ldexp(edge.way, -edge.halvings);
        for (; k + 1 < finer.shells_.size() && finer.shells_[k + 1] <= edge.altitude; ++k) {
            const double far = edge.altitude - finer.shells_[k], near = edge.altitude - finer.shells_[k + 1];
            if (far <= edge.way * (1 + 1e-6))
                finer.halvings_[k] = std::log2(std::max(far, 0.5 * skin) / std::max(near, 0.5 * skin));
        }
    }
    return finer;
}

Profile Profile::withShellsAt(const std::vector<double>& altitudes, const double closestShare) const
{
    const double closest = closestShare * planet_.topOfAtmosphere;
    Profile finer = *this;
    finer.shells_ = {shells_.front()};
    finer.segments_ = {};
    finer.steepness_.clear();
    finer.halvings_.clear();
    for (size_t k = 0; k + 1 < shells_.size(); ++k) {
        std::vector<double> ends;
        for (const double h : altitudes)
            if (h > shells_[k] + closest && h < shells_[k + 1] - closest)
                ends.push_back(h);
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        ends.push_back(shells_[k + 1]);
        for (const double end : ends) {
            for (int s = 0; s < species_; ++s) {
                const size_t at = k * species_ + s;
                finer.segments_.add(segments_.start[at] + segments_.slope[at] * (finer.shells_.back() - shells_[k]), segments_.slope[at],
                                    segments_.logarithmic[at]);
            }
            finer.steepness_.push_back(steepness_[k]);
            finer.halvings_.push_back(0);
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
    const size_t first = size_t(interval) * species_; // without species there is no element to refer to
    densitiesAlong(segments_.start.data() + first, segments_.slope.data() + first, segments_.logarithmic.data() + first, species_,
                   altitude - shells_[interval], values);
}

double depthInShell(const Profile& profile, const std::vector<double>& crossSections, const int interval, const double bottom,
                    const double altitude)
{
    constexpr double even = 1e-4; // logarithm of a ratio, below which an exponential is straight to 1e-9
    const size_t species = crossSections.size();
    std::vector<double> low(species), high(species);
    profile.densities(interval, bottom, low.data());
    profile.densities(interval, altitude, high.data());
    double mean = 0; // shells may be many scale heights thick
    for (size_t s = 0; s < species; ++s) {
        const bool logarithmic = profile.logarithmic(interval, static_cast<int>(s)) && low[s] > 0 && high[s] > 0;
        const double ratio = logarithmic ? std::log(high[s] / low[s]) : 0;
        mean += crossSections[s] * (std::abs(ratio) > even ? (high[s] - low[s]) / ratio : 0.5 * (low[s] + high[s]));
    }
    return mean * (altitude - bottom);
}

std::vector<double> depthBelowShells(const Profile& profile, const std::vector<double>& crossSections)
{
    const auto& shells = profile.shells();
    std::vector<double> depth(shells.size(), 0.);
    for (size_t k = 0; k + 1 < shells.size(); ++k)
        depth[k + 1] = depth[k] + depthInShell(profile, crossSections, static_cast<int>(k), shells[k], shells[k + 1]);
    return depth;
}

namespace {

/// The shell above which less than a hundred-thousandth of the optical depth is left.
size_t upperEnd(const std::vector<double>& depthBelow)
{
    size_t k = 0;
    while (k + 1 < depthBelow.size() && depthBelow.back() - depthBelow[k] > 1e-5 * depthBelow.back())
        ++k;
    return k;
}

/// Altitude above which there is an optical depth of 1, m; 0 where there is less.
double opaqueAltitude(const Profile& profile, const std::vector<double>& crossSections, const std::vector<double>& depthBelow)
{
    constexpr double opaque = 1;
    const double below = depthBelow.back() - opaque;
    if (!(below > 0))
        return 0;
    const auto k = std::upper_bound(depthBelow.begin(), depthBelow.end() - 1, below) - depthBelow.begin() - 1;
    double low = profile.shells()[k], high = profile.shells()[k + 1];
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const double depth = depthBelow[k] + depthInShell(profile, crossSections, static_cast<int>(k), profile.shells()[k], middle);
        (depth < below ? low : high) = middle;
    }
    return low;
}

} // namespace

double dipOfAir(const Profile& profile, const std::vector<double>& crossSections)
{
    const auto& planet = profile.planet();
    const double end = profile.shells()[upperEnd(depthBelowShells(profile, crossSections))];
    return -horizonElevation(planet, std::max(end, 1e-3 * planet.topOfAtmosphere));
}

double sunsetShare(const Profile& profile, const std::vector<double>& crossSections, const double sunRadius)
{
    constexpr double usual = 0.15; // rad
    const auto depth = depthBelowShells(profile, crossSections);
    const double top = profile.planet().topOfAtmosphere, ground = opaqueAltitude(profile, crossSections, depth);
    const double height = std::max(profile.shells()[upperEnd(depth)] - ground, 1e-3 * top);
    const double dip = -horizonElevation({profile.planet().radius + ground, top - ground}, height);
    return std::min(1., (dip + 2 * sunRadius) / usual);
}

} // namespace sky::physics
