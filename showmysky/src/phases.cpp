#include "phases.hpp"

#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace {

using sky::base::pi;

/// Angles are spread by their cube root over 0..1.
double angleAt(double u) { return pi * u * u * u; }
/// Angles at which the depths of an aureole are followed; at two degrees they are half a degree apart.
constexpr int depthNodes = 33;

} // namespace

Phases::Phases(const Atmosphere& atmosphere) : atmosphere_(atmosphere)
{
    double sum = 0;
    for (const auto& weight : atmosphere.luminanceWeights({})) {
        shares_.push_back(static_cast<double>(weight[1]) + 1e-30);
        sum += shares_.back();
    }
    for (double& share : shares_)
        share /= sum;
    constantRatios_.resize(static_cast<std::size_t>(atmosphere.scatterers()));
    for (int i = 0; i < atmosphere.scatterers(); ++i) {
        const auto species = static_cast<std::size_t>(atmosphere.optics.scatterers[static_cast<std::size_t>(i)]);
        if (!atmosphere.medium.species[species].achromatic)
            continue;
        std::vector<double> ratio(shares_.size());
        this->ratio(i, 0, ratio.data());
        constantRatios_[static_cast<std::size_t>(i)] = ratio;
    }
}

void Phases::look(const double altitude, const double muSun)
{
    if (!atmosphere_.aureole.any() || looked_ == std::pair(altitude, muSun))
        return;
    looked_ = {altitude, muSun};
    sky::physics::RayTracer tracer(atmosphere_.profile, atmosphere_.optics, 2);
    std::vector<std::vector<double>> depths;
    for (int k = 0; k < depthNodes; ++k)
        depths.push_back(atmosphere_.aureole.depths(tracer, altitude, muSun, angleAt(double(k) / (depthNodes - 1))));
    version_ += depths != peakDepths_;
    peakDepths_ = std::move(depths);
}

void Phases::exact(int scatterer, double theta, double* result) const
{
    const auto species = static_cast<std::size_t>(atmosphere_.optics.scatterers[static_cast<std::size_t>(scatterer)]);
    sky::physics::phaseFunctionAt(atmosphere_.medium, atmosphere_.medium.species[species], theta, result);
    if (peakDepths_.empty())
        return;
    const double place = std::cbrt(theta / pi) * (depthNodes - 1);
    const auto k = static_cast<std::size_t>(std::clamp(place, 0., depthNodes - 2.));
    std::vector<double> depths(shares_.size());
    for (std::size_t w = 0; w < depths.size(); ++w)
        depths[w] = peakDepths_[k][w] + (place - static_cast<double>(k)) * (peakDepths_[k + 1][w] - peakDepths_[k][w]);
    atmosphere_.aureole.multiply(static_cast<int>(species), theta, depths, result);
}

double Phases::drawn(int scatterer, double nu) const
{
    std::vector<double> values(shares_.size());
    exact(scatterer, std::acos(std::clamp(nu, -1., 1.)), values.data());
    double mean = 0;
    for (std::size_t w = 0; w < shares_.size(); ++w)
        mean += shares_[w] * values[w];
    return mean;
}

void Phases::ratio(int scatterer, double nu, double* result) const
{
    const auto& constant = constantRatios_[static_cast<std::size_t>(scatterer)];
    if (!constant.empty()) {
        std::copy(constant.begin(), constant.end(), result);
        return;
    }
    exact(scatterer, std::acos(std::clamp(nu, -1., 1.)), result);
    double mean = 0;
    for (std::size_t w = 0; w < shares_.size(); ++w)
        mean += shares_[w] * result[w];
    for (std::size_t w = 0; w < shares_.size(); ++w)
        result[w] = mean > 0 ? result[w] / mean : 1;
}

std::vector<Texel> Phases::texels(int width) const
{
    const int scatterers = atmosphere_.scatterers(), rows = std::max(1, (scatterers + 3) / 4);
    std::vector<Texel> result(static_cast<std::size_t>(rows * width), Texel{});
    std::vector<double> values(shares_.size());
    for (int i = 0; i < scatterers; ++i)
        for (int x = 0; x < width; ++x) {
            exact(i, angleAt(static_cast<double>(x) / (width - 1)), values.data());
            double mean = 0;
            for (std::size_t w = 0; w < shares_.size(); ++w)
                mean += shares_[w] * values[w];
            result[static_cast<std::size_t>(i / 4 * width + x)][static_cast<std::size_t>(i % 4)] = static_cast<float>(std::pow(mean, 0.25));
        }
    return result;
}

} // namespace showmysky
