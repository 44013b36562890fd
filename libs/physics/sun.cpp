#include "physics/sun.hpp"
#include "base/angles.hpp"
#include "base/not_negative.hpp"
#include "base/parallel.hpp"
#include "physics/limb.hpp"
#include "physics/peak_sunlight.hpp"
#include "physics/quadrature.hpp"
#include "physics/ray.hpp"
#include "physics/straighten.hpp"
#include "physics/sun_altitudes.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sky::physics {

namespace {

using base::pi;

/// Optical depth of a horizontal ray on its way out behind which there is no sunlight: 1e-20 of it.
constexpr double sunlessDepth = 46;

/// Radii of the Sun up to which, above the horizon, light is followed from each part of the disc.
constexpr double fineRadii = 3;

/// Scale of the elevation axis for the usual sunset, rad.
constexpr double usualScale = 0.03;

double axisLength(double scale, double range) { return std::asinh(range / scale); }

double scaleOfAxis(const Profile& profile, const Optics& optics, double sunRadius)
{
    return usualScale * sunsetShare(profile, largestExtinctions(optics), sunRadius);
}

/// So many that steps stay as long as usual where the scale is smaller, and shadows' edges get their share.
int elevationsOn(double scale, const Profile& profile, double sunRadius, int usual)
{
    return static_cast<int>(std::lround(profile.forShadows(usual, sunRadius) * axisLength(scale, pi / 2) / axisLength(usualScale, pi / 2)));
}

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

/// Rays below the highest elevation of limbDepths, closer than elevations of the table.
int limbRays(double highest, double scale, double step)
{
    constexpr double closer = 4;
    constexpr int least = 8;
    return std::max(least, static_cast<int>(closer * axisLength(scale, highest) / step)) + 1;
}

/// Optical depths of rays up to some height above a horizon.
///   depthsAt  (elevation above the horizon, [wavelength])
template<class DepthsAt>
LimbDepths limbDepths(double highest, double scale, double step, const DepthsAt& depthsAt, int wavelengths)
{
    const double length = axisLength(scale, highest);
    const int rays = limbRays(highest, scale, step);
    std::vector<double> elevations(rays), depths(size_t(rays) * wavelengths);
    for (int i = 0; i < rays; ++i) {
        elevations[i] = scale * std::sinh(length * i / (rays - 1));
        depthsAt(elevations[i], &depths[size_t(i) * wavelengths]);
    }
    return {std::move(elevations), std::move(depths)};
}

} // namespace

SunTable::SunTable(const Profile& profile, const Optics& optics, const double sunAngularRadius, const int altitudeCount,
                   const int elevations, const base::StopRequest& stop)
    : planet_(profile.planet()), sunRadius_(sunAngularRadius), sunless_(findSunlessAltitude(profile, optics)),
      scale_(scaleOfAxis(profile, optics, sunAngularRadius)), elevations_(elevationsOn(scale_, profile, sunAngularRadius, elevations)),
      wavelengths_(optics.wavelengths), altitudes_(sunAltitudes(profile, optics, profile.forShadows(altitudeCount, sunAngularRadius))),
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
    const double fine = fineRadii * sunRadius_, step = axisLength(scale_, pi / 2) / (elevations_ - 1);
    const auto fillRow = [&](size_t row, RayTracer& tracer) {
        const bool onGround = row == altitudes_.size();
        const double h = onGround ? 0 : altitudes_[row], horizon = this->horizon(h);
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
            const double x = aboveLowest(horizon, k);
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
                result[w] = base::notNegative(result[w] - std::log((high + low * std::exp(result[w] - lower[w])) / (high + low)));
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

SunTable::Cost SunTable::costOf(const Profile& profile, const Optics& optics, const double sunAngularRadius, const int altitudeCount,
                                const int elevationCount)
{
    const auto altitudes = sunAltitudes(profile, optics, profile.forShadows(altitudeCount, sunAngularRadius));
    const double scale = scaleOfAxis(profile, optics, sunAngularRadius), length = axisLength(scale, pi / 2);
    const double elevations = elevationsOn(scale, profile, sunAngularRadius, elevationCount);
    const double rows = double(altitudes.size()) + 1, wavelengths = optics.wavelengths, shells = double(profile.shells().size());
    Cost cost{};
    cost.bytes = rows * elevations * wavelengths * sizeof(double);
    cost.peakBytes = cost.bytes;
    // Rays; means over the disc near the horizon; depths. Seconds of an x86 processor of 2024.
    const double besideLimb = fineRadii + 1, inDisc = limbRays(besideLimb * sunAngularRadius, scale, length / (elevations - 1));
    const double onLimb = elevations * axisLength(scale, besideLimb * sunAngularRadius) / length;
    cost.seconds = rows * ((2 * elevations + inDisc) * (4e-7 + 1.5e-9 * shells * optics.species) +
                           (4.8e-9 * onLimb * (16 + inDisc) + 6.7e-9 * elevations) * wavelengths);
    if (PeakSunlight::matters(profile, optics)) {
        const double followed = double(PeakSunlight::followedAltitudes(altitudes).size()) + 1;
        cost.peakBytes += cost.bytes * (1 + followed / rows); // sunlight without peaks, and what they throw
        cost.seconds = 2 * cost.seconds + followed * PeakSunlight::secondsOfRow(optics, shells);
    }
    return cost;
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

double SunTable::aboveLowest(const double horizon, const std::size_t k) const
{
    return scale_ * std::sinh(axisLength(scale_, pi / 2 - horizon + sunRadius_) * k / (elevations_ - 1));
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
