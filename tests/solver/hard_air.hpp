#pragma once
// Air in which rounding or discretisation may hurt, and how far two computed skies are apart.

#include "../montecarlo/sample_air.hpp"
#include "physics/source_iteration.hpp"
#include "solver/iterate.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sky::test {

struct HardCase {
    std::string name;
    physics::Medium medium;
    int events;
};

/// Henyey & Greenstein 1941, Astrophys. J. 93, 70.
inline double henyeyGreenstein(double g, double angle)
{
    const double s = std::sin(angle / 2); // 1 + g^2 - 2 g cos = (1 - g)^2 + 4 g s^2 keeps its digits in the peak
    return (1 - g * g) / (4 * 3.14159265358979323846 * std::pow((1 - g) * (1 - g) + 4 * g * s * s, 1.5));
}

/// One wavelength of a medium.
inline physics::Medium oneWavelength(physics::Medium medium, std::size_t w)
{
    const std::size_t count = medium.wavelengthsNm.size();
    const auto keep = [&](std::vector<double>& values) {
        std::vector<double> kept;
        for (std::size_t i = w; i < values.size(); i += count)
            kept.push_back(values[i]);
        values = kept;
    };
    for (auto* values : {&medium.wavelengthsNm, &medium.solarIrradiance, &medium.groundAlbedo})
        keep(*values);
    for (auto& species : medium.species)
        for (auto* values : {&species.extinctionCrossSection, &species.singleScatteringAlbedo, &species.phaseFunction})
            keep(*values);
    return medium;
}

/// Blue light in molecules, 1/e over `scaleHeight` (m), of vertical optical depth 0.25; a bright ground.
inline physics::Medium molecules(double planetRadius, double top, double scaleHeight)
{
    physics::Medium medium = flatLayer(1, 1, 0.3, rayleighPhase);
    medium.planetRadius = planetRadius;
    medium.topOfAtmosphere = top;
    medium.sunAngularRadius = 0.0046;
    medium.altitudes.clear();
    auto& species = medium.species.front();
    species.numberDensity.clear();
    species.extinctionCrossSection = {0.25 / scaleHeight};
    for (int i = 0; i <= 400; ++i) {
        medium.altitudes.push_back(top * i / 400);
        species.numberDensity.push_back(std::exp(-medium.altitudes.back() / scaleHeight));
    }
    return medium;
}

/// Drops between 1 and 2 km in such air on an Earth.
inline physics::Medium cloud(double opticalDepth)
{
    physics::Medium medium = molecules(6371e3, 60e3, 8e3);
    // Two edges, each between two neighbouring altitudes.
    for (const double edge : {1e3, 2e3})
        medium.altitudes.insert(medium.altitudes.end(), {edge - 0.005, edge + 0.005});
    std::sort(medium.altitudes.begin(), medium.altitudes.end());
    auto& air = medium.species.front();
    physics::Species drops = air;
    drops.name = "drops";
    air.numberDensity.clear();
    drops.numberDensity.clear();
    for (const double h : medium.altitudes) {
        air.numberDensity.push_back(std::exp(-h / 8e3));
        drops.numberDensity.push_back(h > 1e3 && h < 2e3 ? 1 : 0);
    }
    drops.extinctionCrossSection = {opticalDepth / 1e3};
    for (std::size_t k = 0; k < medium.scatteringAngles.size(); ++k)
        drops.phaseFunction[k] = henyeyGreenstein(0.85, medium.scatteringAngles[k]);
    medium.species.push_back(drops);
    return medium;
}

inline std::vector<HardCase> hardCases()
{
    const physics::Medium earth = sampleEarth(Aerosol::Yes);
    physics::Medium thin = earth, sharp = oneWavelength(earth, 1);
    for (auto& species : thin.species)
        for (double& sigma : species.extinctionCrossSection)
            sigma *= 1e-4;
    auto& haze = sharp.species[1];
    haze.extinctionCrossSection[0] *= 4;
    for (std::size_t k = 0; k < sharp.scatteringAngles.size(); ++k)
        haze.phaseFunction[k] = henyeyGreenstein(0.95, sharp.scatteringAngles[k]);
    return {{"sample Earth", earth, 3},
            {"the same, 10 000 times thinner", thin, 3},
            {"cloud of optical depth 10", cloud(10), 2},
            {"haze with g = 0.95", sharp, 2},
            {"planet of 1e10 m, 10 km of air", molecules(1e10, 10e3, 1e3), 3},
            {"planet of 100 km, 60 km of air", molecules(100e3, 60e3, 8e3), 3}};
}

/// Everything up to the iteration, and what can be seen after it.
struct World {
    const physics::Medium& medium;
    physics::MomentSettings settings;
    double fineness;
    physics::Profile profile;
    physics::Optics optics;
    physics::SunTable sun;
    physics::MomentGrid grid;

    /// \param fineness of every grid, in units of `normal`
    World(const physics::Medium& air, const physics::MomentSettings& normal, double fineness_)
        : medium(air), settings(scaled(normal, fineness_)), fineness(fineness_), profile(medium),
          optics(physics::makeOptics(medium, settings.degree, settings.truncatePeaks)),
          sun(profile, optics, medium.sunAngularRadius, scaled(56, fineness), scaled(112, fineness)),
          grid(profile, physics::largestExtinctions(optics), settings.altitudes, settings.suns, medium.sunAngularRadius)
    {
    }
    World(const World&) = delete;
    solver::Scene scene() const { return {medium, profile, optics, sun}; }

    physics::Moments onGpu(const gl::Api& api, int events) const
    {
        return solver::iterate(api, scene(), grid, settings, {events + 1, false, 0}, false, [](double) {}).total;
    }
    physics::Moments inDouble(int events) const
    {
        return physics::iterateSource(medium, profile, optics, sun, grid, settings, events, solver::sweepRefinement);
    }

    /// Radiance of the sky with such a field, [altitude][view][Sun][azimuth][wavelength]: eyes from the ground to half way up,
    /// the Sun from the zenith down to where all is dark. In double, so that what differs is the field.
    std::vector<double> seen(const physics::Moments& field) const
    {
        const physics::SkyEvaluator sky(medium, profile, optics, sun);
        physics::RayTracer tracer(profile, optics);
        std::vector<double> all, radiance(medium.wavelengthsNm.size());
        for (const double share : {0., 0.02, 0.1, 0.5})
            for (const double elevation : {-1., -0.1, 0.02, 0.2, 0.7, 1.4}) {
                const double h = share * medium.topOfAtmosphere, mu = std::sin(elevation);
                const bool ground = physics::hitsGround(profile.planet(), h, mu);
                const auto direct = tracer.trace(h, mu, scaled(96, fineness), ground),
                           later = tracer.trace(h, mu, scaled(24, fineness), ground, physics::NodesFor::Field);
                for (int s = 0; s <= 20; ++s)
                    for (const double phi : {0.5, 1.5, 2.5}) {
                        const double e = 1.5 + s / 20. * (grid.lowestElevation() - 1.5) * (2 - s / 20.);
                        const double muSun = std::sin(e), nu = mu * muSun + std::cos(elevation) * std::cos(e) * std::cos(phi);
                        std::fill(radiance.begin(), radiance.end(), 0.);
                        sky.singleAlong(direct, muSun, nu, true, radiance.data());
                        sky.multipleAlong(later, field, muSun, nu, radiance.data());
                        all.insert(all.end(), radiance.begin(), radiance.end());
                    }
            }
        return all;
    }

private:
    static int scaled(int count, double fineness) { return static_cast<int>(std::lround(count * fineness)); }
    static physics::MomentSettings scaled(physics::MomentSettings s, double fineness)
    {
        for (int* count :
             {&s.altitudes, &s.suns, &s.groundDirections, &s.limbDirections, &s.skyDirections, &s.azimuths, &s.directNodes, &s.nodes})
            *count = scaled(*count, fineness);
        return s;
    }
};

/// Relative differences of what is seen.
struct SkyDifference {
    double squares = 0, largest = 0;
    int count = 0;
    double rms() const { return count > 0 ? std::sqrt(squares / count) : 0; }
    void add(double error)
    {
        squares += error * error;
        largest = std::max(largest, std::abs(error));
        ++count;
    }
};

/// Where there is more light than 1e-4 of the brightest of all, and between 1e-4 and 1e-8 of it: day with civil twilight, and late twilight.
struct DayAndDusk {
    SkyDifference day, dusk;
    DayAndDusk(const std::vector<double>& seen, const std::vector<double>& reference)
    {
        const double brightest = *std::max_element(reference.begin(), reference.end());
        for (std::size_t i = 0; i < seen.size(); ++i)
            if (reference[i] > 1e-8 * brightest)
                (reference[i] > 1e-4 * brightest ? day : dusk).add(seen[i] / reference[i] - 1);
    }
};

} // namespace sky::test
