#pragma once
// Where along each line of sight the light of single scattering comes from, without any Moon: what an eclipse then dims
// piece by piece. Depends on the altitude and on the Sun's elevation, so it stays as it is while the Moon moves.

#include "atmosphere.hpp"
#include "physics/ray.hpp"
#include "sky_view.hpp"
#include <optional>

namespace showmysky {

class EclipseShares
{
public:
    /// Rays, azimuths 0 .. pi from the Sun's, nodes along a ray: docs/eclipses.md has what fewer cost.
    static constexpr int halfViews = 32, azimuths = 25, nodes = 128;

    EclipseShares(const Atmosphere& atmosphere, const sky::physics::SunTable& sun);

    /// Begins anew if anything changed.
    void set(double altitude, double muSun, const std::vector<Texel>& weights);
    /// Follows some more rays; true once all are done.
    bool step(int rays);

    /// The nodes of one line of sight: between two rays.
    struct Line {
        std::vector<float> distance; ///< [node], m from the camera
        std::vector<float> ahead;    ///< [node], the zenith there: per horizontal part of the line's direction
        std::vector<float> up;       ///< [node], and its vertical part at the camera
        std::vector<Texel> light;    ///< [azimuth][node][scatterer]: luminance of single scattering without phase function
        std::vector<Texel> rising;   ///< [azimuth][node]: growth of its logarithm with the sine of the Sun's elevation
        bool lit = false;            ///< meets any air
    };
    /// \param mu          cosine of its zenith angle
    /// \param coordinate  0 at the horizon to 1 at the end of the half, as physics::horizonAngleNodes
    void line(double mu, double coordinate, int half, Line& result) const;
    /// Largest distance of a node, m.
    double reach() const { return reach_; }

private:
    struct Ray {
        bool lit = false;
        std::vector<float> distance;
        std::vector<float> weights;                       // [node][scatterer][wavelength]
        std::vector<sky::physics::RayNodes::Node> places; // seen from the camera
        std::vector<Texel> light;                         // [azimuth][node][scatterer]
        std::vector<Texel> rising;                        // [azimuth][node]
    };
    void trace(int ray, sky::physics::RayTracer& tracer);
    void shine(Ray& ray, double mu) const;

    const Atmosphere& atmosphere_;
    const sky::physics::SunTable& sun_;
    double altitude_ = -1, muSun_ = 2, reach_ = 0;
    std::vector<Texel> weights_;
    std::vector<double> sines_;
    std::vector<Ray> rays_;
    int done_ = 0;
};

} // namespace showmysky
