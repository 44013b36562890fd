#pragma once
// Media for the tests, straight from formulas.

#include "physics/medium.hpp"

#include <functional>

namespace sky::test {

enum class Aerosol { No, Yes };

/// The atmosphere of the tables in data/: molecules, ozone and, if asked for, aerosol; the four wavelengths used there.
/// The formulas are in data/README.md.
physics::Medium sampleEarth(Aerosol aerosol);

/// One scattering species in a homogeneous layer of 1 km on a planet so large that it is flat, one wavelength, a
/// point-like Sun.  opticalDepth is vertical; phase is a function of the scattering angle, 1/sr.
physics::Medium flatLayer(double opticalDepth, double singleScatteringAlbedo, double groundAlbedo,
                          const std::function<double(double)>& phase);

double isotropicPhase(double angle);
double rayleighPhase(double angle);

} // namespace sky::test
