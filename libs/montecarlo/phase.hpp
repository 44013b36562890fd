#pragma once
// A tabulated phase function at one wavelength: exact values and importance sampling.

#include <vector>

namespace sky::montecarlo {

/// Phase function, log-linear in the scattering angle between nodes (linear where an end is zero), used as tabulated:
/// if its integral is not 1, the difference is lost or gained at each scattering.
class PhaseTable
{
public:
    /// A species that never scatters.
    PhaseTable() = default;
    ///   angles  rad, strictly increasing, 0 .. pi          values  1/sr, >= 0, one per angle
    PhaseTable(const std::vector<double>& angles, const std::vector<double>& values);

    /// 1/sr at a scattering angle, 0 .. pi.
    double value(double angle) const;
    /// Integral over the sphere.
    double integral() const { return integral_; }

    /// A random scattering angle. `weight` corrects the small difference between the density sampled and the table's.
    struct Sample {
        double angle = 0, weight = 0;
    };
    Sample sample(double u) const;

private:
    std::size_t intervalOf(double angle) const;

    std::vector<double> angles_, values_, logs_;
    std::vector<std::size_t> guide_; ///< first interval of each of equal bins of the angle
    // The density sampled is linear in the angle between these finer nodes.
    std::vector<double> nodes_, density_, cumulative_;
    double integral_ = 0;
};

} // namespace sky::montecarlo
