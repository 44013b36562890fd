#include "physics/sun.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/limb.hpp"
#include "physics/peak_sunlight.hpp"
#include "physics/quadrature.hpp"
#include "physics/ray.hpp"
#include "physics/straighten.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace sky::physics {

namespace {

using base::pi;

/// Between two altitudes of the table that need no other between them: the vertical optical depth, and how far it may be from a
/// straight line in the middle (a low Sun's optical depth is some five times as large while its light still counts). Then the most
/// cells that an interval is divided into.
constexpr double rowOpticalDepth = 0.1, rowCurvature = 1e-3;
constexpr int mostParts = 16;

/// Vertical optical depth, at the clearest wavelength, under which altitudes are no closer: 1e-9 of sunlight gets there from the zenith.
constexpr double dark = 20;

/// Optical depth behind which nothing is followed: what is left could not be told from darkness in single precision.
constexpr double opaque = 200;

/// Optical depth of a horizontal ray on its way out behind which there is no sunlight: 1e-20 of it.
constexpr double sunlessDepth = 46;

/// Share of the atmosphere between two altitudes over which a density jumps.
constexpr double atOnce = 1e-5;

/// Scale of the elevation axis for the usual sunset, rad.
constexpr double usualScale = 0.03;

double axisLength(double scale, double range) { return std::asinh(range / scale); }

/// Optical depths from an altitude to space, [wavelength]; less where all have passed `deepest`.
///   columns  scratch memory, [species]
void depthsToSpace(RayTracer& tracer, const Optics& optics, double altitude, double mu, double deepest, std::vector<double>& columns,
                   double* const result)
{
    columns.resize(optics.species);
    tracer.columns(altitude, mu, columns.data(), deepest);
    for (int w = 0; w < optics.wavelengths; ++w) {
        result[w] = 0;
        for (int s = 0; s < optics.species; ++s)
            result[w] += columns[s] * optics.extinction[s * optics.wavelengths + w];
    }
}

/// SunTable::sunlessAltitude. Air below, opaque too, may be clearer than above it: a horizontal ray from there meets the latter more steeply.
double findSunlessAltitude(const Profile& profile, const Optics& optics)
{
    RayTracer tracer(profile, optics, 2);
    std::vector<double> columns, depths(optics.wavelengths);
    const auto isSunless = [&](double altitude) {
        depthsToSpace(tracer, optics, altitude, 0, sunlessDepth, columns, depths.data());
        return std::all_of(depths.begin(), depths.end(), [](double depth) { return depth >= sunlessDepth; });
    };
    const auto& shells = profile.shells();
    const auto lit = std::find_if_not(shells.begin(), shells.end(), isSunless);
    if (lit == shells.begin() || lit == shells.end())
        return 0;
    double low = *(lit - 1), high = *lit;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (isSunless(middle) ? low : high) = middle;
    }
    return low;
}

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

/// Levels for a table over altitude: evenly spread for a gentle atmosphere, both sides of every jump of the profile, and more where
/// the air is dense or ends: between two levels optical depths are taken as linear in sqrt(r^2 - R^2), which they are not in haze or a cloud.
std::vector<double> tableAltitudes(const Profile& profile, const Optics& optics, int count)
{
    const auto& p = profile.planet();
    const double narrow = atOnce * p.topOfAtmosphere;
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

/// Optical depths of rays up to some height above a horizon, closer than elevations of the table.
///   depthsAt  (elevation above the horizon, [wavelength])
template<class DepthsAt>
LimbDepths limbDepths(double highest, double scale, double step, const DepthsAt& depthsAt, int wavelengths)
{
    constexpr double closer = 4;
    constexpr int least = 8;
    const double length = axisLength(scale, highest);
    const int rays = std::max(least, static_cast<int>(closer * length / step)) + 1;
    std::vector<double> elevations(rays), depths(size_t(rays) * wavelengths);
    for (int i = 0; i < rays; ++i) {
        elevations[i] = scale * std::sinh(length * i / (rays - 1));
        depthsAt(elevations[i], &depths[size_t(i) * wavelengths]);
    }
    return {std::move(elevations), std::move(depths)};
}

/// 0, 1, .. count - 1.
std::vector<double> evenly(const size_t count)
{
    std::vector<double> result(count);
    std::iota(result.begin(), result.end(), 0.);
    return result;
}

/// Of 0 .. count - 1 at most so many, evenly, the first and the last among them, and those that are `kept`; increasing.
template<class Kept>
std::vector<size_t> someOf(const size_t count, const size_t most, const Kept& kept)
{
    std::vector<size_t> result;
    for (size_t i = 0; i < count; ++i)
        if (i == 0 || i + 1 == count || kept(i) || i * (most - 1) / (count - 1) != (i - 1) * (most - 1) / (count - 1))
            result.push_back(i);
    return result;
}

} // namespace

SunTable::SunTable(const Profile& profile, const Optics& optics, const double sunAngularRadius, const int altitudeCount,
                   const int elevations, const base::StopRequest& stop)
    : planet_(profile.planet()), sunRadius_(sunAngularRadius), sunless_(findSunlessAltitude(profile, optics)),
      scale_(usualScale * sunsetShare(profile, largestExtinctions(optics), sunAngularRadius)),
      elevations_(static_cast<int>(
          std::lround(profile.forShadows(elevations, sunAngularRadius) * axisLength(scale_, pi / 2) / axisLength(usualScale, pi / 2)))),
      wavelengths_(optics.wavelengths), altitudes_(tableAltitudes(profile, optics, profile.forShadows(altitudeCount, sunAngularRadius))),
      depth_((altitudes_.size() + 1) * elevations_ * optics.wavelengths)
{
    for (const double h : altitudes_)
        measures_.push_back(horizonDistance(planet_, h));
    const auto depthsOf = [&](RayTracer& tracer, double altitude, double elevation, double* result) {
        std::vector<double> columns;
        depthsToSpace(tracer, optics, altitude, std::sin(std::min(pi / 2, elevation)), opaque, columns, result);
        for (int w = 0; w < wavelengths_; ++w)
            result[w] = std::min(result[w], opaque);
    };
    // Near the horizon the transmittance changes by factors over the disc, higher up it is linear: two points with the disc's second moment (a quarter
    // of the radius squared) serve, and further up the centre alone.
    const double fine = 3 * sunRadius_, step = axisLength(scale_, pi / 2) / (elevations_ - 1);
    const auto fillRow = [&](size_t row, RayTracer& tracer) {
        const bool onGround = row == altitudes_.size();
        const double h = onGround ? 0 : altitudes_[row], horizon = this->horizon(h);
        const double range = pi / 2 - horizon + sunRadius_;
        std::optional<LimbDepths> limb;
        if (sunRadius_ > 0)
            limb = limbDepths(
                fine + sunRadius_, scale_, step,
                [&](double above, double* result) {
                    base::stopIfAsked(stop);
                    depthsOf(tracer, h, horizon + above, result);
                },
                wavelengths_);
        std::vector<double> lower(wavelengths_);
        for (int k = 0; k < elevations_; ++k) {
            base::stopIfAsked(stop);
            const double x = scale_ * std::sinh(axisLength(scale_, range) * k / (elevations_ - 1));
            const double above = x - sunRadius_, elevation = above + horizon; // of the Sun's centre
            double* result = &depth_[(row * elevations_ + k) * wavelengths_];
            if (limb && above < fine) {
                limb->meanDepth(x, sunRadius_, onGround, result);
                continue;
            }
            const bool centre = sunRadius_ == 0 || elevation > 0.15;
            const double offset = centre ? 0 : 0.5 * sunRadius_;
            depthsOf(tracer, h, elevation + offset, result);
            if (centre)
                continue;
            depthsOf(tracer, h, elevation - offset, lower.data());
            const double high = onGround ? std::sin(elevation + offset) : 1, low = onGround ? std::sin(elevation - offset) : 1;
            for (int w = 0; w < wavelengths_; ++w)
                result[w] = std::max(0., result[w] - std::log((high + low * std::exp(result[w] - lower[w])) / (high + low)));
        }
    };
    base::parallel([&](int thread, int threads) {
        RayTracer tracer(profile, optics, 2);
        for (size_t row = thread; row <= altitudes_.size(); row += threads)
            fillRow(row, tracer);
    });
    if (PeakSunlight::matters(profile, optics))
        throwAside(profile, optics, altitudeCount, elevations, stop);
    const auto even = evenly(elevations_);
    const size_t perRow = size_t(elevations_) * wavelengths_;
    for (size_t row = 0; row <= altitudes_.size(); ++row)
        straighten(even, &depth_[row * perRow], wavelengths_, wavelengths_);
    straighten(measures_, depth_.data(), perRow, static_cast<int>(perRow));
}

void SunTable::throwAside(const Profile& profile, const Optics& optics, const int altitudeCount, const int elevations,
                          const base::StopRequest& stop)
{
    // These depths are smoother than those of sunlight that goes straight on: some rows of a large table and some of its elevations tell the others.
    constexpr size_t mostRows = 48, mostElevations = 64;
    constexpr double sliver = 0.05; // of the disc
    const size_t ground = altitudes_.size(), perRow = size_t(elevations_) * wavelengths_;
    const auto elevationAt = [&](double horizon, size_t k) {
        return horizon - sunRadius_ + scale_ * std::sinh(axisLength(scale_, pi / 2 - horizon + sunRadius_) * k / (elevations_ - 1));
    };
    size_t low = 0; // elevations of a low Sun, above any horizon
    while (low + 1 < size_t(elevations_) && elevationAt(horizon(altitudes_.back()), low) < PeakSunlight::highest)
        ++low;
    const auto besideJump = [&](size_t row) {
        const double narrow = atOnce * planet_.topOfAtmosphere;
        return altitudes_[row] - altitudes_[row - 1] < narrow || altitudes_[row + 1] - altitudes_[row] < narrow;
    };
    const auto rows = someOf(ground, mostRows, besideJump), suns = someOf(low + 1, mostElevations, [](size_t k) { return k < 8; });
    std::vector<double> thrown((ground + 1) * perRow);
    const SunTable through(profile, PeakSunlight::unscaled(optics), sunRadius_, altitudeCount, elevations, stop);
    base::parallel([&](int thread, int threads) {
        PeakSunlight peaks(profile, optics, through, sunRadius_);
        for (size_t i = thread; i <= rows.size(); i += threads) {
            const size_t row = i < rows.size() ? rows[i] : ground;
            const double h = row < ground ? altitudes_[row] : 0, horizon = this->horizon(h);
            peaks.place(h, row == ground);
            size_t hidden = 0; // the last of the elevations that show less than a sliver of the disc
            for (const size_t k : suns) {
                base::stopIfAsked(stop);
                double* const depth = &thrown[row * perRow + k * wavelengths_];
                peaks.transmittance(elevationAt(horizon, k), depth);
                const double visible = visibleDiscFraction(elevationAt(horizon, k) - horizon, sunRadius_);
                for (int w = 0; w < wavelengths_; ++w)
                    depth[w] = depth[w] > 0 ? std::clamp(std::log(visible / depth[w]), 0., opaque) : opaque;
                if (visible < sliver)
                    hidden = k;
            }
            // Light from higher up stays while the disc goes: depths towards a sliver of it would lift that light.
            const size_t shown = *std::min(std::upper_bound(suns.begin(), suns.end(), hidden), suns.end() - 1);
            if (sunRadius_ > 0)
                for (const size_t k : suns)
                    if (k < shown)
                        std::copy_n(&thrown[row * perRow + shown * wavelengths_], wavelengths_, &thrown[row * perRow + k * wavelengths_]);
            drawLines(suns, evenly(low + 1), &thrown[row * perRow], wavelengths_, wavelengths_);
        }
    });
    drawLines(rows, measures_, thrown.data(), perRow, static_cast<int>(perRow));
    for (size_t row = 0; row <= ground; ++row) {
        const double horizon = this->horizon(row < ground ? altitudes_[row] : 0);
        for (size_t k = 0; k <= low; ++k) {
            const double counts = std::clamp(3 * (1 - elevationAt(horizon, k) / PeakSunlight::highest), 0., 1.);
            for (size_t at = row * perRow + k * wavelengths_, end = at + wavelengths_; at < end; ++at)
                depth_[at] += counts * (thrown[at] - depth_[at]);
        }
    }
}

SunTable::Row SunTable::row(const double altitude) const
{
    const size_t k = std::clamp<size_t>(std::upper_bound(altitudes_.begin(), altitudes_.end(), altitude) - altitudes_.begin(), 1,
                                        altitudes_.size() - 1) -
                     1;
    const double measure = horizonDistance(planet_, altitude);
    return {static_cast<int>(k), std::clamp((measure - measures_[k]) / (measures_[k + 1] - measures_[k]), 0., 1.)};
}

double SunTable::horizon(const double altitude) const
{
    return horizonElevation({planet_.radius + sunless_, planet_.topOfAtmosphere - sunless_}, std::max(0., altitude - sunless_));
}

double SunTable::axis(const double elevation, const double horizon) const
{
    const double range = pi / 2 - horizon + sunRadius_;
    const double x = std::max(0., elevation - horizon + sunRadius_);
    return std::min(1., std::asinh(x / scale_) / axisLength(scale_, range));
}

void SunTable::opticalDepth(const double altitude, const double muSun, double* const result, const double rise) const
{
    opticalDepth(row(altitude), horizon(altitude), std::asin(std::clamp(muSun + rise, -1., 1.)), result);
}

void SunTable::opticalDepth(const Row& place, const double horizon, const double elevation, double* const result) const
{
    const auto [row, y] = place;
    const double u = axis(elevation, horizon) * (elevations_ - 1);
    const int k = std::min(static_cast<int>(u), elevations_ - 2);
    const double x = u - k;
    const double* a = &depth_[(size_t(row) * elevations_ + k) * wavelengths_];
    const double* b = a + elevations_ * wavelengths_;
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = (1 - y) * ((1 - x) * a[w] + x * a[wavelengths_ + w]) + y * ((1 - x) * b[w] + x * b[wavelengths_ + w]);
}

void SunTable::transmittance(const double altitude, const double muSun, double* const result, const double rise) const
{
    transmittance(row(altitude), horizon(altitude), muSun, rise, result);
}

void SunTable::transmittance(const Row& place, const double horizon, const double muSun, const double rise, double* const result) const
{
    const double elevation = std::asin(std::clamp(muSun, -1., 1.));
    const double visible = visibleDiscFraction(elevation - horizon, sunRadius_);
    if (visible <= 0) {
        std::fill(result, result + wavelengths_, 0.);
        return;
    }
    opticalDepth(place, horizon, rise == 0 ? elevation : std::asin(std::clamp(muSun + rise, -1., 1.)), result);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = visible * std::exp(-result[w]);
}

void SunTable::groundIrradiance(const double muSun, double* const result, const double rise) const
{
    const double cosine = horizontalSunCosine(muSun + rise, sunRadius_);
    transmittance(groundRow(), 0, muSun, rise, result);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] *= cosine;
}

double horizontalSunCosine(const double muSun, const double sunAngularRadius)
{
    const double elevation = std::asin(std::clamp(muSun, -1., 1.));
    if (std::abs(elevation) >= sunAngularRadius)
        return std::max(muSun, 0.);
    const double x = elevation / sunAngularRadius, area = pi * visibleDiscFraction(elevation, sunAngularRadius);
    return std::max(0., elevation + (x < -0.99 ? 0 : sunAngularRadius * 2 / 3 * std::pow(1 - x * x, 1.5) / area));
}

void sunOnSurface(const Profile& profile, const Optics& optics, const double sunAngularRadius, const double altitude,
                  const double elevation, double* const result)
{
    std::fill(result, result + optics.wavelengths, 0.);
    // Near the horizon light grows from limb to limb by powers of ten, smoothly; higher up it is linear over the disc.
    const bool point = sunAngularRadius <= 0 || elevation > 0.3;
    const int heights = point ? 1 : 8;
    // At elevation centre + radius cos t the chord is 2 radius sin t; over the disc's area: 2 / pi sin^2 t dt.
    const double lowest = point ? 0 : std::acos(std::clamp(-elevation / sunAngularRadius, -1., 1.));
    const auto rule = gaussLegendre(heights, 0, lowest);
    RayTracer tracer(profile, optics, 2);
    std::vector<double> columns, depths(optics.wavelengths);
    for (int i = 0; i < heights; ++i) {
        const double t = rule.nodes[i], sine = std::sin(point ? elevation : elevation + sunAngularRadius * std::cos(t));
        if (!(sine > 0))
            continue;
        const double weight = point ? sine : rule.weights[i] * 2 / pi * std::sin(t) * std::sin(t) * sine;
        depthsToSpace(tracer, optics, altitude, sine, std::numeric_limits<double>::infinity(), columns, depths.data());
        for (int w = 0; w < optics.wavelengths; ++w)
            result[w] += weight * std::exp(-depths[w]);
    }
}

} // namespace sky::physics
