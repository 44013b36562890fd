#pragma once
// Where scattered light comes from, roughly: tells random paths where to look for it. It only guides; any map gives the same mean.

#include "montecarlo/crowded_bins.hpp"
#include "montecarlo/profile.hpp"

#include <optional>
#include <vector>

namespace sky::montecarlo {

class Air;
class Eclipse;
struct Scene;

/// Maps of the brightness of the sky over bins of direction, for a few altitudes and elevations of the Sun: sunlight scattered once with the
/// mean phase function along the line of sight, light scattered more often as if evenly to all sides.
class Glow
{
public:
    /// Maps for all elevations of the Sun.
    explicit Glow(const Air& air);
    /// Maps for the vertical of the camera of a scene that has an eclipse.
    Glow(const Air& air, const Scene& scene);

    /// Light of the sky from all sides in a shell, in units of what the Sun sends.
    double fromAllSides(int shell, double muSun) const;

    /// The map of a place, and how it lies there.
    struct View {
        const float* map = nullptr; ///< nothing where the sky is dark
        Vec up, towards, side;      ///< `towards`: the Sun's azimuth
    };
    View viewFrom(const Place& place, Vec sun) const;
    /// A random direction, as likely as the map is bright.
    Vec direction(const View& view, double u1, double u2) const;
    /// The density of direction(), 1/sr.
    double density(const View& view, Vec direction) const;

private:
    struct Sight;
    void layOut(const Air& air);
    void fill(const Air& air, const Eclipse* eclipse);
    void draw(const std::vector<double>& light, float* map) const;
    /// Light of a line of sight, 1/sr: sunlight scattered once; and the present guess at light from all sides, scattered again.
    double sunlit(const Air& air, const Sight& sight, double muSun, double azimuth, const Eclipse* eclipse) const;
    double skylit(const Air& air, const Sight& sight, double muSun, double azimuth) const;
    Sight sightAt(const Air& air, std::size_t level, std::size_t band) const;
    std::size_t sunOf(double muSun) const { return sunBins_ ? static_cast<std::size_t>(sunBins_->of(muSun)) : 0; }
    const float* mapOf(std::size_t level, std::size_t sun) const { return &maps_[(level * sunCosines_.size() + sun) * mapSize()]; }
    std::size_t bands() const { return cosineEdges_.size() - 1; }
    std::size_t sectors() const { return azimuthEdges_.size() - 1; }
    std::size_t mapSize() const { return bands() * (1 + sectors()); }
    /// Of so many sectors together, from one on, on both sides of the Sun.
    double solidAngle(std::size_t band, std::size_t sector, std::size_t together = 1) const;

    std::vector<double> cosineEdges_;                   ///< of the bands' zenith angles, from nadir to zenith
    std::vector<double> azimuthEdges_, azimuthCosines_; ///< of the sectors, from the Sun's azimuth to half a turn; both sides share a bin
    std::vector<double> levelAltitudes_, levelEdges_;   ///< m
    std::vector<std::size_t> levelOfShell_;
    std::vector<double> sunCosines_;        ///< one for all in an eclipse
    std::optional<CrowdedBins<2>> sunBins_; ///< about the horizontal; nothing in an eclipse
    std::vector<double> diffuse_;           ///< [level][sun] from all sides
    std::vector<float> maps_;               ///< [level][sun]: cumulative shares of the bands, then in each band of its sectors
};

} // namespace sky::montecarlo
