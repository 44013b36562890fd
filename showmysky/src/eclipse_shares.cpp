#include "eclipse_shares.hpp"

#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/air_entry.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::pi;

/// A step of the sine of the Sun's elevation, less than a radius of any Sun that is eclipsed.
constexpr double smallRise = 1e-3;

} // namespace

EclipseShares::EclipseShares(const Atmosphere& atmosphere, const physics::SunTable& sun) : atmosphere_(atmosphere), sun_(sun) {}

void EclipseShares::set(const double altitude, const double muSun, const std::vector<Texel>& weights)
{
    if (altitude != altitude_) {
        altitude_ = altitude;
        sines_ = viewSines(atmosphere_.planet(), altitude, halfViews);
        rays_.assign(2 * halfViews, Ray{});
        done_ = 0;
    }
    if (muSun != muSun_ || weights != weights_) {
        muSun_ = muSun;
        weights_ = weights;
        done_ = 0;
    }
}

bool EclipseShares::step(const int count)
{
    const int first = done_, end = std::min(static_cast<int>(rays_.size()), first + count);
    sky::base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(atmosphere_.profile, atmosphere_.optics, 2);
        for (int r = first + thread; r < end; r += threads) {
            Ray& ray = rays_[static_cast<std::size_t>(r)];
            if (ray.distance.empty())
                trace(r, tracer);
            if (ray.lit)
                shine(ray, sines_[static_cast<std::size_t>(r)]);
        }
    });
    done_ = end;
    if (done_ < static_cast<int>(rays_.size()))
        return false;
    reach_ = 0;
    for (const Ray& ray : rays_)
        for (const float distance : ray.distance)
            reach_ = std::max(reach_, static_cast<double>(distance));
    return true;
}

void EclipseShares::trace(const int index, physics::RayTracer& tracer)
{
    Ray& ray = rays_[static_cast<std::size_t>(index)];
    ray.distance.assign(nodes, 0.f);
    const auto entry = enterAir(atmosphere_.planet(), altitude_, sines_[static_cast<std::size_t>(index)]);
    if (!entry)
        return;
    ray.lit = true;
    const auto traced = tracer.trace(entry->altitude, entry->mu, nodes, index >= halfViews);
    const double r = atmosphere_.planet().radius + altitude_;
    ray.places.clear();
    for (std::size_t k = 0; k < traced.nodes.size(); ++k) {
        ray.places.push_back(entry->node(traced.nodes[k]));
        ray.distance[k] = static_cast<float>(r * ray.places[k].nuScale / ray.places[k].sunScale);
    }
    ray.weights.assign(traced.weights.begin(), traced.weights.end());
}

void EclipseShares::shine(Ray& ray, const double mu) const
{
    const auto scatterers = static_cast<std::size_t>(atmosphere_.scatterers());
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    ray.light.assign(static_cast<std::size_t>(azimuths * nodes) * scatterers, Texel{});
    ray.rising.assign(static_cast<std::size_t>(azimuths * nodes), Texel{});
    std::vector<double> light(wavelengths), lifted(wavelengths);
    const double sines = std::sqrt(std::max(0., (1 - mu * mu) * (1 - muSun_ * muSun_)));
    for (std::size_t a = 0; a < azimuths; ++a) {
        const double nu = std::clamp(mu * muSun_ + sines * std::cos(pi * static_cast<double>(a) / (azimuths - 1)), -1., 1.);
        for (std::size_t k = 0; k < nodes; ++k) {
            const auto& place = ray.places[k];
            const double muSun = std::clamp(place.sunScale * muSun_ + place.nuScale * nu, -1., 1.);
            sun_.transmittance(place.altitude, muSun, light.data());
            sun_.transmittance(place.altitude, muSun, lifted.data(), smallRise);
            Texel before{}, after{};
            for (std::size_t i = 0; i < scatterers; ++i) {
                Texel& sum = ray.light[(a * nodes + k) * scatterers + i];
                const float* weight = &ray.weights[(k * scatterers + i) * wavelengths];
                for (std::size_t w = 0; w < wavelengths; ++w) {
                    const float seen = weight[w] * static_cast<float>(light[w]), more = weight[w] * static_cast<float>(lifted[w]);
                    for (std::size_t c = 0; c < 4; ++c) {
                        sum[c] += weights_[w][c] * seen;
                        after[c] += weights_[w][c] * more;
                    }
                }
                for (std::size_t c = 0; c < 4; ++c)
                    before[c] += sum[c];
            }
            for (std::size_t c = 0; c < 4; ++c)
                if (before[c] > 0)
                    ray.rising[a * nodes + k][c] = static_cast<float>(std::log(static_cast<double>(after[c] / before[c])) / smallRise);
        }
    }
}

void EclipseShares::line(const double mu, const double coordinate, const int half, Line& result) const
{
    const double position = std::clamp(coordinate, 0., 1.) * (halfViews - 1);
    const int k = std::min(static_cast<int>(position), halfViews - 2);
    auto share = static_cast<float>(position - k);
    const Ray *near = &rays_[static_cast<std::size_t>(half * halfViews + k)], *far = near + 1;
    // From above the air some rays miss it.
    if (!near->lit)
        near = far;
    if (!far->lit)
        far = near;
    result.lit = near->lit;
    if (!result.lit)
        return;
    result.distance.resize(nodes);
    result.ahead.resize(nodes);
    result.up.resize(nodes);
    const auto r = static_cast<float>(atmosphere_.planet().radius + altitude_), vertical = static_cast<float>(mu);
    for (std::size_t i = 0; i < nodes; ++i) {
        const float distance = near->distance[i] + share * (far->distance[i] - near->distance[i]);
        // A node seen from the planet's centre.
        const float height = r + distance * vertical, radius = std::sqrt(height * height + distance * distance * (1 - vertical * vertical));
        result.distance[i] = distance;
        result.ahead[i] = distance / radius;
        result.up[i] = height / radius;
    }
    const auto between = [share](const std::vector<Texel>& a, const std::vector<Texel>& b, std::vector<Texel>& values) {
        values.resize(a.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                values[i][c] = a[i][c] + share * (b[i][c] - a[i][c]);
    };
    between(near->light, far->light, result.light);
    between(near->rising, far->rising, result.rising);
}

} // namespace showmysky
