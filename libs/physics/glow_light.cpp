#include "physics/glow_light.hpp"
#include "base/angles.hpp"
#include "base/not_negative.hpp"
#include <algorithm>
#include <cmath>
#include <cstring>

namespace sky::physics {

namespace {

using base::pi;
constexpr int lanes = GlowLight::lanes;
using Lane = GlowLight::Lane;
using Lanes = base::VectorsOf<Lane>;
/// Optical depth of a cell below which series take the place of quotients of small numbers.
constexpr float thin = 0.25F;
/// Levels for every one of the field, between which it is linear in sqrt(r^2 - R^2).
constexpr int refinement = 4;
/// Air that lets through less than this hides all behind it.
constexpr float opaque = 1e-7F;
constexpr int opacityEvery = 8; // cells between two looks at that

/// A ray as all wavelengths meet it; [bound] has one more than [cell].
struct Path {
    int cells;
    std::vector<float> columns;   // [cell][species], times the species' unit of cross sections
    std::vector<float> centres;   // [cell][species]
    std::vector<int> levels;      // [bound]
    std::vector<float> shares;    // [bound], of the way to the next level
    std::vector<float> harmonics; // [bound][l]: Legendre polynomials
};

bool isDark(const Lane& through)
{
    for (int w = 0; w < lanes; ++w)
        if (through[w] > 0)
            return false;
    return true;
}

/// The field's light along a path for one block of wavelengths.
///   sources  scratch, [2][scatterer];  light, through  what comes out, and the transmittance of the whole path
SKY_WIDEST_VECTORS
void gather(const Path& path, int degree, int species, const int* scatterers, int scattererCount, const Lane* extinction,
            const Lane* scattering, const Lane* field, Lane* sources, Lane& light, Lane& through)
{
    constexpr float log2e = 1.44269504F;
    Lane *near = sources, *far = sources + scattererCount;
    light = Lane{};
    through = Lane{} + 1;
    for (int b = 0; b <= path.cells; ++b) {
        // What one unit of each scatterer would send along the ray from here.
        for (int i = 0; i < scattererCount; ++i)
            far[i] = Lane{};
        const Lane *low = field + path.levels[b] * (degree + 1), *high = low + degree + 1;
        for (int l = 0; l <= degree; ++l) {
            const Lane value = path.harmonics[b * (degree + 1) + l] * (low[l] + path.shares[b] * (high[l] - low[l]));
            for (int i = 0; i < scattererCount; ++i)
                far[i] += scattering[i * (degree + 1) + l] * value;
        }
        if (b > 0) {
            const float *column = &path.columns[(b - 1) * species], *centre = &path.centres[(b - 1) * species];
            Lane tau{}, left;
            for (int s = 0; s < species; ++s)
                tau += column[s] * extinction[s];
            float exponent[lanes], power[lanes]; // compilers make no vectors of loops over a vector's elements
            tau *= -log2e;
            std::memcpy(exponent, &tau, sizeof tau);
            for (int w = 0; w < lanes; ++w)
                power[w] = base::exp2Lane(exponent[w]);
            std::memcpy(&left, power, sizeof left);
            tau *= -1 / log2e;
            // (1 - exp(-tau)) / tau, and how far attenuation moves the centre of light towards the viewer: 1/tau - 1/(e^tau - 1) - 1/2.
            const Lane lost = 1 - left;
            const Lane mean = tau < thin ? 1 - tau * (0.5F - tau * (1 / 6.F - tau * (1 / 24.F - tau / 120))) : lost / tau;
            const Lane shift = tau < thin ? -tau / 12 * (1 - tau * tau / 60) : 1 / tau - left / lost - 0.5F;
            for (int i = 0; i < scattererCount; ++i) {
                Lane at = centre[scatterers[i]] + shift;
                at = at < 0 ? Lane{} : at > 1 ? Lane{} + 1 : at;
                light += column[scatterers[i]] * through * mean * (near[i] + at * (far[i] - near[i]));
            }
            through *= left;
            through = through < opaque ? Lane{} : through;
            if (b % opacityEvery == 0 && isDark(through))
                break;
        }
        std::swap(near, far);
    }
}

} // namespace

struct GlowLight::Sums {
    Lanes light, through; // [block]
};

GlowLight::GlowLight(const Medium& medium, const Optics& optics, const GlowMoments& moments)
    : planet_{medium.planetRadius, medium.topOfAtmosphere}, degree_(optics.degree), species_(optics.species),
      wavelengths_(optics.wavelengths), scatterers_(optics.scatterers)
{
    for (int w = 0; w < wavelengths_; ++w)
        reflected_.push_back(medium.groundAlbedo[w] / pi * moments.groundIrradiance[w]);
    const auto& altitudes = moments.grid.altitudes();
    for (std::size_t k = 0; k + 1 < altitudes.size(); ++k)
        for (int i = 0; i < refinement; ++i) {
            const double from = horizonDistance(planet_, altitudes[k]), to = horizonDistance(planet_, altitudes[k + 1]);
            measures_.push_back(from + (to - from) * i / refinement);
        }
    measures_.push_back(horizonDistance(planet_, altitudes.back()));

    const int blocks = (wavelengths_ + lanes - 1) / lanes, harmonics = degree_ + 1, levels = static_cast<int>(measures_.size());
    const int scattererCount = static_cast<int>(scatterers_.size());
    for (int s = 0; s < species_; ++s) {
        const auto first = optics.extinction.begin() + s * wavelengths_;
        const double largest = *std::max_element(first, first + wavelengths_);
        units_.push_back(largest > 0 ? largest : 1);
    }
    extinction_.resize(std::size_t(blocks) * species_);
    scattering_.resize(std::size_t(blocks) * scattererCount * harmonics);
    field_.resize(std::size_t(blocks) * levels * harmonics);
    for (int w = 0; w < wavelengths_; ++w) {
        const std::size_t block = w / lanes;
        const int lane = w % lanes;
        for (int s = 0; s < species_; ++s)
            extinction_[block * species_ + s][lane] = static_cast<float>(optics.extinction[s * wavelengths_ + w] / units_[s]);
        for (int i = 0; i < scattererCount; ++i)
            for (int l = 0; l <= degree_; ++l)
                scattering_[(block * scattererCount + i) * harmonics + l][lane] = static_cast<float>(
                    optics.scattering[scatterers_[i] * wavelengths_ + w] / units_[scatterers_[i]] * optics.moment(scatterers_[i], l, w));
    }
    std::vector<double> values(std::size_t(harmonics) * wavelengths_);
    for (int k = 0; k < levels; ++k) {
        const double square = measures_[k] * measures_[k];
        moments.interpolate(square / (std::sqrt(planet_.radius * planet_.radius + square) + planet_.radius), values.data());
        for (int l = 0; l <= degree_; ++l)
            for (int w = 0; w < wavelengths_; ++w)
                field_[(std::size_t(w / lanes) * levels + k) * harmonics + l][w % lanes] =
                    static_cast<float>(std::sqrt((2 * l + 1) / (4 * pi)) * values[l * wavelengths_ + w]);
    }
}

GlowLight::Sums GlowLight::along(const RayCells& ray) const
{
    Path path;
    path.cells = static_cast<int>(ray.bounds.size()) - 1;
    path.columns.reserve(ray.columns.size());
    for (std::size_t i = 0; i < ray.columns.size(); ++i)
        path.columns.push_back(static_cast<float>(ray.columns[i] * units_[i % species_]));
    path.centres.assign(ray.centres.begin(), ray.centres.end());
    const int bounds = path.cells + 1, harmonics = degree_ + 1, lastLevel = static_cast<int>(measures_.size()) - 2;
    path.levels.resize(bounds);
    path.shares.resize(bounds);
    path.harmonics.resize(std::size_t(bounds) * harmonics);
    const double r = planet_.radius + ray.altitude;
    for (int b = 0, k = 0; b < bounds; ++b) {
        const double x = horizonDistance(planet_, ray.altitudes[b]);
        while (k < lastLevel && measures_[k + 1] < x)
            ++k;
        while (k > 0 && measures_[k] > x)
            --k;
        path.levels[b] = k;
        path.shares[b] = static_cast<float>(std::clamp((x - measures_[k]) / (measures_[k + 1] - measures_[k]), 0., 1.));
        const double mu = std::clamp((r * ray.mu + ray.bounds[b]) / (planet_.radius + ray.altitudes[b]), -1., 1.);
        float* p = &path.harmonics[std::size_t(b) * harmonics];
        p[0] = 1;
        if (degree_ > 0)
            p[1] = static_cast<float>(mu);
        for (int l = 1; l < degree_; ++l)
            p[l + 1] = (static_cast<float>(2 * l + 1) * p[1] * p[l] - static_cast<float>(l) * p[l - 1]) / static_cast<float>(l + 1);
    }
    const int blocks = (wavelengths_ + lanes - 1) / lanes, scattererCount = static_cast<int>(scatterers_.size());
    Sums sums{Lanes(blocks), Lanes(blocks)};
    Lanes sources(std::size_t(2) * scattererCount);
    for (int k = 0; k < blocks; ++k)
        gather(path, degree_, species_, scatterers_.data(), scattererCount, extinction_.data() + k * species_,
               scattering_.data() + k * scattererCount * harmonics, field_.data() + std::size_t(k) * measures_.size() * harmonics,
               sources.data(), sums.light[k], sums.through[k]);
    return sums;
}

void GlowLight::scattered(const RayCells& ray, double* const result) const
{
    const Sums sums = along(ray);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = base::notNegative(double(sums.light[w / lanes][w % lanes]) +
                                      (ray.hitsGround ? double(sums.through[w / lanes][w % lanes]) * reflected_[w] : 0));
}

void GlowLight::direct(const RayCells& ray, double* const result) const
{
    const Sums sums = along(ray);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = ray.hitsGround ? double(sums.through[w / lanes][w % lanes]) : 0;
}

void GlowLight::seen(const RayCells& ray, double* const result) const
{
    const Sums sums = along(ray);
    for (int w = 0; w < wavelengths_; ++w)
        result[w] = base::notNegative(double(sums.light[w / lanes][w % lanes]) +
                                      (ray.hitsGround ? double(sums.through[w / lanes][w % lanes]) * (1 + reflected_[w]) : 0));
}

} // namespace sky::physics
