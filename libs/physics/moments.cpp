#include "physics/moments.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

/// Neighbouring intervals, as a share of this one, below which a level counts as an end.
constexpr double unevenness = 0.25;

/// Optical depth between two levels of the grid above which another level is put between them.
constexpr double levelOpticalDepth = 0.3;
/// So many times more of them in an interval with an edge.
constexpr double edgeCrowding = 1.25;
/// The same along a grazing ray, of what is not exponential in altitude: a thin layer high up is thick for a setting Sun. No light grazes
/// through more than the thickest.
constexpr double levelUnevenDepth = 0.4, thickest = 1.6;

/// Beyond, days would be coarse for the sake of a sunset that lasts seconds.
constexpr double mostSunScale = 8;

/// Scale of the axis of elevations whose step at the horizon, proportional to a / sinh a, is to a sunset of that angle as on Earth.
double sunScaleFor(const double sunset)
{
    const double least = MomentGrid::leastSunScale, wanted = std::min(1., sunset / usualSunset) * least / std::sinh(least);
    double low = least, high = mostSunScale; // a / sinh a falls
    for (int i = 0; i < 60; ++i) {
        const double a = 0.5 * (low + high);
        (a / std::sinh(a) > wanted ? low : high) = a;
    }
    return low;
}

} // namespace

MomentGrid::MomentGrid(const Profile& profile, const std::vector<double>& largestExtinction, const int altitudeCount, const int sunCount,
                       const double sunRadius)
    : planet_(profile.planet()), sunCount_(sunCount)
{
    const double top = planet_.topOfAtmosphere;
    std::vector<double> levels = altitudeNodes(planet_, altitudeCount);

    // Optical depth from the ground up, at the shells of the profile, and levels at the feet of jumps.
    const auto& shells = profile.shells();
    const int species = profile.speciesCount();
    const auto depth = depthBelowShells(profile, largestExtinction);
    std::vector<double> n(species);
    const auto extinctionAt = [&](int interval, double altitude) {
        profile.densities(interval, altitude, n.data());
        double beta = 0;
        for (int s = 0; s < species; ++s)
            beta += n[s] * largestExtinction[s];
        return beta;
    };
    const auto depthAt = [&](double altitude) {
        const int k = profile.intervalAt(altitude);
        return depth[k] + depthInShell(profile, largestExtinction, k, altitude);
    };
    // Optical depth of a grazing ray between two levels, as far as extinction there is not exponential: what a level between them would see.
    const auto unevenDepth = [&](double low, double high) {
        const double a = extinctionAt(profile.intervalAt(low), low), b = extinctionAt(profile.intervalAt(high), high);
        double most = 0;
        for (int q = 1; q < 8; ++q) {
            const double x = q / 8., h = low + (high - low) * x, even = a > 0 && b > 0 ? a * std::pow(b / a, x) : a + (b - a) * x;
            most = std::max(most, std::abs(extinctionAt(profile.intervalAt(h), h) - even));
        }
        const double far = horizonDistance(planet_, high), near = horizonDistance(planet_, low);
        return most * std::sqrt((far - near) * (far + near));
    };
    for (size_t k = 1; k + 1 < shells.size(); ++k) {
        const double below = extinctionAt(static_cast<int>(k) - 1, shells[k]), above = extinctionAt(static_cast<int>(k), shells[k]);
        const bool steep =
            shells[k + 1] - shells[k] < 1e-5 * top && std::abs(extinctionAt(static_cast<int>(k), shells[k + 1]) - above) * top > 0.02;
        if (steep || std::abs(above - below) * top > 0.02 * std::max(1., depth.back()))
            levels.push_back(0.5 * (shells[k] + shells[k + 1]) - (steep ? 0 : 0.5 * (shells[k + 1] - shells[k])));
    }
    const std::vector<double> jumps(levels.begin() + altitudeCount, levels.end());
    const auto isJump = [&](double level) { return std::find(jumps.begin(), jumps.end(), level) != jumps.end(); };
    std::sort(levels.begin(), levels.end());
    altitudes_.push_back(0);
    for (const double level : levels) {
        const double last = altitudes_.back();
        if (level - last < 1e-6 * top)
            continue;
        // The field bends within a small optical depth of an edge, the ground among them, so levels crowd there, as the cosines of even
        // angles do.
        const bool edgeBelow = last == 0 || isJump(last), edgeAbove = isJump(level);
        const double density = edgeBelow || edgeAbove ? edgeCrowding / levelOpticalDepth : 1 / levelOpticalDepth;
        const int forShape =
            edgeBelow || edgeAbove ? 0 : static_cast<int>(std::sqrt(std::min(unevenDepth(last, level), thickest) / levelUnevenDepth));
        const int extra = std::clamp(static_cast<int>((depthAt(level) - depthAt(last)) * density), forShape, 63);
        for (int i = 1; i <= extra; ++i) {
            const double even = static_cast<double>(i) / (extra + 1);
            const double share = edgeBelow && edgeAbove ? 0.5 - 0.5 * std::cos(pi * even)
                                 : edgeBelow            ? 1 - std::cos(0.5 * pi * even)
                                 : edgeAbove            ? std::sin(0.5 * pi * even)
                                                        : even;
            altitudes_.push_back(last + (level - last) * share);
        }
        altitudes_.push_back(level);
    }
    altitudes_.back() = top;

    // Where the air above a millionth of the column ends, three horizon dips below the horizontal is night everywhere.
    const double dip = dipOfAir(profile, largestExtinction);
    lowest_ = std::max(-pi / 2, -3.2 * dip - std::max(0.02, 2 * sunRadius));
    *this = MomentGrid(planet_, altitudes_, lowest_, sunCount_, sunScaleFor(dip + 2 * sunRadius));
}

MomentGrid::MomentGrid(const Planet planet, std::vector<double> altitudes, const double lowestElevation, const int sunCount,
                       const double sunScale)
    : planet_(planet), altitudes_(std::move(altitudes)), lowest_(lowestElevation), sunScale_(sunScale), sunCount_(sunCount)
{
    for (const double h : altitudes_)
        measure_.push_back(horizonDistance(planet_, h));
    vLowest_ = std::asinh(lowest_ / (pi / 2) * std::sinh(sunScale_)) / sunScale_;
}

double MomentGrid::sunElevation(const double position) const
{
    const double v = vLowest_ + (1 - vLowest_) * position / (sunCount_ - 1);
    return std::min(pi / 2, pi / 2 * std::sinh(sunScale_ * v) / std::sinh(sunScale_));
}

double MomentGrid::sunPosition(const double elevation) const
{
    const double v = std::asinh(elevation / (pi / 2) * std::sinh(sunScale_)) / sunScale_;
    return std::clamp((v - vLowest_) / (1 - vLowest_) * (sunCount_ - 1), 0., sunCount_ - 1.);
}

Stencil MomentGrid::altitudeStencil(const double altitude) const
{
    const int n = altitudeCount();
    const double x = horizonDistance(planet_, altitude);
    const int k = std::clamp(static_cast<int>(std::upper_bound(measure_.begin(), measure_.end(), x) - measure_.begin()) - 1, 0, n - 2);
    const double gap = measure_[k + 1] - measure_[k], t = std::clamp((x - measure_[k]) / gap, 0., 1.);
    // Hermite basis; the slope at a level is that of the parabola through it and its neighbours, at the ground through the next two
    // (in haze the field is even in the measure there). A chord takes its place at the top, and where the neighbour is much nearer than
    // the interval is wide, at a layer's edge: the field bends there, and a slope taken from so short a step would be thrown far.
    const double h10 = t * (1 - t) * (1 - t) * gap, h11 = -t * t * (1 - t) * gap, h01 = t * t * (3 - 2 * t);
    Stencil stencil{{std::max(k - 1, 0), k, k + 1, std::min(k + 2, n - 1)}, {0, 1 - h01, h01, 0}, t};
    if (k > 0 && measure_[k] - measure_[k - 1] > unevenness * gap) {
        const double before = measure_[k] - measure_[k - 1], sum = before + gap;
        stencil.weight[0] += h10 * -gap / (before * sum);
        stencil.weight[1] += h10 * (gap - before) / (before * gap);
        stencil.weight[2] += h10 * before / (gap * sum);
    } else if (k == 0 && n > 2 && measure_[2] - measure_[1] > unevenness * gap) {
        const double after = measure_[2] - measure_[1], sum = gap + after;
        stencil.weight[1] += h10 * -(gap + sum) / (gap * sum);
        stencil.weight[2] += h10 * sum / (gap * after);
        stencil.weight[3] += h10 * -gap / (after * sum);
    } else {
        stencil.weight[1] -= h10 / gap;
        stencil.weight[2] += h10 / gap;
    }
    if (k + 2 < n && measure_[k + 2] - measure_[k + 1] > unevenness * gap) {
        const double after = measure_[k + 2] - measure_[k + 1], sum = gap + after;
        stencil.weight[1] += h11 * -after / (gap * sum);
        stencil.weight[2] += h11 * (after - gap) / (gap * after);
        stencil.weight[3] += h11 * gap / (after * sum);
    } else {
        stencil.weight[1] -= h11 / gap;
        stencil.weight[2] += h11 / gap;
    }
    return stencil;
}

Stencil MomentGrid::sunStencil(const double position) const
{
    auto [stencil, beyondZenith] = physics::sunStencil(position, sunCount_);
    if (beyondZenith)
        stencil.index[3] = sunCount_;
    return stencil;
}

Stencil MomentGrid::sunStencil(const double position, const int chords) const
{
    if (chords == 0)
        return sunStencil(position);
    const int k = std::clamp(static_cast<int>(position), 0, sunCount_ - 2);
    const double u = (position - k) * chords;
    const int chord = std::min(static_cast<int>(u), chords - 1);
    Stencil s = sunStencil(k + double(chord) / chords);
    // Its end at the next Sun, still among the same four.
    const Stencil end = sunStencil(std::min(k + double(chord + 1) / chords, std::nextafter(k + 1., 0.)));
    for (int i = 0; i < 4; ++i)
        s.weight[i] += (u - chord) * (end.weight[i] - s.weight[i]);
    s.between = std::clamp(position - k, 0., 1.);
    return s;
}

const double* Moments::at(const int altitude, const int sun) const
{
    return &values[size_t(altitude * grid.sunCount() + sun) * harmonicCount(degree) * wavelengths];
}

double* Moments::at(const int altitude, const int sun)
{
    return &values[size_t(altitude * grid.sunCount() + sun) * harmonicCount(degree) * wavelengths];
}

std::vector<double> Moments::withSunBeyondZenith() const
{
    const int suns = grid.sunCount();
    std::vector<double> result;
    result.reserve(values.size() / static_cast<size_t>(suns) * static_cast<size_t>(suns + 1));
    for (int a = 0; a < grid.altitudeCount(); ++a) {
        result.insert(result.end(), at(a, 0), at(a, 0) + size_t(suns) * harmonicCount(degree) * wavelengths);
        const double* mirrored = at(a, grid.sunAsHigh(suns));
        for (int l = 0; l <= degree; ++l)
            for (int m = 0; m <= l; ++m)
                for (int w = 0; w < wavelengths; ++w)
                    result.push_back((m % 2 ? -1 : 1) * *mirrored++);
    }
    return result;
}

void Moments::interpolate(const double altitude, const double muSun, double* const result) const
{
    const Stencil a = grid.altitudeStencil(altitude);
    const Stencil b = grid.sunStencil(grid.sunPosition(std::asin(std::clamp(muSun, -1., 1.))), sunChords);
    const int count = harmonicCount(degree) * wavelengths;
    std::fill(result, result + count, 0.);
    const std::array<double, 4> straight{0, 1 - a.between, a.between, 0};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const double mirror = b.index[j] < grid.sunCount() ? 1 : -1; // of odd orders
            if (b.weight[j] == 0)
                continue;
            const double* source = at(a.index[i], grid.sunAsHigh(b.index[j]));
            for (int l = 0, k = 0; l <= degree; ++l) {
                const double weight = (bentDegree < 0 || l <= bentDegree ? a.weight[i] : straight[i]) * b.weight[j];
                for (int m = 0; m <= l; ++m)
                    for (int w = 0; w < wavelengths; ++w, ++k)
                        result[k] += (m % 2 ? mirror : 1) * weight * source[k];
            }
        }
    for (int w = 0; w < wavelengths; ++w)
        result[w] = std::exp(result[w]);
    for (int lm = 1; lm < harmonicCount(degree); ++lm)
        for (int w = 0; w < wavelengths; ++w)
            result[lm * wavelengths + w] *= result[w];
}

void Moments::interpolateGround(const double muSun, double* const result) const
{
    const Stencil b = grid.sunStencil(grid.sunPosition(std::asin(std::clamp(muSun, -1., 1.))), sunChords);
    for (int w = 0; w < wavelengths; ++w) {
        double logarithm = 0;
        for (int j = 0; j < 4; ++j)
            logarithm += b.weight[j] * std::log(std::max(groundIrradiance[grid.sunAsHigh(b.index[j]) * wavelengths + w], darkness));
        result[w] = std::exp(logarithm);
    }
}

} // namespace sky::physics
