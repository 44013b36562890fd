#pragma once
#include "atmo/description.hpp"
#include "model/writer.hpp"
#include "physics/medium.hpp"
#include "solver/solve.hpp"
#include <functional>
#include <string>
#include <vector>

namespace sky::solver {

/// The description's spectrum of the glowing ground, scaled to a luminance of exactly 1 cd m^-2.
///   warnings  gets a sentence where the description is off by more than a twentieth
///   returns   [wavelength], W m^-2 sr^-1 nm^-1 per cd m^-2; empty if the description has none, or it is dark
std::vector<double> glowSpectrum(const atmo::Description& description, std::vector<std::string>& warnings);

/// Light pollution by a ground that glows evenly: the table "light-pollution", its moments, and with --save-light-pollution
/// "light-pollution/order-N". All orders of scattering, whatever the description asks for the Sun: the problem is one-dimensional.
///   spectrum  glowSpectrum(), not empty
///   manifest  learns the number of events and what is estimated to be left out
void bakeLightPollution(const atmo::Description& description, const Options& options, const physics::Medium& medium,
                        const std::vector<double>& spectrum, model::ModelWriter& writer, model::Manifest& manifest,
                        const std::function<void(double)>& breath);

} // namespace sky::solver
