#pragma once
#include "solver/bake.hpp"
#include <optional>
#include <string>

namespace sky::solver {

/// Why no eclipse table can be made of a description: the Moon's place or size; nothing if one can.
std::optional<std::string> noEclipse(const atmo::Description& description);

/// Size of the table: the description's, views rounded up to whole halves; its layers are those of the scattering tables.
atmo::SizeScattering eclipseTableSize(const atmo::Description& description);

/// Number of places of Sun and camera for which the field of an eclipse is solved.
int eclipseStates(const atmo::Description& description, const Options& options);

/// Seconds that the table takes on two cores, roughly.
///   medium  null as long as it is not known: hazy and cloudy air take more levels and events
double eclipseSeconds(const atmo::Description& description, const Options& options, const physics::Medium* medium);

/// Light of two orders and more while the Moon stands before the Sun, both concentric as the camera sees them: the table
/// "eclipsed-double-scattering", as many orders as the moments have. The quotient of eclipsed and uneclipsed light (sky::eclipse) varies
/// slowly with the altitude: it is computed at a few, and multiplies the ordinary light of every layer.
void bakeEclipsed(const gl::Api& api, const BakeJob& job, const physics::Moments& field, model::ModelWriter& writer,
                  const std::function<void(double)>& breath);

} // namespace sky::solver
