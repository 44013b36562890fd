#include "physics/moments.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include "physics/levels.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

/// Neighbouring intervals, as a share of this one, below which a level counts as an end.
constexpr double unevenness = 0.25;

/// Night beyond three dips of the horizon, where the Sun sets as on Earth, rad.
constexpr double usualNight = 0.02;

} // namespace

MomentGrid::MomentGrid(const Profile& profile, const std::vector<double>& largestExtinction, const int altitudeCount, const int sunCount,
                       const double sunRadius)
{
    // Twilight is as wide as the angle over which the Sun goes out: steps about the horizon are in proportion to it, and there are so many
    // more of them that elsewhere they stay as long.
    const double dip = dipOfAir(profile, largestExtinction), share = sunsetShare(profile, largestExtinction, sunRadius);
    const double scale = std::asinh(std::sinh(leastSunScale) / share);
    // Where the air above a hundred-thousandth of the column ends, three horizon dips below the horizontal is night everywhere.
    const double lowest = std::max(-pi / 2, -3.2 * dip - std::max(usualNight * share, 2 * sunRadius));
    const double night = std::asinh(-lowest / (pi / 2) * std::sinh(scale));
    const auto steps = std::lround((sunCount - 1) * (scale + night) / (leastSunScale + night));
    *this =
        MomentGrid(profile.planet(), fieldLevels(profile, largestExtinction, altitudeCount), lowest, static_cast<int>(steps) + 1, scale);
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
    const auto logarithm = logarithmBetween(a);
    for (int j = 0; j < 4; ++j) {
        const double mirror = b.index[j] < grid.sunCount() ? 1 : -1; // of odd orders
        if (b.weight[j] == 0)
            continue;
        const double* levels[4];
        for (int i = 0; i < 4; ++i)
            levels[i] = at(a.index[i], grid.sunAsHigh(b.index[j]));
        for (int w = 0; w < wavelengths; ++w)
            result[w] += b.weight[j] * logarithm(levels[0][w], levels[1][w], levels[2][w], levels[3][w]);
        for (int i = 0; i < 4; ++i)
            for (int l = 1, k = wavelengths; l <= degree; ++l) {
                const double weight = (bentDegree < 0 || l <= bentDegree ? a.weight[i] : straight[i]) * b.weight[j];
                for (int m = 0; m <= l; ++m)
                    for (int w = 0; w < wavelengths; ++w, ++k)
                        result[k] += (m % 2 ? mirror : 1) * weight * levels[i][k];
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
