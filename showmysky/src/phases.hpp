#pragma once
// Phase functions as the painter wants them: one colourless function for each scatterer, exact at each pixel; what
// differs between wavelengths is a smooth ratio that the sky tables carry.

#include "atmosphere.hpp"
#include "sky_view.hpp"
#include <optional>
#include <utility>

namespace showmysky {

class Phases
{
public:
    explicit Phases(const Atmosphere& atmosphere);

    /// Looks from a camera at this altitude (m) to the Sun: beside it, peaks are the aureole that is seen from there.
    void look(double altitude, double muSun);
    /// Counts changes of the functions drawn.
    int version() const { return version_; }

    /// Phase function drawn for a scatterer, sr^-1: mean over the wavelengths by their share in daylight's luminance,
    /// at cos(scattering angle) `nu`. What truncation took from it (physics::Optics) is in the tables.
    double drawn(int scatterer, double nu) const;
    /// Phase function at each wavelength over the one drawn, [wavelength].
    void ratio(int scatterer, double nu, double* result) const;

    /// Fourth roots of the functions drawn, four scatterers a texel, over cbrt(angle / pi): the root keeps a cloud's
    /// five decades in a half float.
    ///   returns [texture row][width]
    std::vector<Texel> texels(int width) const;

private:
    void exact(int scatterer, double theta, double* result) const;

    const Atmosphere& atmosphere_;
    std::optional<std::pair<double, double>> looked_; ///< altitude and cosine that were looked at last
    std::vector<std::vector<double>> peakDepths_;     ///< [angle][wavelength], physics::Aureole::depths at angles as of `texels`
    int version_ = 0;
    std::vector<double> shares_;                      ///< [wavelength], sum 1
    std::vector<std::vector<double>> constantRatios_; ///< [scatterer]: of the achromatic ones; others empty
};

} // namespace showmysky
