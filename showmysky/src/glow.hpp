#pragma once
// Light of a ground that glows evenly: the same in every azimuth, from the moments or the table of a model.

#include "model/glow_tables.hpp"
#include "physics/air_entry.hpp"
#include "physics/glow_light.hpp"
#include "sky_view.hpp"
#include <optional>
#include <string>
#include <vector>

namespace showmysky {

class Glow
{
public:
    /// Reads the moments; the table only when it is first asked for.   throws  sky::ModelError
    Glow(const sky::model::Model& model, const sky::physics::Medium& medium);

    /// Empty if a model holds light pollution, otherwise a sentence that says why not.
    static std::string whyMissing(const sky::model::Model& model);

    /// Radiance in a direction, W m^-2 sr^-1 nm^-1 for a ground of 1 cd m^-2, in double precision.
    ///   altitude  m; above the atmosphere too
    ///   mu        sine of the view's elevation
    ///   result    [wavelength]
    void radiance(double altitude, double mu, double* result) const;

    /// Luminance of all views from an altitude for a ground of 1 cd m^-2.
    ViewTable fromMoments(double altitude) const;
    ViewTable fromTextures(double altitude);

private:
    void along(sky::physics::RayTracer& tracer, const sky::physics::AirEntry& entry, bool ground, double* result) const;
    std::array<double, 4> luminanceOf(const double* radiance) const;

    const sky::model::Model& model_;
    const sky::physics::Medium& medium_;
    sky::physics::GlowMoments moments_;
    sky::physics::Profile profile_;
    sky::physics::Optics optics_;
    sky::physics::GlowLight light_;
    std::vector<std::array<double, 4>> weights_; ///< [wavelength]: X, Y, Z, scotopic of unit radiance
    std::optional<sky::model::GlowTable> table_;
};

} // namespace showmysky
