#pragma once
// The radiance moments in a model: moments.exr, a complete model on its own together with the medium.

#include "model/model.hpp"
#include "model/writer.hpp"
#include "physics/moments.hpp"
#include "physics/optics.hpp"
#include <string>

namespace sky::model {

/// Writes the tables `name` (moments) and `name`-ground-irradiance.
void writeMoments(ModelWriter& writer, const std::string& name, const physics::Moments& moments);

/// True if no light of this model is scattered twice: one order was asked for, or nothing scatters, or the Sun gives no light. Such a
/// model has neither moments nor a table of multiple scattering, and needs none.
bool scattersOnceAtMost(const Manifest& manifest);

/// The moments of a model.   throws ModelError
physics::Moments readMoments(const Model& model, const std::string& name = "moments");

/// The manifest's settings that readMoments's caller needs to rebuild the optics: degree, whether peaks are truncated, and how much of them, by which
/// a model of a version that did it otherwise is known.   throws ModelError where they are missing or don't fit
void describeOptics(Manifest& manifest, const physics::Optics& optics, bool truncatePeaks);
physics::Optics readOptics(const Model& model, const physics::Medium& medium);

} // namespace sky::model
