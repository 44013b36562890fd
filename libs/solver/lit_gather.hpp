#pragma once
#include "solver/gather.hpp"

namespace sky::solver {

/// Luminance of the first event along rays, for phase functions that don't depend on wavelength: the same light as
/// DirectGather's for a fraction of its work, since wavelengths are summed once a ray (on the CPU, whose vectors suit it better than a
/// software driver) and solve/lit.comp meets four numbers.
class LitGather
{
public:
    /// \param luminance [wavelength] X, Y, Z, scotopic of unit radiance over unit solar irradiance
    LitGather(const gl::Api& api, const Scene& scene, const std::vector<std::array<double, 4>>& luminance);

    /// Fills `results` as DirectGather::gather does: for each scatterer a block of rays x suns x azimuths vec4s.
    void gather(const DirectRayData& rays, const SunSamples& samples, Strides strides, const std::vector<bool>& withPhase,
                gl::Buffer& results, const Breath& breath);

private:
    void sumWavelengths(const DirectRayData& rays, int first, int count, float* lit) const;

    gl::Api api_;
    const Scene scene_;
    gl::Program program_;
    TexelBuffer phases_;
    std::vector<std::array<float, 4>> luminance_;
    base::VectorsOf<float> logTransmittance_; // [altitude][elevation][padded wavelength], log2
    std::optional<TexelBuffer> lit_;          // kept between calls: it is large
    std::size_t litTexels_ = 0;
};

} // namespace sky::solver
