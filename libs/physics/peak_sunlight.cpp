#include "physics/peak_sunlight.hpp"
#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/straighten.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;

constexpr int raysEachWay = 24, nodes = 16, positionAngles = 8;
constexpr std::size_t mostElevations = 64; // that are followed

/// What a species' truncated peak throws aside, in units of its scaled scattering. Peaks of more than `straightPeak` of its light are followed in
/// part, those of three quarters throughout.
double peakOf(const Optics& optics, const int s, const int w)
{
    constexpr double followed = 0.75;
    const double f = optics.truncation[s * optics.wavelengths + w];
    return std::clamp((f - straightPeak) / (followed - straightPeak), 0., 1.) * f / (1 - f);
}

/// Of 0 .. count - 1 at most so many, evenly, the first and the last among them, and those that are `kept`; increasing.
template<class Kept>
std::vector<std::size_t> someOf(const std::size_t count, const std::size_t most, const Kept& kept)
{
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < count; ++i)
        if (i == 0 || i + 1 == count || kept(i) || i * (most - 1) / (count - 1) != (i - 1) * (most - 1) / (count - 1))
            result.push_back(i);
    return result;
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

std::vector<std::size_t> PeakSunlight::followedAltitudes(const std::vector<double>& altitudes)
{
    constexpr std::size_t most = 48;
    const double narrow = Profile::atOnce * altitudes.back();
    return someOf(altitudes.size(), most, [&](std::size_t row) {
        const double below = altitudes[row] - altitudes[row - 1], above = altitudes[row + 1] - altitudes[row];
        // Halving steps lead up to an edge: a low Sun lights a skin below it.
        return below < narrow || above < narrow || above < 0.7 * below;
    });
}

double PeakSunlight::secondsOfRow(const Optics& optics, const double shells)
{
    constexpr double rays = 2 * raysEachWay + 1, angles = peakParts * positionAngles;
    return 7e-7 * rays * shells * optics.species +
           mostElevations * optics.wavelengths * (5.6e-9 * rays * nodes * double(optics.scatterers.size()) + 3e-8 * angles);
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

void SunTable::throwAside(const Profile& profile, const Optics& optics, const int altitudeCount, const int elevations,
                          const base::StopRequest& stop)
{
    constexpr double sliver = 0.05; // of the disc
    const std::size_t ground = altitudes_.size(), perRow = std::size_t(elevations_) * wavelengths_;
    const auto elevationAt = [&](double horizon, std::size_t k) { return horizon - sunRadius_ + aboveLowest(horizon, k); };
    std::size_t low = 0; // elevations of a low Sun, above any horizon
    while (low + 1 < std::size_t(elevations_) && elevationAt(horizon(altitudes_.back()), low) < PeakSunlight::highest)
        ++low;
    const auto rows = PeakSunlight::followedAltitudes(altitudes_),
               suns = someOf(low + 1, mostElevations, [](std::size_t k) { return k < 8; });
    const std::size_t perFollowed = (low + 1) * wavelengths_;
    std::vector<double> followed((rows.size() + 1) * perFollowed); // the ground comes last
    {
        const SunTable through(profile, PeakSunlight::unscaled(optics), sunRadius_, altitudeCount, elevations, stop);
        base::parallel([&](int thread, int threads) {
            PeakSunlight peaks(profile, optics, through, sunRadius_);
            for (std::size_t i = thread; i <= rows.size(); i += threads) {
                const double h = i < rows.size() ? altitudes_[rows[i]] : 0, horizon = this->horizon(h);
                double* const row = &followed[i * perFollowed];
                peaks.place(h, i == rows.size());
                std::size_t hidden = 0; // the last of the elevations that show less than a sliver of the disc
                for (const std::size_t k : suns) {
                    base::stopIfAsked(stop);
                    double* const depth = row + k * wavelengths_;
                    peaks.transmittance(elevationAt(horizon, k), depth);
                    const double visible = visibleDiscFraction(elevationAt(horizon, k) - horizon, sunRadius_);
                    for (int w = 0; w < wavelengths_; ++w)
                        depth[w] = depth[w] <= 0 ? opaque : std::clamp(std::log(visible / depth[w]), 0., opaque);
                    if (visible < sliver)
                        hidden = k;
                }
                // Light from higher up stays while the disc goes: depths towards a sliver of it would lift that light.
                const std::size_t shown = *std::min(std::upper_bound(suns.begin(), suns.end(), hidden), suns.end() - 1);
                if (sunRadius_ > 0)
                    for (const std::size_t k : suns)
                        if (k < shown)
                            std::copy_n(row + shown * wavelengths_, wavelengths_, row + k * wavelengths_);
                drawLines(suns, evenly(low + 1), row, wavelengths_, wavelengths_);
            }
        });
    }
    std::vector<double> thrown((ground + 1) * perFollowed);
    for (std::size_t i = 0; i <= rows.size(); ++i)
        std::copy_n(&followed[i * perFollowed], perFollowed, &thrown[(i < rows.size() ? rows[i] : ground) * perFollowed]);
    drawLines(rows, measures_, thrown.data(), perFollowed, static_cast<int>(perFollowed));
    for (std::size_t row = 0; row <= ground; ++row) {
        const double horizon = this->horizon(row < ground ? altitudes_[row] : 0);
        for (std::size_t k = 0; k <= low; ++k) {
            const double counts = std::clamp(3 * (1 - elevationAt(horizon, k) / PeakSunlight::highest), 0., 1.);
            double* const depth = &depth_[row * perRow + k * wavelengths_];
            const double* const aside = &thrown[row * perFollowed + k * wavelengths_];
            for (int w = 0; w < wavelengths_; ++w)
                depth[w] += counts * (aside[w] - depth[w]);
        }
    }
}

} // namespace sky::physics
