#include "physics/peak_sunlight.hpp"
#include "base/angles.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

constexpr int raysEachWay = 24, nodes = 16, positionAngles = 8;

/// What a species' truncated peak throws aside, in units of its scaled scattering. Peaks of less than half of its light go straight on, those of
/// three quarters are followed.
double peakOf(const Optics& optics, const int s, const int w)
{
    const double f = optics.truncation[s * optics.wavelengths + w];
    return std::clamp(4 * f - 2, 0., 1.) * f / (1 - f);
}

} // namespace

Optics PeakSunlight::unscaled(Optics optics)
{
    for (int s = 0; s < optics.species; ++s)
        for (int w = 0; w < optics.wavelengths; ++w)
            if (const double peak = peakOf(optics, s, w); peak > 0) {
                optics.extinction[s * optics.wavelengths + w] += peak * optics.scattering[s * optics.wavelengths + w];
                optics.truncation[s * optics.wavelengths + w] = 0;
            }
    return optics;
}

bool PeakSunlight::matters(const Profile& profile, const Optics& optics)
{
    constexpr double little = 0.1; // optical depth
    const Optics met = unscaled(optics);
    if (met.truncation == optics.truncation)
        return false;
    RayTracer tracer(profile, optics, 2);
    std::vector<double> columns(optics.species);
    for (const double altitude : profile.shells()) {
        tracer.columns(altitude, 0, columns.data());
        for (int w = 0; w < optics.wavelengths; ++w) {
            double depth = 0; // of events in peaks
            for (int s = 0, at = w; s < optics.species; ++s, at += optics.wavelengths)
                depth += columns[s] * (met.extinction[at] - optics.extinction[at]);
            if (depth > little)
                return true;
        }
    }
    return false;
}

PeakSunlight::PeakSunlight(const Profile& profile, const Optics& optics, const SunTable& unscaled, const double sunRadius)
    : profile_(profile), optics_(optics), unscaled_(unscaled), sunRadius_(sunRadius), tracer_(profile, optics, 2), lit_(optics.wavelengths)
{
    for (std::size_t i = 0; i < optics.scatterers.size(); ++i) {
        bool throws = false;
        for (int w = 0; w < optics.wavelengths; ++w)
            if (const int s = optics.scatterers[i]; peakOf(optics, s, w) > 0) {
                throws = true;
                widest_ = std::max(widest_, optics.peakAngles[(s * optics.wavelengths + w) * peakParts + peakParts - 1]);
            }
        if (throws)
            throwers_.push_back(i);
    }
}

void PeakSunlight::place(const double altitude, const bool levelGround)
{
    altitude_ = altitude;
    levelGround_ = levelGround;
    rays_.clear();
    elevations_.clear();
    // From where peaks send light of the lowest Sun to where of the highest that is low. Ways through a shell differ most near the horizontal.
    const double furthest = std::max(highest, sunRadius_ - unscaled_.horizon(altitude)) + widest_;
    const double range = std::min(pi / 2, furthest), scale = unscaled_.elevationScale() / 3, length = std::asinh(range / scale);
    for (int i = -raysEachWay; i <= raysEachWay; ++i)
        elevations_.push_back(scale * std::sinh(length * i / raysEachWay));
    for (const double elevation : elevations_) {
        const double mu = std::sin(elevation);
        rays_.push_back(tracer_.trace(altitude, mu, nodes, hitsGround(profile_.planet(), altitude, mu)));
    }
}

void PeakSunlight::transmittance(const double elevation, double* const result)
{
    const double muSun = std::sin(elevation), cosine = std::max(1e-9, horizontalSunCosine(muSun, sunRadius_));
    if (levelGround_) {
        unscaled_.groundIrradiance(muSun, result);
        std::for_each(result, result + optics_.wavelengths, [&](double& light) { light /= cosine; });
    } else {
        unscaled_.transmittance(altitude_, muSun, result);
    }
    scatterAlongRays(elevation);
    if (levelGround_)
        for (std::size_t r = 0; r < rays_.size(); ++r)
            std::for_each(lightOf(r), lightOf(r) + perRay(),
                          [&](double& light) { light *= std::max(0., std::sin(elevations_[r])) / cosine; });
    addPeaks(elevation, result);
}

void PeakSunlight::scatterAlongRays(const double elevation)
{
    const double muSun = std::sin(elevation);
    scattered_.assign(rays_.size() * perRay(), 0.);
    for (std::size_t r = 0; r < rays_.size(); ++r) {
        if (elevations_[std::min(r + 1, rays_.size() - 1)] < elevation - widest_ || elevations_[r > 0 ? r - 1 : 0] > elevation + widest_)
            continue;
        const double nu = std::cos(elevations_[r] - elevation);
        const double* weights = rays_[r].weights.data(); // of a node
        for (const auto& node : rays_[r].nodes) {
            unscaled_.transmittance(node.altitude, node.sunScale * muSun + node.nuScale * nu, lit_.data());
            double* light = lightOf(r);
            for (const std::size_t i : throwers_)
                for (int w = 0; w < optics_.wavelengths; ++w)
                    *light++ += weights[i * optics_.wavelengths + w] * lit_[w];
            weights += optics_.scatterers.size() * optics_.wavelengths;
        }
    }
}

void PeakSunlight::addPeaks(const double elevation, double* const result)
{
    const int wavelengths = optics_.wavelengths;
    for (std::size_t i = 0; i < throwers_.size(); ++i)
        for (int w = 0; w < wavelengths; ++w) {
            const int s = optics_.scatterers[throwers_[i]];
            const double peak = peakOf(optics_, s, w);
            if (!(peak > 0))
                continue;
            const double* const angles = &optics_.peakAngles[(s * wavelengths + w) * peakParts];
            double sum = 0;
            for (int part = 0; part < peakParts; ++part)
                for (int p = 0; p < positionAngles; ++p) {
                    const double from = elevation + angles[part] * std::sin(pi * ((p + 0.5) / positionAngles - 0.5));
                    const auto above = std::clamp<std::ptrdiff_t>(
                        std::upper_bound(elevations_.begin(), elevations_.end(), from) - elevations_.begin(), 1, elevations_.size() - 1);
                    const double x = std::clamp((from - elevations_[above - 1]) / (elevations_[above] - elevations_[above - 1]), 0., 1.);
                    sum += (1 - x) * lightOf(above - 1)[i * wavelengths + w] + x * lightOf(above)[i * wavelengths + w];
                }
            result[w] += peak * sum / (peakParts * positionAngles);
        }
}

} // namespace sky::physics
