#pragma once
// Series of sharp phase functions that are right where there is little light.

#include <functional>
#include <vector>

namespace sky::physics {

/// Changes the Legendre moments of a series that ends within a sharp peak so that it follows the phase function beyond the peak, farther away than the
/// degree resolves: least squares of its relative error there. Else it ripples about zero, by tens of times what light is scattered so far, faded or
/// not. Moments 0 to 4 stay, and with them energy, diffusion and the width of the peak.
///   moments        lambda_0 .. lambda_degree, 1
///   phaseFunction  of the scattering angle, rad, in units of the isotropic one, scaled as the moments are
///   backward       whether the peak is at pi
///   source         in the manner of the delta-fit of Hu et al. 2000, J. Quant. Spectrosc. Radiat. Transfer 65, 681
void fitBeyondPeak(std::vector<double>& moments, const std::function<double(double)>& phaseFunction, bool backward);

} // namespace sky::physics
