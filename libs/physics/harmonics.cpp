#include "physics/harmonics.hpp"
#include "base/angles.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

using base::pi;

void harmonicFactors(const int degree, const double mu, double* const factors) { harmonicFactors(degree, &mu, 1, factors); }

void legendre(const int degree, const double x, double* const values)
{
    values[0] = 1;
    if (degree > 0)
        values[1] = x;
    for (int l = 1; l < degree; ++l)
        values[l + 1] = ((2 * l + 1) * x * values[l] - l * values[l - 1]) / (l + 1);
}

std::vector<double> phaseMoments(const Medium& medium, const Species& species, const int wavelength, const int degree)
{
    std::vector<double> moments(degree + 1), polynomials(degree + 1);
    const int wavelengths = medium.wavelengthCount();
    const auto value = [&](size_t k) { return species.phaseFunction[k * wavelengths + wavelength]; };
    const double offsets[2] = {0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)};
    for (size_t k = 0; k + 1 < medium.scatteringAngles.size(); ++k) {
        const double t0 = medium.scatteringAngles[k], t1 = medium.scatteringAngles[k + 1];
        const double p0 = value(k), p1 = value(k + 1);
        for (const double x : offsets) {
            const double theta = t0 + x * (t1 - t0);
            const double p = p0 > 0 && p1 > 0 ? p0 * std::pow(p1 / p0, x) : p0 + x * (p1 - p0);
            legendre(degree, std::cos(theta), polynomials.data());
            for (int l = 0; l <= degree; ++l)
                moments[l] += 2 * pi * std::sin(theta) * 0.5 * (t1 - t0) * p * polynomials[l];
        }
    }
    return moments;
}

namespace {

/// The gap between two scattering angles that one lies in, and how far: 0..1.
struct AngleGap {
    size_t node = 0;
    double share = 0;
};

AngleGap angleGap(const Medium& medium, const double theta)
{
    const auto& angles = medium.scatteringAngles;
    const size_t k = std::clamp<size_t>(std::upper_bound(angles.begin(), angles.end(), theta) - angles.begin(), 1, angles.size() - 1) - 1;
    return {k, std::clamp((theta - angles[k]) / (angles[k + 1] - angles[k]), 0., 1.)};
}

double phaseFunctionAt(const Medium& medium, const Species& species, const AngleGap gap, const int wavelength)
{
    const auto value = [&](size_t node) { return species.phaseFunction[node * medium.wavelengthsNm.size() + wavelength]; };
    const double p0 = value(gap.node), p1 = value(gap.node + 1);
    return p0 > 0 && p1 > 0 ? p0 * std::pow(p1 / p0, gap.share) : p0 + gap.share * (p1 - p0);
}

} // namespace

double phaseFunctionAt(const Medium& medium, const Species& species, const double theta, const int wavelength)
{
    return phaseFunctionAt(medium, species, angleGap(medium, theta), wavelength);
}

void phaseFunctionAt(const Medium& medium, const Species& species, const double theta, double* const values)
{
    const AngleGap gap = angleGap(medium, theta);
    for (int w = 0; w < medium.wavelengthCount(); ++w)
        values[w] = phaseFunctionAt(medium, species, gap, w);
}

} // namespace sky::physics
