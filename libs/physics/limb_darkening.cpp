#include "physics/limb_darkening.hpp"
#include "base/angles.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;
constexpr int rings = 24;

/// Share of a ring of radius r around the Sun's centre that lies outside the Moon's disc of radius b at distance d.
double ringLeft(double r, double b, double d)
{
    // The half-angle formula for the arc inside the Moon, its complement taken by swapping the legs.
    return eclipse_detail::twiceAngle((r + d + b) * (r + d - b), (b + d - r) * (b - d + r)) / pi;
}

} // namespace

double LimbDarkening::exponent(const double wavelengthNm)
{
    const double um = std::clamp(wavelengthNm, 303., 1099.) * 1e-3;
    const auto visible = [](double x) { return -0.023 + 0.292 / x; };
    const auto violet = [](double x) { return -0.507 + 0.441 / x; };
    if (um >= 0.417)
        return visible(um);
    if (um <= 0.373)
        return violet(um);
    return violet(0.373) + (um - 0.373) / (0.417 - 0.373) * (visible(0.417) - violet(0.373));
}

LimbDarkening::LimbDarkening(const std::vector<double>& wavelengthsNm)
{
    for (const double wavelength : wavelengthsNm)
        exponents_.push_back(exponent(wavelength));
}

void LimbDarkening::visible(const Discs<double>& discs, double* const result) const
{
    const double b = discs.moonRadius / discs.sunRadius, d = discs.separation / discs.sunRadius;
    const std::size_t wavelengths = exponents_.size();
    if (d >= 1 + b || d <= b - 1) {
        std::fill_n(result, wavelengths, d >= 1 + b ? 1. : 0.);
        return;
    }
    // With t = mu^2 the light outside radius r is t^(1 + alpha/2). Rings inside |d - b| are whole or hidden, as are
    // those beyond d + b; between, the arcs end in square roots, which r = middle - half cos(angle) takes out.
    const double inner = std::min(1., std::abs(d - b)), outer = std::min(1., d + b);
    const double tInner = (1 - inner) * (1 + inner), tOuter = (1 - outer) * (1 + outer);
    for (std::size_t w = 0; w < wavelengths; ++w) {
        const double power = 1 + 0.5 * exponents_[w];
        result[w] = (d > b ? 1 - std::pow(tInner, power) : 0.) + std::pow(tOuter, power);
    }
    for (int k = 0; k < rings; ++k) {
        const double angle = pi * (k + 0.5) / rings, r = inner + (outer - inner) * 0.5 * (1 - std::cos(angle));
        const double width = 0.5 * (outer - inner) * std::sin(angle) * pi / rings;
        const double left = ringLeft(r, b, d), t = (1 - r) * (1 + r);
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] += left * width * (2 + exponents_[w]) * r * std::pow(t, 0.5 * exponents_[w]);
    }
    for (std::size_t w = 0; w < wavelengths; ++w)
        result[w] = std::clamp(result[w], 0., 1.);
}

void LimbDarkening::profile(const double distance, double* const result) const
{
    const double t = std::max(0., (1 - distance) * (1 + distance));
    for (std::size_t w = 0; w < exponents_.size(); ++w)
        result[w] = (1 + 0.5 * exponents_[w]) * std::pow(t, 0.5 * exponents_[w]);
}

} // namespace sky::physics
