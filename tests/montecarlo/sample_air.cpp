#include "sample_air.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sky::test {
namespace {

using std::numbers::pi;

/// 0, then 1e-5 .. pi with a constant ratio up to about 0.1 rad and a constant step above.
std::vector<double> sampleAngles()
{
    std::vector<double> angles{0};
    for (double a = 1e-5; a < pi - 0.5e-3; a += std::min(0.01 * a, 1e-3))
        angles.push_back(a);
    angles.push_back(pi);
    return angles;
}

std::vector<double> tabulated(const std::vector<double>& nodes, const std::function<double(double)>& f)
{
    std::vector<double> values;
    for (const double x : nodes)
        values.push_back(f(x));
    return values;
}

/// The same phase function at every wavelength.
std::vector<double> achromatic(const std::vector<double>& angles, std::size_t wavelengths, const std::function<double(double)>& f)
{
    std::vector<double> values;
    for (const double angle : angles)
        values.insert(values.end(), wavelengths, f(angle));
    return values;
}

physics::Species named(const char* name)
{
    physics::Species species;
    species.name = name;
    return species;
}

double ozoneShape(double altitude)
{
    const double z = altitude / 1000;
    if (z < 8)
        return 7.2402403521159135e-6 - 1.206527437798165e-7 * z;
    if (z < 21.5)
        return -2.0590185333577628e-5 + 3.3581504669318765e-6 * z;
    if (z < 39)
        return 1.0542813563268143e-4 - 2.50316678731273e-6 * z;
    return 0.04298160111157969 * std::exp(-0.2208669270720561 * z);
}

double aerosolPhase(double angle)
{
    const double g = 0.76, k = 3 / (8 * pi) * (1 - g * g) / (2 + g * g), c = std::cos(angle);
    const double s = std::sin(angle / 2), oneMinusC = 2 * s * s;
    return 0.904 * (k * (1 + c * c) / std::pow(1 + g * g - 2 * g * c, 1.5) + 1 / (600 * oneMinusC + 0.05));
}

} // namespace

double isotropicPhase(double) { return 1 / (4 * pi); }
double rayleighPhase(double angle) { return 3 / (16 * pi) * (1 + std::cos(angle) * std::cos(angle)); }

physics::Medium sampleEarth(Aerosol aerosol)
{
    physics::Medium medium;
    medium.planetRadius = 6371e3;
    medium.topOfAtmosphere = 120e3;
    medium.sunAngularRadius = 0.00465 / 1.01208;
    for (const int i : {1, 4, 7, 10})
        medium.wavelengthsNm.push_back(360 + i * 470.0 / 15);
    medium.solarIrradiance.assign(4, 1.0);
    medium.groundAlbedo = {0.037, 0.043, 0.090, 0.047};
    // Steps of 60 m; the kinks of the ozone at 8, 21.5 and 39 km are nodes, with steps of 6 m where its logarithm
    // bends.
    for (int i = 0; i <= 2000; ++i) {
        medium.altitudes.push_back(60.0 * i);
        for (int k = 1; k < 10 && i >= 133 && i < 650; ++k)
            medium.altitudes.push_back(60.0 * i + 6 * k);
    }
    for (const double kink : {8e3, 21.5e3, 39e3})
        medium.altitudes.push_back(kink);
    std::sort(medium.altitudes.begin(), medium.altitudes.end());
    medium.altitudes.erase(
        std::unique(medium.altitudes.begin(), medium.altitudes.end(), [](double a, double b) { return std::abs(a - b) < 1e-6; }),
        medium.altitudes.end());
    medium.scatteringAngles = sampleAngles();

    physics::Species molecules = named("molecules");
    molecules.numberDensity = tabulated(medium.altitudes, [](double h) { return 3.08458e25 * std::exp(-h / 8e3); });
    molecules.extinctionCrossSection = tabulated(medium.wavelengthsNm, [](double nm) { return 0.04022e-30 * std::pow(nm / 1000, -4); });
    molecules.singleScatteringAlbedo.assign(4, 1.0);
    molecules.phaseFunction = achromatic(medium.scatteringAngles, 4, rayleighPhase);
    molecules.achromatic = molecules.smooth = true;
    medium.species.push_back(molecules);

    if (aerosol == Aerosol::Yes) {
        physics::Species species = named("aerosol");
        species.numberDensity = tabulated(medium.altitudes, [](double h) { return 1.03333e8 * std::exp(-h / 1.2e3); });
        species.extinctionCrossSection.assign(4, 0.042968e-12);
        species.singleScatteringAlbedo.assign(4, 1.0);
        species.phaseFunction = achromatic(medium.scatteringAngles, 4, aerosolPhase);
        species.achromatic = true;
        medium.species.push_back(species);
    }

    physics::Species ozone = named("ozone");
    ozone.numberDensity = tabulated(medium.altitudes, [](double h) { return 370 * 2.6867e20 * ozoneShape(h); });
    ozone.extinctionCrossSection = {6.052e-28, 7.361e-26, 4.514e-25, 1.571e-25};
    ozone.singleScatteringAlbedo.assign(4, 0.0);
    medium.species.push_back(ozone);
    return medium;
}

physics::Medium flatLayer(double opticalDepth, double singleScatteringAlbedo, double groundAlbedo,
                          const std::function<double(double)>& phase)
{
    physics::Medium medium;
    medium.planetRadius = 6.4e9;
    medium.topOfAtmosphere = 1000;
    medium.wavelengthsNm = {550};
    medium.solarIrradiance = {1};
    medium.groundAlbedo = {groundAlbedo};
    medium.altitudes = {0, 1000};
    medium.scatteringAngles = sampleAngles();
    physics::Species species = named("particles");
    species.numberDensity = {1, 1};
    species.extinctionCrossSection = {opticalDepth / 1000};
    species.singleScatteringAlbedo = {singleScatteringAlbedo};
    species.phaseFunction = achromatic(medium.scatteringAngles, 1, phase);
    medium.species.push_back(species);
    return medium;
}

} // namespace sky::test
