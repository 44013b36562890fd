#pragma once
// What is seen of the light of a glowing ground along a ray. The field is known at every altitude, so no nodes are chosen: light is
// added up over the cells of the ray, in single precision, many wavelengths at once.

#include "base/lanes.hpp"
#include "physics/ground_glow.hpp"
#include "physics/ray.hpp"
#include <vector>

namespace sky::physics {

class GlowLight
{
public:
    /// The field's light as air and ground send it into rays. Medium and optics as those of the field.
    GlowLight(const Medium& medium, const Optics& optics, const GlowMoments& moments);

    /// Light that is scattered into a ray, or reflected into it by the ground, per radiance of the ground.
    ///   result  [wavelength], dimensionless, >= 0
    void scattered(const RayCells& ray, double* result) const;
    /// The same and the glow of the ground itself: all that is seen.
    void seen(const RayCells& ray, double* result) const;
    /// The glow of the ground itself alone: what the air lets through, 0 where the ray misses the ground.
    void direct(const RayCells& ray, double* result) const;

    /// Optical depth beyond which nothing of a ray is asked.
    static constexpr double deepest = 17;
    static constexpr int lanes = 16; ///< wavelengths of a block, which are computed together
    using Lane = float __attribute__((vector_size(lanes * sizeof(float))));

private:
    using Lanes = base::VectorsOf<Lane>;
    struct Sums;
    Sums along(const RayCells& ray) const;

    Planet planet_;
    int degree_, species_, wavelengths_;
    std::vector<int> scatterers_;
    std::vector<double> reflected_; ///< [wavelength]: radiance that the ground reflects
    std::vector<double> measures_;  ///< [level], sqrt(r^2 - R^2)
    std::vector<double> units_;     ///< [species], m^2: the largest extinction, so that single precision holds the others
    Lanes extinction_;              ///< [block][species], in these units
    Lanes scattering_;              ///< [block][scatterer][l]: in these units, times lambda_l
    Lanes field_;                   ///< [block][level][l]: I_l sqrt((2 l + 1) / 4 pi)
};

} // namespace sky::physics
