#pragma once
#include "physics/geometry.hpp"
#include "physics/medium.hpp"
#include <vector>

namespace sky::physics {

/// The altitude profile of a medium, thinned to the fewest shells between which every number density is log-linear (or
/// linear) within a tolerance: what integrals along rays run over.
class Profile
{
public:
    /// \param tolerance relative deviation allowed between the shells, where a species matters at all
    explicit Profile(const Medium& medium, double tolerance = 3e-4);

    /// The same densities with more shells, at these altitudes: where a field bends more than the air does.
    Profile withShellsAt(const std::vector<double>& altitudes) const;

    const Planet& planet() const { return planet_; }
    int speciesCount() const { return species_; }
    /// Shell altitudes, m, increasing, 0 .. top. Two very close ones enclose a jump.
    const std::vector<double>& shells() const { return shells_; }

    /// Index k of the shell interval [shells[k], shells[k+1]] that holds the altitude.
    int intervalAt(double altitude) const;
    /// Number densities at `altitude`, taken from interval k, [species], m^-3.
    void densities(int interval, double altitude, double* values) const;
    /// Largest |d ln n / dh| of the species that matter in interval k, m^-1.
    double steepness(int interval) const { return steepness_[interval]; }

private:
    struct Segment {
        double start, slope;
        bool logarithmic;
    };
    Planet planet_;
    int species_ = 0;
    std::vector<double> shells_;
    std::vector<Segment> segments_; // [interval][species]
    std::vector<double> steepness_;
};

} // namespace sky::physics
