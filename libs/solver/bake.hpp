#pragma once
#include "atmo/description.hpp"
#include "model/writer.hpp"
#include "solver/iterate.hpp"
#include "solver/solve.hpp"

namespace sky::solver {

/// Nodes along a ray for the tables; see docs/accuracy for what fewer or more cost.
struct BakeSettings {
    int directNodes = 40;
    int nodes = 14;
    int refinement = 4; ///< fine Suns per Sun of the moments
};

/// What the 4D tables of a model have in common.
struct BakeJob {
    const atmo::Description& description;
    const Options& options;
    const Scene& scene;
    BakeSettings settings;
    double vDark; ///< dark end of the axis of the Sun: physics::sunElevationNodes
    std::vector<double> altitudes() const; ///< of the layers asked for
};

/// Single scattering, a table per scatterer: "single-scattering/NAME".
void bakeSingleScattering(const gl::Api& api, const BakeJob& job, model::ModelWriter& writer,
                          const std::function<void(double)>& breath);

/// Light of the field's events scattered once more: the table `name`.
void bakeMultipleScattering(const gl::Api& api, const BakeJob& job, const physics::Moments& field, const std::string& name,
                            model::ModelWriter& writer, const std::function<void(double)>& breath);

/// Transmittance from each altitude to space, "transmittance".
void bakeTransmittance(const BakeJob& job, model::ModelWriter& writer);

/// Downward irradiance by altitude and Sun: "irradiance-direct", and from the field "irradiance-diffuse".
void bakeIrradiance(const BakeJob& job, const RadiationField* field, bool perEvent, model::ModelWriter& writer);

} // namespace sky::solver
