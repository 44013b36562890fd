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
    ///   closest  to a shell that is there, share of the atmosphere
    Profile withShellsAt(const std::vector<double>& altitudes, double closest = 1e-7) const;
    /// The same with shells under every upper edge of the air, ever closer: a low Sun lights only a skin of it, the thinner the lower the
    /// Sun is. For rays that shall resolve that.
    Profile withShellsUnderEdges() const;

    const Planet& planet() const { return planet_; }
    int speciesCount() const { return species_; }
    /// Shell altitudes, m, increasing, 0 .. top. Two very close ones enclose a jump.
    const std::vector<double>& shells() const { return shells_; }
    /// Share of the atmosphere within which what changes changes at once.
    static constexpr double atOnce = 1e-5;

    /// Index k of the shell interval [shells[k], shells[k+1]] that holds the altitude.
    int intervalAt(double altitude) const;
    /// Number densities at `altitude`, taken from interval k, [species], m^-3.
    void densities(int interval, double altitude, double* values) const;
    /// Whether between the shells of interval k the logarithm of a species' number density is straight; else the density itself.
    bool logarithmic(int interval, int species) const { return segments_.logarithmic[std::size_t(interval) * species_ + species] > 0; }
    /// Largest |d ln n / dh| of the species that matter in interval k, m^-1.
    double steepness(int interval) const { return steepness_[interval]; }
    /// How often the way to an upper edge is halved in interval k, 0 where no edge is above.
    double halvings(int interval) const { return halvings_[interval]; }
    /// How many of what is usual are needed for sunlight (nodes of a ray; altitudes, elevations of a table), up to three times as many: where air ends
    /// at once below the top, its shadows and what shines past them have edges, which the Sun's disc blurs the less the smaller it is
    /// against the dip of the horizon up there.
    ///   sunRadius  angular, rad
    int forShadows(int usual, double sunRadius) const;

private:
    /// Densities between two shells, as the compiler's vectors want them, [interval][species]: exp(start + slope dh) where `logarithmic`
    /// is 1, start + slope dh where it is 0.
    struct Segments {
        std::vector<double> start, slope, logarithmic;
        void add(double atStart, double along, double isLogarithmic);
    };
    /// Where air ends at once upwards, or nearly so.
    struct UpperEdge {
        double altitude; ///< m
        double way;      ///< m, below it: within a half of where the optical depth is 1
        int halvings;    ///< of that way, until the lowest Sun shines through what is left
    };
    void findUpperEdges(const Medium& medium);

    Planet planet_;
    int species_ = 0;
    std::vector<double> shells_;
    Segments segments_;
    std::vector<double> steepness_, halvings_;
    std::vector<UpperEdge> edges_;
};

/// Vertical optical depth of the air below each shell, [shells].
///   crossSections  [species], m^2
std::vector<double> depthBelowShells(const Profile& profile, const std::vector<double>& crossSections);
/// Vertical optical depth between two altitudes of one interval.
double depthInShell(const Profile& profile, const std::vector<double>& crossSections, int interval, double bottom, double altitude);

/// How far below the horizontal the horizon is seen, rad, from the shell above which less than a hundred-thousandth of the optical depth
/// is left.
double dipOfAir(const Profile& profile, const std::vector<double>& crossSections);

/// Of the angle over which the Sun goes out, dip of the horizon and diameter of the disc, the part of the Earth's, up to 1. Axes over the
/// Sun's elevation are made for 1, and narrower in proportion where it is less. Air that is opaque has its horizon where the optical depth
/// above is 1: it goes dark at once, as a ground does.
double sunsetShare(const Profile& profile, const std::vector<double>& crossSections, double sunRadius);

} // namespace sky::physics
