#pragma once
#include "atmo/description.hpp"
#include "model/writer.hpp"
#include "physics/table_axes.hpp"
#include "solver/iterate.hpp"
#include "solver/solve.hpp"
#include <array>

namespace sky::solver {

/// Nodes along a ray for the tables; see docs/accuracy for what fewer or more cost.
struct BakeSettings {
    int directNodes = 40;
    int nodes = 14;
    int refinement = 4;          ///< fine Suns per Sun of the moments
    double stationTolerance = 0; ///< see ScatteredRaySettings
    /// Nodes for sunlight must resolve the edge of the shadow, but no finer than a table of so many Suns can show it: all for 128 or more,
    /// half of them for 32 or fewer.
    int directNodesFor(int suns) const;
};

/// What the 4D tables of a model have in common.
struct BakeJob {
    const atmo::Description& description;
    const Options& options;
    const Scene& scene;
    BakeSettings settings;
    physics::SunTableAxis sunAxis;         ///< of all tables over the Sun
    atmo::SizeScattering size;             ///< texels
    std::vector<double> altitudes() const; ///< of the layers asked for
    /// "order 3": in words; the last of all orders with those that follow it.
    std::string orderName(std::size_t order, bool last) const;
    /// A 4D table of that size: luminance, or spectral radiance after --radiance.
    model::TableSpec spec(const std::string& name, const std::string& quantity, bool luminance) const;
};

/// XYZ and scotopic luminance of unit radiance per unit solar irradiance: colour matching times the solar spectrum. [wavelength]
std::vector<std::array<double, 4>> luminanceOf(const physics::Medium& medium);

/// Single scattering, a table per scatterer: "single-scattering/NAME".
void bakeSingleScattering(const gl::Api& api, const BakeJob& job, model::ModelWriter& writer, const std::function<void(double)>& breath);

/// Light of the field's events scattered once more: the table `name`.
void bakeMultipleScattering(const gl::Api& api, const BakeJob& job, const physics::Moments& field, const std::string& name,
                            const std::string& quantity, model::ModelWriter& writer, const std::function<void(double)>& breath);

/// The layers of such a table, one after another, without writing them.
///   use  gets the layer and its texels [sun][view][azimuth]: luminance (X, Y, Z, scotopic), or radiance per unit solar irradiance at each
///        wavelength, padded to whole sets of four
void gatherMultipleScattering(const gl::Api& api, const BakeJob& job, const physics::Moments& field, bool luminance,
                              const std::function<void(double)>& breath,
                              const std::function<void(int layer, std::vector<float> texels)>& use);

/// Transmittance from each altitude to space, "transmittance".
void bakeTransmittance(const BakeJob& job, model::ModelWriter& writer);

/// Downward irradiance by altitude and Sun: "irradiance-direct", and from the field "irradiance-diffuse".
void bakeIrradiance(const BakeJob& job, const RadiationField* field, bool perEvent, model::ModelWriter& writer);

} // namespace sky::solver
