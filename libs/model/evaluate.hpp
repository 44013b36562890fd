#pragma once
// The sky of a model directory, evaluated on the CPU in double precision, as a judge wants it: single and multiple scattering
// apart, at any place and in any direction.

#include "model/model.hpp"
#include "physics/moments.hpp"
#include "physics/optics.hpp"
#include <memory>
#include <optional>
#include <vector>

namespace sky::model {

/// Where the camera stands, where the Sun is and where the camera looks. SI, radians.
struct SkyGeometry {
    double altitude = 0;        ///< m, 0 .. topOfAtmosphere
    double sunZenithAngle = 0;  ///< of the centre of the disc
    double viewZenithAngle = 0; ///< 0 up
    double relativeAzimuth = 0; ///< of the view minus that of the Sun
};

/// Radiance per unit solar irradiance, [wavelength], 1/sr. Light straight from the ground is in neither part.
struct SkyRadiance {
    std::vector<double> single, multiple;
};

/// Which tables of a model the sky is taken from.
enum class SkySource {
    Moments, ///< single scattering by quadrature, multiple scattering gathered from the moments
    Textures ///< both interpolated from the 4D tables
};

/// Keeps what it has read; not thread-safe. The model that it was opened from must outlive it.
class SkyOfModel
{
public:
    virtual ~SkyOfModel() = default;
    virtual SkyRadiance radiance(const SkyGeometry& geometry) = 0;
};

/// The moments where the model has them, else the textures.
SkySource usualSource(const Model& model);

/// The sky of moments that are in memory already; without them, single scattering alone.
std::unique_ptr<SkyOfModel> skyOfMoments(const physics::Medium& medium, const physics::Optics& optics,
                                         std::optional<physics::Moments> moments);

/// Opens the sky of a model. A model of one scattering order needs no table of multiple scattering.
///   throws  ModelError where a table is missing; UsageError where textures hold luminance
std::unique_ptr<SkyOfModel> openSky(const Model& model, SkySource source);

} // namespace sky::model
