#pragma once
// Light pollution in a model: the moments of the ground's glow, and the table of what is seen.

#include "model/model.hpp"
#include "model/writer.hpp"
#include "physics/ground_glow.hpp"
#include <string>
#include <vector>

namespace sky::model {

inline constexpr const char* lightPollutionTable = "light-pollution";
inline constexpr const char* lightPollutionMoments = "light-pollution-moments";

/// Writes lightPollutionMoments and its ground irradiance.
void writeGlow(ModelWriter& writer, const physics::GlowMoments& moments);

/// The moments of a model's glow.   throws ModelError
physics::GlowMoments readGlow(const Model& model);

/// The 2D table of light pollution, [altitude][view], read whole. Interpolated like the 4D tables: by cubics of logarithms over the
/// node index.
class GlowTable
{
public:
    /// throws ModelError if the model has no such table or it isn't one
    explicit GlowTable(const Model& model);

    int channels() const { return channels_; }
    int views() const { return views_; } ///< even: half below the horizon, half above
    bool isLuminance() const { return luminance_; }

    /// All views from an altitude (m, 0 .. top), increasing elevation as physics::viewMuNodes: [view][channel], per cd m^-2 of the
    /// ground.
    std::vector<double> slice(double altitude) const;
    /// One direction of a slice; `viewElevation` in rad.   result  [channel]
    void sample(const std::vector<double>& slice, double altitude, double viewElevation, double* result) const;

private:
    physics::Planet planet_;
    int layers_, views_, channels_;
    bool luminance_;
    std::vector<float> values_;
};

} // namespace sky::model
