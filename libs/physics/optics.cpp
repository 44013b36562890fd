#include "physics/optics.hpp"
#include "base/angles.hpp"
#include "physics/geometry.hpp"
#include "physics/harmonics.hpp"
#include "physics/phase_fit.hpp"
#include <algorithm>
#include <cmath>
#include <functional>

namespace sky::physics {

namespace {

/// Scattering optical depth of truncated light, along the vertical, from which scaling pays. Below it, leaving the series cut and
/// the optical depths alone is the more accurate at a low degree.
constexpr double truncationMatters = 0.005;

/// Sharp peaks are scaled in any thin air where they do more than this share of the scattering, and their horizontal ray is not as deep as this. Only
/// blurred, they carry light of the ground into the sky: g = 0.99, 1e-4 deep over a ground of albedo 0.3, erred by 201 % of bright light. Along
/// deeper rays the blur is the better: what a peak takes a degree aside leaves a flat shell there, and light that goes straight on does not.
constexpr double hardlyAny = 0.005, scattersAgain = 1.2;

/// The mean that becomes f reaches up to so many times the first degree that is cut.
constexpr int truncatedReach = 5;

/// Largest moment that a scaled series may end with. One that is cut while it is large undershoots by as much; radiances below zero are cut too, and
/// so each event would make light from nothing: 1.5 times what came in of g = 0.99 and an optical depth of 10, and more at each lower degree.
constexpr double mostAtEnd = 0.1;

/// A phase function is sharp whose moment of this degree is above this (g = 0.82). Where its series is cut it ripples away from its peak,
/// where there is little light, more than that by far: light scattered twice in the shadow was four times too bright for g = 0.9, or below
/// zero.
constexpr int sharpDegree = 8;
constexpr double sharpMoment = 0.2;
/// The same of a peak backward (g = -0.75). That is never truncated: what is cut of it at a low degree is more, and radiances below zero, which are
/// cut too, make light from nothing: 10 % in air 3 deep of g = -0.8 that absorbs nothing, over white ground.
constexpr double sharpBackward = 0.1;

/// From this moment of that degree on (g = 0.89 forward or backward) the series is also fitted beyond the peak. Of gentler peaks the ripples
/// are no larger than the light.
constexpr double fittedMoment = 0.4;

/// Factor of the Legendre moment l, where a sharp series is let fade to its end. With a power of 1 it is a Gaussian, which has no ripples at
/// all but changes low moments, and with them diffusion; 2 leaves these, and has ripples for g = 0.99. What lies between was tried on clouds,
/// dust and generated scenes (docs/sharp-peaks.md).
double fading(const int l, const int degree)
{
    constexpr double end = 0.01, power = 1.25;
    return degree > 0 ? std::pow(end, std::pow(l * (l + 1.) / (degree * (degree + 1.)), power)) : 1;
}

/// What a peak has of the moments where the series is cut, < 0 for one backward: there their signs change from each to the next. Taken for one
/// forward, it would be made sharper.
double peakAt(const std::vector<double>& moments, const int degree)
{
    const double last = moments[degree], before = degree > 0 ? moments[degree - 1] : last;
    if (last * before < 0)
        return -std::min(std::abs(last), std::abs(before));
    return std::max(0., std::min(last, before));
}

/// Of what a peak has, what truncation leaves; that takes only light forward.
double leftOf(const double peak, const double truncated)
{
    return peak > 0 ? std::max(0., (peak - truncated) / (1 - truncated)) : peak / (1 - truncated);
}

/// Legendre moment l of a share of light that goes straight on, or where negative straight back.
double momentOf(const double share, const int l) { return share < 0 && l % 2 == 0 ? -share : share; }

/// The share f of a phase function that is taken as not scattered at all. Scaling with f replaces every Legendre moment above the degree
/// by f: the best is their mean, weighted with the light that meets them, (2l + 1) |lambda_l|^3 (the power of 3 by measurement, docs/sharp-peaks.md).
/// Where moments die out fast it is little less than the first of them; a slow tail, like that of an aureole, needs much less. But what is left of
/// the series has to fade before its end, as far as the usual f, the first moment that is left out (Wiscombe 1977), lets it.
double peakShare(const std::vector<double>& moments, const int degree)
{
    double sum = 0, weights = 0;
    for (int l = degree + 1; l < static_cast<int>(moments.size()); ++l) {
        const double weight = (2 * l + 1) * std::pow(std::abs(moments[l]), 3);
        sum += weight * moments[l];
        weights += weight;
    }
    const double faded = std::min((moments[degree] - mostAtEnd) / (1 - mostAtEnd), moments[degree + 1]);
    return weights > 0 ? std::clamp(std::max(sum / weights, faded), 0., 0.999) : 0;
}

/// Scattering angles, rad, at the middles of `peakParts` equal shares of a truncated peak: of what the phase function is above its series, from the
/// forward direction to where both first meet.
///   kept     moments of the series, (1 - f) lambda'_l
///   returns  [peakParts]
std::vector<double> anglesOfPeak(const Medium& medium, const Species& species, const int w, const std::vector<double>& kept)
{
    constexpr double nearest = 1e-5, step = 1.02;
    const int degree = static_cast<int>(kept.size()) - 1;
    std::vector<double> polynomials(kept.size()), angles{0}, shares{0};
    for (double angle = nearest; angle < base::pi; angle *= step) {
        legendre(degree, std::cos(angle), polynomials.data());
        double peak = phaseFunctionAt(medium, species, angle, w);
        for (int l = 0; l <= degree; ++l)
            peak -= (2 * l + 1) / (4 * base::pi) * kept[l] * polynomials[l];
        if (!(peak > 0))
            break;
        shares.push_back(shares.back() + peak * std::sin(angle) * (angle - angles.back()));
        angles.push_back(angle);
    }
    std::vector<double> result;
    for (int part = 0; part < peakParts; ++part) {
        const double share = shares.back() * (part + 0.5) / peakParts;
        result.push_back(angles[std::lower_bound(shares.begin(), shares.end() - 1, share) - shares.begin()]);
    }
    return result;
}

} // namespace

double verticalColumn(const Medium& medium, const Species& species)
{
    double sum = 0;
    for (std::size_t k = 0; k + 1 < medium.altitudes.size(); ++k)
        sum += 0.5 * (species.numberDensity[k] + species.numberDensity[k + 1]) * (medium.altitudes[k + 1] - medium.altitudes[k]);
    return sum;
}

double horizontalColumn(const Medium& medium, const Species& species)
{
    const Planet planet{medium.planetRadius, medium.topOfAtmosphere};
    double sum = 0;
    for (std::size_t k = 0; k + 1 < medium.altitudes.size(); ++k) {
        const double way = horizonDistance(planet, medium.altitudes[k + 1]) - horizonDistance(planet, medium.altitudes[k]);
        sum += 0.5 * (species.numberDensity[k] + species.numberDensity[k + 1]) * way;
    }
    return sum;
}

std::vector<double> scatteringDepths(const Medium& medium, const Species& species)
{
    std::vector<double> depths(medium.wavelengthCount(), 0.);
    if (!species.scatters())
        return depths;
    const double column = verticalColumn(medium, species);
    for (int w = 0; w < medium.wavelengthCount(); ++w)
        depths[w] = column * species.extinctionCrossSection[w] * species.singleScatteringAlbedo[w];
    return depths;
}

Optics makeOptics(const Medium& medium, const int degree, const bool truncate)
{
    const int wavelengths = medium.wavelengthCount();
    Optics optics;
    optics.degree = degree;
    optics.species = static_cast<int>(medium.species.size());
    optics.wavelengths = wavelengths;
    optics.extinction.resize(optics.species * wavelengths);
    optics.scattering.resize(optics.species * wavelengths);
    optics.truncation.resize(optics.species * wavelengths);
    optics.blurred.resize(optics.species * wavelengths);
    optics.peakAngles.resize(optics.species * wavelengths * peakParts);
    optics.moments.resize(optics.species * (degree + 1) * wavelengths);
    std::vector<double> allDepths(wavelengths, 0.);
    std::vector<std::vector<double>> depthsOf;
    for (const auto& species : medium.species) {
        const auto& depths = depthsOf.emplace_back(scatteringDepths(medium, species));
        std::transform(depths.begin(), depths.end(), allDepths.begin(), allDepths.begin(), std::plus<>{});
    }
    for (int s = 0; s < optics.species; ++s) {
        const auto& species = medium.species[s];
        bool scatters = false;
        std::vector<double> moments;
        const auto& depths = depthsOf[s];
        const double horizontal = horizontalColumn(medium, species);
        for (int w = 0; w < wavelengths; ++w) {
            const double sigma = species.extinctionCrossSection[w];
            const double sigmaScattering = species.scatters() ? sigma * species.singleScatteringAlbedo[w] : 0;
            double f = 0, blurred = 0;
            if (sigmaScattering > 0) {
                scatters = true;
                if (w == 0 || !species.achromatic || moments.empty())
                    moments = phaseMoments(medium, species, w, std::max(degree + 1, sharpDegree));
                const bool sharp = moments[sharpDegree] > (moments[sharpDegree - 1] > 0 ? sharpMoment : sharpBackward);
                const bool matters = std::clamp(moments[degree + 1], 0., 0.999) * depths[w] > truncationMatters ||
                                     (sharp && depths[w] > hardlyAny * allDepths[w] && sigmaScattering * horizontal < scattersAgain);
                const double peak = peakAt(moments, degree);
                const int longest = truncatedReach * (degree + 1);
                if (truncate && matters && peak >= 0) {
                    if (static_cast<int>(moments.size()) <= longest)
                        moments = phaseMoments(medium, species, w, longest);
                    f = peakShare(moments, degree);
                }
                if (truncate && sharp)
                    blurred = leftOf(peak, f);
            }
            optics.truncation[s * wavelengths + w] = f;
            optics.blurred[s * wavelengths + w] = blurred;
            optics.extinction[s * wavelengths + w] = sigma - f * sigmaScattering;
            optics.scattering[s * wavelengths + w] = (1 - f) * sigmaScattering;
            if (!(sigmaScattering > 0))
                continue;
            std::vector<double> scaled(degree + 1);
            for (int l = 0; l <= degree; ++l)
                scaled[l] = (moments[l] - f) / (1 - f) - momentOf(blurred, l) * (1 - fading(l, degree));
            if (blurred != 0 && std::abs(moments[sharpDegree]) > fittedMoment)
                fitBeyondPeak(
                    scaled, [&](double angle) { return 4 * base::pi * phaseFunctionAt(medium, species, angle, w) / (1 - f); }, blurred < 0);
            for (int l = 0; l <= degree; ++l)
                optics.moments[(s * (degree + 1) + l) * wavelengths + w] = scaled[l];
            if (!(f > straightPeak))
                continue;
            std::transform(scaled.begin(), scaled.end(), scaled.begin(), [f](double moment) { return (1 - f) * moment; });
            const auto angles = anglesOfPeak(medium, species, w, scaled);
            std::copy(angles.begin(), angles.end(), &optics.peakAngles[(s * wavelengths + w) * peakParts]);
        }
        if (scatters)
            optics.scatterers.push_back(s);
    }
    return optics;
}

std::vector<double> largestExtinctions(const Optics& optics)
{
    std::vector<double> largest;
    for (int s = 0; s < optics.species; ++s) {
        const auto begin = optics.extinction.begin() + s * optics.wavelengths;
        largest.push_back(*std::max_element(begin, begin + optics.wavelengths));
    }
    return largest;
}

bool truncates(const Optics& optics)
{
    return std::any_of(optics.truncation.begin(), optics.truncation.end(), [](double f) { return f > 0; });
}

bool blurs(const Optics& optics)
{
    return std::any_of(optics.blurred.begin(), optics.blurred.end(), [](double b) { return b > 0; });
}

int bentDegree(const Optics& optics) { return std::min(optics.degree, truncates(optics) ? 10 : 4); }

int azimuthalDegree(const Optics& optics, const int event, const double negligible, const int least)
{
    double largest = 0;
    for (int m = optics.degree; m > least; --m) {
        for (const int s : optics.scatterers)
            for (int w = 0; w < optics.wavelengths; ++w)
                largest = std::max(largest, std::abs(optics.moment(s, m, w)));
        if ((2 * m + 1) * std::pow(largest, event + 1) > negligible)
            return m;
    }
    return std::min(optics.degree, least);
}

} // namespace sky::physics
