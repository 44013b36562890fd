#pragma once
// A model as the renderer holds it: the medium with what follows from it.

#include "model/model.hpp"
#include "physics/aureole.hpp"
#include "physics/moments.hpp"
#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include "physics/sun.hpp"
#include <memory>
#include <optional>
#include <string>

namespace showmysky {

/// What is known once the manifest and the medium are read.
struct Atmosphere {
    explicit Atmosphere(const std::string& directory);

    sky::model::Model model;
    sky::physics::Medium medium;
    sky::physics::Profile profile;
    sky::physics::Optics optics;
    sky::physics::Aureole aureole;

    int wavelengths() const { return medium.wavelengthCount(); }
    int scatterers() const { return static_cast<int>(optics.scatterers.size()); }
    const sky::physics::Planet& planet() const { return profile.planet(); }
    /// X, Y, Z and scotopic luminance of unit radiance per unit solar irradiance, [wavelength].
    ///   factors  on the solar spectrum, one per wavelength, or empty
    std::vector<std::array<float, 4>> luminanceWeights(const std::vector<double>& factors) const;
    /// Name of the table of a scatterer's single scattering.
    std::string singleScatteringTable(int scatterer) const;
};

} // namespace showmysky
