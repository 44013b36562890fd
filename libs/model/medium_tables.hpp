#pragma once
// The medium in a model: spectra in the manifest, number densities in medium.exr, phase functions in phase-functions.exr.

#include "model/model.hpp"
#include "model/writer.hpp"
#include "physics/medium.hpp"

namespace sky::model {

/// Fills what the manifest says of the medium: radii, wavelengths, spectra, species.
void describeMedium(Manifest& manifest, const physics::Medium& medium);

/// Writes the tables "medium" and, if anything scatters, "phase-functions".
void writeMedium(ModelWriter& writer, const physics::Medium& medium);

/// The medium of a model: nodes and spectra exactly as they were, densities and phase functions rounded to float.
///   throws  ModelError if something is missing or not a medium
physics::Medium readMedium(const Model& model);

} // namespace sky::model
