#pragma once
#include <vector>

namespace sky::physics {

/// Optical depths of rays from one point to the sky just above its horizon, and what they make of a disc that stands there. With the Sun's light going
/// out over a small part of its disc, as behind a thin shell of air, a few points of the disc would meet that part or miss it.
class LimbDepths
{
public:
    /// \param elevations  [ray], above the horizon, rad; from 0 on, rising, two at least
    /// \param depths      [ray][wavelength]; linear between rays
    LimbDepths(std::vector<double> elevations, std::vector<double> depths);

    /// Minus the logarithm of the mean transmittance of what shows of a disc, [wavelength].
    ///   top        elevation of its upper limb above the horizon, rad, 0 up to the last of the rays
    ///   radius     of the disc, rad, above 0
    ///   withSine   weighed with the elevation's sine; the horizon is level then
    void meanDepth(double top, double radius, bool withSine, double* result) const;

private:
    std::vector<double> elevations_, depths_;
    int wavelengths_;
};

} // namespace sky::physics
