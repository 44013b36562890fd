#include "physics/aureole.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/air_entry.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

/// Nodes of depth, F = shallow (2^(j / octave) - 1): from no peaks to those through which nobody sees the Sun.
constexpr double shallow = 0.25;
constexpr int octave = 2, depthNodes = 8 * octave + 1;
double depthNode(const int j) { return shallow * (std::exp2(double(j) / octave) - 1); }
double depthPlace(const double depth) { return std::clamp(octave * std::log2(1 + depth / shallow), 0., depthNodes - 1.); }

/// A peak is followed to the first moment as small as this, or to the degree that resolves a third of the Sun's radius.
constexpr double negligible = 3e-3;
constexpr int longest = 2048;

/// Where a series fades before its end, its peak has moments above 1 there. Only light of a Sun that nobody sees makes more of them than this.
constexpr double mostGrowth = 3;

/// Moment of light that the peak scatters at least twice, exp(-F) (exp(F q) - 1 - F q) / F.
double scatteredAgain(const double depth, const double q)
{
    if (depth * std::max(1., std::abs(q)) < 1e-3)
        return depth * q * q / 2;
    return (std::exp(std::min(mostGrowth, depth * (q - 1))) - std::exp(-depth) * (1 + depth * q)) / depth;
}

/// How much of an aureole counts at an angle: from twice what the degree resolves on, where no peak reaches, ripples of its cut series are left,
/// through which deep air is dark or several times too bright.
double counting(const double angle, const int degree)
{
    const double reach = 2 * pi / (degree + 1);
    return std::clamp(2 - angle / reach, 0., 1.);
}

/// Legendre moments of a phase function as far as they matter.
std::vector<double> momentsOf(const Medium& medium, const Species& species, const int wavelength, const int degree, const double f)
{
    std::vector<double> moments;
    const auto small = [&](double moment) { return std::abs(moment) < negligible * f; };
    for (int last = 2 * degree + 2;; last *= 2) {
        moments = phaseMoments(medium, species, wavelength, std::min(last, longest));
        const auto end = std::find_if(moments.begin() + degree + 1, moments.end(), small);
        if (end != moments.end() || last >= longest) {
            moments.erase(end, moments.end());
            return moments;
        }
    }
}

} // namespace

Aureole::Aureole(const Medium& medium, const Optics& optics)
    : planet_{medium.planetRadius, medium.topOfAtmosphere}, wavelengths_(optics.wavelengths), angles_(medium.scatteringAngles),
      peaks_(optics.truncation.size()), tableOf_(optics.truncation.size(), -1)
{
    std::vector<int> first; // of each table, species and wavelength
    for (int s = 0; s < optics.species; ++s)
        for (int w = 0; w < wavelengths_; ++w) {
            const int at = s * wavelengths_ + w;
            const double f = optics.truncation[at];
            peaks_[at] = f / (1 - f) * optics.scattering[at];
            if (!(f > 0))
                continue;
            const int before = w > 0 ? tableOf_[at - 1] : -1;
            const bool same = medium.species[s].achromatic && before >= 0;
            tableOf_[at] = same ? before : static_cast<int>(first.size());
            if (!same)
                first.push_back(at);
        }
    tables_.resize(first.size());
    base::parallel([&](int thread, int threads) {
        for (std::size_t t = thread; t < tables_.size(); t += threads)
            tabulate(medium, optics, first[t] / wavelengths_, first[t] % wavelengths_, tables_[t]);
    });
}

void Aureole::tabulate(const Medium& medium, const Optics& optics, const int s, const int w, std::vector<float>& table) const
{
    const auto& species = medium.species[s];
    const double f = optics.truncation[s * wavelengths_ + w];
    const auto moments = momentsOf(medium, species, w, optics.degree, f);
    const int count = static_cast<int>(moments.size());
    std::vector<double> kept(count, 0.), again(count * depthNodes), polynomials(count); // [l], [l][depth]
    for (int l = 0; l < count; ++l) {
        kept[l] = l <= optics.degree ? (1 - f) * optics.moment(s, l, w) : 0;
        for (int j = 0; j < depthNodes; ++j)
            again[l * depthNodes + j] = f * scatteredAgain(depthNode(j), (moments[l] - kept[l]) / f);
    }
    const std::size_t angles = angles_.size();
    table.resize(depthNodes * angles);
    for (std::size_t a = 0; a < angles; ++a) {
        legendre(count - 1, std::cos(angles_[a]), polynomials.data());
        double smooth = 0;
        std::array<double, depthNodes> sums{};
        for (int l = 0; l < count; ++l) {
            const double term = (2 * l + 1) / (4 * pi) * polynomials[l];
            smooth += term * kept[l];
            for (int j = 0; j < depthNodes; ++j)
                sums[j] += term * again[l * depthNodes + j];
        }
        const double exact = phaseFunctionAt(medium, species, angles_[a], w), reach = counting(angles_[a], optics.degree);
        for (int j = 0; j < depthNodes; ++j) {
            const double seen = smooth + std::exp(-depthNode(j)) * (exact - smooth) + sums[j];
            table[j * angles + a] = static_cast<float>(exact > 0 ? reach * std::log(std::clamp(seen / exact, 1e-6, 1e6)) : 0.);
        }
    }
}

std::vector<double> Aureole::depths(RayTracer& tracer, const double altitude, const double muSun, const double theta) const
{
    std::vector<double> columns, result;
    depths(tracer, altitude, muSun, theta, columns, result);
    return result;
}

void Aureole::depths(RayTracer& tracer, const double altitude, const double muSun, const double theta, std::vector<double>& columns,
                     std::vector<double>& result) const
{
    if (!any()) {
        result.clear();
        return;
    }
    result.assign(wavelengths_, 0.);
    const double highest = std::asin(std::clamp(muSun, -1., 1.)) + theta;
    const auto entry = enterAir(planet_, altitude, std::max(std::sin(std::min(pi / 2, highest)), horizonMu(planet_, altitude)));
    if (!entry)
        return;
    const std::size_t species = peaks_.size() / wavelengths_;
    columns.resize(species);
    tracer.columns(entry->altitude, std::max(entry->mu, horizonMu(planet_, entry->altitude)), columns.data());
    for (std::size_t s = 0; s < species; ++s)
        for (int w = 0; w < wavelengths_; ++w)
            result[w] += columns[s] * peaks_[s * wavelengths_ + w];
}

void Aureole::multiply(const int species, const double theta, const std::vector<double>& depths, double* const phase) const
{
    if (depths.empty())
        return;
    const auto above = std::upper_bound(angles_.begin(), angles_.end(), theta) - angles_.begin();
    const auto angle = std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(angles_.size()) - 1) - 1;
    const double x = std::clamp((theta - angles_[angle]) / (angles_[angle + 1] - angles_[angle]), 0., 1.);
    for (int w = 0; w < wavelengths_; ++w) {
        const int table = tableOf_[species * wavelengths_ + w];
        if (table < 0)
            continue;
        const double place = depthPlace(depths[w]);
        const int node = std::min(static_cast<int>(place), depthNodes - 2);
        const float* const low = &tables_[table][node * angles_.size() + angle];
        const float* const high = low + angles_.size();
        const auto between = [x](const float* values) { return (1 - x) * double(values[0]) + x * double(values[1]); };
        const double y = place - node;
        phase[w] *= std::exp((1 - y) * between(low) + y * between(high));
    }
}

} // namespace sky::physics
