#include "cities.hpp"

#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/air_entry.hpp"
#include "physics/colour.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::pi;
constexpr double cityCells = 2; // of the tracer
/// Of a city's own table; azimuths from its direction, pi x^2: close where its light is.
constexpr int halfViews = 24, azimuths = 17;
constexpr int cityNodes = 14; ///< along a ray, beside those near the city
constexpr std::size_t fieldsKept = 16;
constexpr double largestRadius = 0.1; ///< of the planet's
constexpr double darkest = 1e-30;     ///< that is told from zero

/// Cosine of the angle between a direction and the axis from the planet's centre through a city.
double alongAxis(double angle, double mu, double towards) { return mu * std::cos(angle) + towards * std::sin(angle); }

double interpolated(double a, double b, double x) { return a > darkest && b > darkest ? a * std::pow(b / a, x) : a + x * (b - a); }

} // namespace

Cities::Cities(const physics::Medium& medium, std::vector<double> modelSpectrum)
    : air_(medium), modelSpectrum_(std::move(modelSpectrum)), weights_(physics::luminanceWeights(medium.wavelengthsNm))
{
}

std::string Cities::whyNot(const std::vector<City>& cities) const
{
    const double planet = air_.profile().planet().radius;
    for (const City& city : cities) {
        if (!(city.distance >= 0 && city.distance <= pi * planet) || !std::isfinite(city.azimuth))
            return "A city must stand 0 to " + std::to_string(std::lround(pi * planet / 1e3)) + " km away, in an azimuth that is a number.";
        if (!(city.radius > 0 && city.radius <= largestRadius * planet))
            return "The radius of a city must be above 0 and at most " + std::to_string(std::lround(largestRadius * planet / 1e3)) + " km.";
        if (!(city.luminance >= 0 && city.luminance <= 1e12))
            return "The luminance of a city must be a number of cd/m^2, at least 0.";
        if (city.spectrum.empty() && modelSpectrum_.empty())
            return "The model gives no spectrum of light pollution, so a city needs one of its own.";
        if (!city.spectrum.empty() && city.spectrum.size() != weights_.size())
            return "The spectrum of a city needs one value for each of the " + std::to_string(weights_.size()) + " wavelengths.";
        if (!std::all_of(city.spectrum.begin(), city.spectrum.end(), [](double v) { return std::isfinite(v) && v >= 0; }) ||
            spectrumOf(city).empty())
            return "The spectrum of a city must hold numbers, at least 0, and some of them must be visible.";
    }
    return {};
}

/// Scaled to the city's luminance; empty if that can't be done.
std::vector<double> Cities::spectrumOf(const City& city) const
{
    std::vector<double> spectrum = city.spectrum.empty() ? modelSpectrum_ : city.spectrum;
    double luminance = 0;
    for (std::size_t w = 0; w < spectrum.size(); ++w)
        luminance += spectrum[w] * weights_[w][1];
    if (!(luminance > 0))
        return {};
    for (double& value : spectrum)
        value *= city.luminance / luminance;
    return spectrum;
}

CityLight Cities::light(const std::vector<City>& cities, double altitude, const sky::base::StopRequest& stop) const
{
    CityLight result{altitude, cities, ViewTable(drawnHalfViews, cityAzimuths), {}};
    for (const City& city : cities) {
        addTo(result.air, city, altitude, stop);
        result.discs.push_back(drawn(city, altitude));
    }
    return result;
}

std::shared_ptr<const physics::CityField> Cities::field(double radius, const sky::base::StopRequest& stop) const
{
    const std::lock_guard lock(mutex_); // who asks for the same waits, who asks for others too: computing takes all cores anyway
    const double angle = radius / air_.profile().planet().radius;
    const auto found = std::find_if(fields_.begin(), fields_.end(), [&](const auto& field) { return field->discRadius() == angle; });
    if (found != fields_.end()) {
        std::rotate(found, found + 1, fields_.end());
        return fields_.back();
    }
    auto made = std::make_shared<const physics::CityField>(air_, angle, stop);
    if (fields_.size() == fieldsKept)
        fields_.erase(fields_.begin());
    fields_.push_back(std::move(made));
    return fields_.back();
}

Texel Cities::luminanceOf(const double* radiance, const std::vector<double>& spectrum) const
{
    Texel sum{};
    for (std::size_t w = 0; w < weights_.size(); ++w)
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += static_cast<float>(weights_[w][c] * radiance[w] * spectrum[w]);
    return sum;
}

void Cities::addRadiance(const std::vector<City>& cities, double altitude, const std::array<double, 3>& direction, double* result) const
{
    const auto& planet = air_.profile().planet();
    const auto entry = enterAir(planet, altitude, direction[2]);
    if (!entry)
        return;
    physics::RayTracer tracer(air_.profile(), air_.optics(), cityCells);
    const bool ground = physics::hitsGround(planet, altitude, direction[2]);
    const physics::CityColumns ray(tracer, entry->altitude, entry->mu, ground, cityNodes);
    std::vector<double> light(weights_.size());
    for (const City& city : cities) {
        const double angle = city.distance / planet.radius;
        const double nu = alongAxis(angle, direction[2], direction[0] * std::cos(city.azimuth) - direction[1] * std::sin(city.azimuth));
        const double there = std::clamp(entry->outerScale * std::cos(angle) + entry->outerShift * nu, -1., 1.);
        const bool outside = altitude > planet.topOfAtmosphere;
        const physics::CityView view{entry->altitude, entry->mu, outside ? std::acos(there) : angle, nu, ground};
        physics::cityRadiance(air_, field(city.radius).get(), city.radius / planet.radius, view, ray, true, light.data());
        const auto spectrum = spectrumOf(city);
        for (std::size_t w = 0; w < light.size(); ++w)
            result[w] += light[w] * spectrum[w];
    }
}

void Cities::addTo(ViewTable& table, const City& city, double altitude, const sky::base::StopRequest& stop) const
{
    const auto& planet = air_.profile().planet();
    const auto higher = field(city.radius, stop);
    const auto spectrum = spectrumOf(city);
    const double angle = city.distance / planet.radius;
    const bool outside = altitude > planet.topOfAtmosphere;
    ViewTable own(halfViews, azimuths);
    const auto sines = viewSines(planet, altitude, halfViews);
    sky::base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(air_.profile(), air_.optics(), cityCells);
        std::vector<double> light(weights_.size());
        for (int v = thread; v < 2 * halfViews; v += threads) {
            sky::base::stopIfAsked(stop);
            const double mu = sines[static_cast<std::size_t>(v)], flat = std::sqrt(std::max(0., 1 - mu * mu));
            const auto entry = enterAir(planet, altitude, mu);
            if (!entry)
                continue;
            const bool ground = v >= halfViews;
            const physics::CityColumns ray(tracer, entry->altitude, entry->mu, ground, cityNodes);
            for (int a = 0; a < azimuths; ++a) {
                const double x = static_cast<double>(a) / (azimuths - 1), nu = alongAxis(angle, mu, flat * std::cos(pi * x * x));
                const double there = std::clamp(entry->outerScale * std::cos(angle) + entry->outerShift * nu, -1., 1.);
                const physics::CityView view{entry->altitude, entry->mu, outside ? std::acos(there) : angle, nu, ground};
                physics::cityRadiance(air_, higher.get(), city.radius / planet.radius, view, ray, false, light.data());
                own.at(v, a) = luminanceOf(light.data(), spectrum);
            }
        }
    });
    const ViewTable finer = resampled(own, table.halfViews, azimuths);
    for (int a = 0; a < table.azimuths; ++a) {
        const double turn = 2 * pi * a / (table.azimuths - 1) - city.azimuth, from = std::abs(std::remainder(turn, 2 * pi));
        const double position = std::sqrt(from / pi) * (azimuths - 1);
        const int k = std::min(static_cast<int>(position), azimuths - 2);
        for (int v = 0; v < 2 * table.halfViews; ++v)
            for (std::size_t c = 0; c < 4; ++c)
                table.at(v, a)[c] += static_cast<float>(
                    interpolated(static_cast<double>(finer.at(v, k)[c]), static_cast<double>(finer.at(v, k + 1)[c]), position - k));
    }
}

DrawnCity Cities::drawn(const City& city, double altitude) const
{
    const auto& planet = air_.profile().planet();
    DrawnCity result{city.distance / planet.radius, city.azimuth, city.radius / planet.radius, {}};
    const auto spectrum = spectrumOf(city);
    physics::RayTracer tracer(air_.profile(), air_.optics(), cityCells);
    const double R = planet.radius, r = R + altitude;
    for (int k = 0; k < cityColourCount; ++k) {
        const double near = std::max(0., result.angle - result.radius), far = result.angle + result.radius;
        const double half = std::sin(0.5 * (near + (far - near) * k / (cityColourCount - 1)));
        // From the camera down to the ground: the elevation follows from the chord; what lies beyond the horizon isn't seen.
        const double distance = std::sqrt(altitude * altitude + 4 * R * r * half * half);
        const double mu = distance > 0 ? std::max(-1., -(altitude + 2 * R * half * half) / distance) : -1;
        const double seen = std::min(mu, std::nextafter(physics::horizonMu(planet, altitude), -2.));
        if (const auto entry = enterAir(planet, altitude, seen))
            result.colours[static_cast<std::size_t>(k)] =
                luminanceOf(tracer.seen(entry->altitude, entry->mu, true).groundTransmittance.data(), spectrum);
    }
    return result;
}

} // namespace showmysky
