#include "montecarlo/air.hpp"

#include <algorithm>
#include <cmath>

namespace sky::montecarlo {
namespace {

constexpr double finest = 1e-6; // sine of an elevation
constexpr int strips = 7;       // of the Sun's disc
constexpr std::size_t altitudeBins = 4096;
constexpr int samplesPerShell = 8;

} // namespace

Guide::Guide(const Profile& profile, const double sunAngularRadius) : bins_(finest, -2, 2)
{
    const double radius = profile.planetRadius();
    std::vector<double> point(static_cast<std::size_t>(bins_.count()));
    for (int shell = 0; shell < profile.shellCount(); ++shell) {
        const Place place{profile.middleAltitude(shell), {0, 0, 1}};
        const double horizon = std::sqrt(radialSquare(radius, place.altitude)) / (radius + place.altitude);
        for (int i = 0; i < bins_.count(); ++i) {
            const double aboveHorizon = bins_.middle(i), mu = std::min(1., aboveHorizon - horizon);
            const Ray ray = rayFrom(radius, place, {std::sqrt(1 - mu * mu), 0, mu});
            point[static_cast<std::size_t>(i)] = aboveHorizon > 0 ? std::exp(-profile.opticalDepthToSpace(ray)) : 0;
        }
        for (int i = 0; i < bins_.count(); ++i) {
            double sum = 0, weights = 0;
            for (int strip = 0; strip < strips; ++strip) {
                const double across = (2. * strip + 1) / strips - 1, chord = std::sqrt(1 - across * across);
                sum += chord * point[static_cast<std::size_t>(bins_.of(bins_.middle(i) + across * std::sin(sunAngularRadius)))];
                weights += chord;
            }
            transmittance_.push_back(sum / weights);
        }
    }
}

Air::Air(const physics::Medium& medium, int wavelength)
    : profile_(medium, wavelength), guide_(profile_, medium.sunAngularRadius), groundAlbedo_(medium.groundAlbedo[wavelength]),
      sunAngularRadius_(medium.sunAngularRadius), altitudes_(medium.altitudes)
{
    for (const physics::Species& species : medium.species) {
        Kind kind;
        kind.density = species.numberDensity;
        for (const double n : kind.density)
            kind.logDensity.push_back(n > 0 ? std::log(n) : 0);
        kind.extinction = species.extinctionCrossSection[wavelength];
        kind.scattering = kind.extinction * species.singleScatteringAlbedo[wavelength];
        kind.scatters = species.scatters() && kind.scattering > 0;
        if (kind.scatters) {
            std::vector<double> values;
            for (std::size_t i = 0; i < medium.scatteringAngles.size(); ++i)
                values.push_back(species.phaseFunction[i * medium.wavelengthsNm.size() + static_cast<std::size_t>(wavelength)]);
            phases_.emplace_back(medium.scatteringAngles, values);
        }
        kinds_.push_back(std::move(kind));
    }
    for (std::size_t bin = 0; bin <= altitudeBins; ++bin) {
        const double altitude = medium.topOfAtmosphere * static_cast<double>(bin) / altitudeBins;
        const auto after = std::upper_bound(altitudes_.begin() + 1, altitudes_.end() - 1, altitude);
        guideToInterval_.push_back(static_cast<std::size_t>(after - altitudes_.begin()) - 1);
    }
    for (int shell = 0; shell < profile_.shellCount(); ++shell) {
        const auto [low, high] = profile_.altitudesOf(shell);
        double bright = 0, extinction = 0;
        Local local;
        for (int i = 0; i < samplesPerShell; ++i) {
            at(low + (high - low) * (i + 0.5) / samplesPerShell, local);
            bright += local.bright;
            extinction += local.extinction;
        }
        scatteredShare_.push_back(extinction > 0 ? bright / extinction : 0);
    }
}

const Glow& Air::glow() const
{
    std::call_once(glowOnce_, [this] { glow_ = std::make_unique<Glow>(*this); });
    return *glow_;
}

void Air::at(double altitude, Local& local) const
{
    const double bins = static_cast<double>(altitudeBins);
    const auto bin = static_cast<std::size_t>(std::clamp(altitude / profile_.topOfAtmosphere() * bins, 0.0, bins - 1));
    std::size_t i = guideToInterval_[bin];
    while (i + 2 < altitudes_.size() && altitudes_[i + 1] <= altitude)
        ++i;
    const double t = std::clamp((altitude - altitudes_[i]) / (altitudes_[i + 1] - altitudes_[i]), 0.0, 1.0);
    local.extinction = local.bright = 0;
    local.scattering.clear();
    for (const Kind& kind : kinds_) {
        const double n = kind.density[i] > 0 && kind.density[i + 1] > 0
                             ? std::exp(kind.logDensity[i] + t * (kind.logDensity[i + 1] - kind.logDensity[i]))
                             : kind.density[i] + t * (kind.density[i + 1] - kind.density[i]);
        local.extinction += n * kind.extinction;
        if (kind.scatters) {
            local.bright += n * kind.scattering * phases_[local.scattering.size()].integral();
            local.scattering.push_back(n * kind.scattering);
        }
    }
}

double Air::scatteredAt(const Local& local, double angle) const
{
    double sum = 0;
    for (std::size_t i = 0; i < phases_.size(); ++i)
        if (local.scattering[i] > 0)
            sum += local.scattering[i] * phases_[i].value(angle);
    return sum;
}

double Air::transmittance(const Place& place, Vec direction) const
{
    const Ray ray = rayFrom(profile_.planetRadius(), place, direction);
    return ray.hitsGround() ? 0 : std::exp(-profile_.opticalDepthToSpace(ray));
}

} // namespace sky::montecarlo
