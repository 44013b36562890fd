#include "montecarlo/air.hpp"

#include <algorithm>
#include <cmath>

namespace sky::montecarlo {
namespace {

constexpr int guideCosines = 1024;
constexpr std::size_t altitudeBins = 4096;

} // namespace

Guide::Guide(const Profile& profile)
{
    for (int shell = 0; shell < profile.shellCount(); ++shell) {
        const Place place{profile.middleAltitude(shell), {0, 0, 1}};
        for (int i = 0; i < guideCosines; ++i) {
            const double mu = (2 * i + 1.0) / guideCosines - 1;
            const Ray ray = rayFrom(profile.planetRadius(), place, {std::sqrt(1 - mu * mu), 0, mu});
            const double t = ray.hitsGround() ? 0 : std::exp(-profile.opticalDepthToSpace(ray));
            transmittance_.push_back(static_cast<float>(t));
        }
    }
}

double Guide::operator()(int shell, double muSun) const
{
    const int i = std::clamp(static_cast<int>((muSun + 1) * (guideCosines / 2)), 0, guideCosines - 1);
    return static_cast<double>(transmittance_[static_cast<std::size_t>(shell * guideCosines + i)]);
}

Air::Air(const physics::Medium& medium, int wavelength)
    : profile_(medium, wavelength), guide_(profile_), groundAlbedo_(medium.groundAlbedo[wavelength]),
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
