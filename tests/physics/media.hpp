#pragma once
// Media of the tests, beside those of the Monte Carlo tables (tests/montecarlo/sample_air.hpp): small, from formulas.

#include "../montecarlo/sample_air.hpp"
#include "base/angles.hpp"
#include "physics/medium.hpp"
#include <cmath>
#include <functional>

namespace sky::test {

using sky::base::pi;

/// sr^-1; source: Henyey & Greenstein 1941.
inline double henyeyGreenstein(double g, double angle)
{
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * std::cos(angle), 1.5));
}

/// flatLayer bent to a planet's radius; 1 km thick unless `top` says otherwise, point-like Sun.
inline physics::Medium layer(double opticalDepth, double singleScatteringAlbedo, double groundAlbedo,
                             const std::function<double(double)>& phase, double radius = 6.4e9, double top = 1000)
{
    physics::Medium medium = flatLayer(opticalDepth, singleScatteringAlbedo, groundAlbedo, phase);
    medium.planetRadius = radius;
    medium.topOfAtmosphere = top;
    medium.altitudes = {0, top};
    medium.species[0].extinctionCrossSection = {opticalDepth / top};
    return medium;
}

/// Other densities for the only species of a medium, at other altitudes.
inline physics::Medium withDensity(physics::Medium medium, std::vector<double> altitudes, std::vector<double> densities)
{
    medium.altitudes = std::move(altitudes);
    medium.topOfAtmosphere = medium.altitudes.back();
    medium.species[0].numberDensity = std::move(densities);
    return medium;
}

/// Molecules alone: exp(-h / 8 km) to 120 km over an Earth, vertical optical depth as given, isotropic unless told.
inline physics::Medium exponentialAir(double opticalDepth, double groundAlbedo = 0,
                                      const std::function<double(double)>& phase = isotropicPhase)
{
    auto medium = withDensity(flatLayer(1, 1, groundAlbedo, phase), {0, 120e3}, {1, std::exp(-15.)});
    medium.planetRadius = 6.371e6;
    medium.species[0].extinctionCrossSection = {opticalDepth / (8e3 * (1 - std::exp(-15.)))};
    return medium;
}

/// Haze alone: exp(-h / 1 km) to 20 km over an Earth: a profile without a node inside. Isotropic.
inline physics::Medium haze(double opticalDepth)
{
    auto medium = withDensity(layer(1, 1, 0, isotropicPhase, 6.371e6), {0, 20e3}, {1, std::exp(-20.)});
    medium.sunAngularRadius = 0.00465;
    medium.species[0].extinctionCrossSection = {opticalDepth / 1e3};
    return medium;
}

/// Scene 7 of seed 12 of docs/stress.md at one wavelength: g = 0.99, a scale height of 3.3 km over a planet of two million km, 4 deep.
inline physics::Medium flatShell()
{
    const double height = 3.3e3, top = 31e3;
    physics::Medium medium = layer(
        1, 1, 0, [](double angle) { return henyeyGreenstein(0.99, angle); }, 1.9e9, top);
    medium.species[0].numberDensity = {1, std::exp(-top / height)};
    medium.species[0].extinctionCrossSection = {4 / height};
    medium.sunAngularRadius = 0.00465;
    return medium;
}

} // namespace sky::test
