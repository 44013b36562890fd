#pragma once
// The medium as plain tables: what is left of a description once the user's GLSL blocks have been evaluated.
// Everything downstream (solver, Monte Carlo, renderer, other people's readers) works from these tables alone.

#include <string>
#include <vector>

namespace sky::physics {

/// One kind of particle. Absorbers have zero single-scattering albedo and an empty phase function.
struct Species {
    std::string name;
    std::vector<double> numberDensity;          ///< [altitudes], m^-3, >= 0
    std::vector<double> extinctionCrossSection; ///< [wavelengths], m^2, >= 0
    std::vector<double> singleScatteringAlbedo; ///< [wavelengths], 0..1
    std::vector<double> phaseFunction;          ///< [angles][wavelengths], sr^-1, >= 0; empty if it never scatters
    bool achromatic = false;                    ///< the phase function is the same at all wavelengths
    bool smooth = false;                        ///< the description calls its phase function smooth

    bool scatters() const { return !phaseFunction.empty(); }
};

/// A spherically symmetric atmosphere on altitude nodes 0 .. topOfAtmosphere.
/// Between nodes: number density is log-linear where both ends are positive, linear otherwise. A jump is two nodes very
/// close together. Phase functions are log-linear in the scattering angle between angle nodes (linear where an end is zero).
struct Medium {
    double planetRadius = 0;              ///< m
    double topOfAtmosphere = 0;           ///< m, altitude
    double sunAngularRadius = 0;          ///< rad
    std::vector<double> wavelengthsNm;    ///< [wavelengths]
    std::vector<double> solarIrradiance;  ///< [wavelengths], W m^-2 nm^-1
    std::vector<double> groundAlbedo;     ///< [wavelengths], 0..1
    std::vector<double> altitudes;        ///< [altitudes], m, strictly increasing, first 0, last topOfAtmosphere
    std::vector<double> scatteringAngles; ///< [angles], rad, strictly increasing, 0 .. pi; dense at 0
    std::vector<Species> species;

    int wavelengthCount() const { return static_cast<int>(wavelengthsNm.size()); }
};

} // namespace sky::physics
