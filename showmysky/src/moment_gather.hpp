#pragma once
// The moments source: light gathered along a few rays of every elevation, for any Sun.
//
// What depends on the altitude alone (nodes and weights of the rays; the moments that meet the ray's direction at each
// node, folded to terms in cos(m phi)) is kept until the altitude changes. A new Sun then costs some milliseconds.

#include "atmosphere.hpp"
#include "phases.hpp"
#include "physics/ray.hpp"
#include "physics/sun.hpp"
#include "settings_used.hpp"
#include "sky_view.hpp"
#include <cstdint>

namespace showmysky {

class MomentGather
{
public:
    /// Rays and azimuths that are computed; the tables drawn are interpolated from these.
    static constexpr int halfViews = 32, azimuths = 33;
    static constexpr int singleNodes = 48; ///< for sunlight; more where shadows have edges: physics::Profile::forShadows
    static constexpr int multipleNodes = 20;

    /// \param moments may be null: then there is no multiple scattering
    MomentGather(const Atmosphere& atmosphere, const Phases& phases, const sky::physics::Moments* moments,
                 const sky::physics::SunTable& sun, double sunAngularRadius);

    /// Begins anew at an altitude, m, >= 0; above the atmosphere too.
    void setAltitude(double altitude);
    double altitude() const { return altitude_; }
    /// Follows some more rays at this altitude; returns true once all are done.
    bool step(int rays);
    double fractionDone() const { return double(traced_) / double(rays_.size()); }

    /// The sky for a Sun. Follows what rays are left.
    ///   weights  X, Y, Z, scotopic of unit radiance per unit solar irradiance, [wavelength]
    SkyView gather(double muSun, const LayersUsed& layers, const std::vector<Texel>& weights);

private:
    struct Node {
        float sunScale, nuScale, mu;
        float horizon;      // rad, at the node
        float inverseRange; // of the table of sunlight
        int sunRow;
        float sunRowShare;
        sky::physics::Stencil level; // of the moments
    };
    struct Ray {
        bool lit = false; // meets any air
        bool ground = false;
        std::vector<Node> single, multiple;
        std::vector<float> singleWeights;   // [node][scatterer][stride]
        std::vector<float> coefficients;    // [node][lm][stride]: sum over scatterers of weight lambda_l, times the harmonic factor
        std::vector<float> folded;          // [node][sun][1 + term][stride]; valid where `isFolded`
        std::vector<std::uint8_t> isFolded; // [node][sun]
        Node groundNode{};
        std::vector<float> groundFactors; // [stride]: transmittance times albedo / pi
    };

    void trace(int ray, sky::physics::RayTracer& tracer) const;
    Node nodeOf(const sky::physics::RayNodes::Node& node) const;
    const float* folded(Ray& ray, int node, int sun) const;
    void sunlight(const Node& node, double visible, float aboveHorizon, float* result) const;
    void addSingle(const Ray& ray, float muSun, float nu, float* lit) const;
    void addMultiple(Ray& ray, float muSun, float nu, float* radiance) const;
    void addGround(const Ray& ray, float muSun, float nu, const LayersUsed& layers, float* radiance) const;

    const Atmosphere& atmosphere_;
    const Phases& phases_;
    const sky::physics::Moments* moments_;
    const sky::physics::SunTable& sun_;
    float sunRadius_;
    int stride_, scatterers_, degree_, bentDegree_, suns_ = 0; // Suns: and one beyond the zenith
    std::vector<float> sunDepths_;                             // [altitude][elevation][stride]
    std::vector<float> field_;                                 // [altitude][sun][lm][stride]: log2 I_00, then ratios
    std::vector<float> groundField_; // [sun][2][stride]: log2 of the diffuse irradiance of the ground, then 1: as of a node
    double altitude_ = -1;
    std::vector<double> sines_;
    mutable std::vector<Ray> rays_;
    int traced_ = 0;
};

} // namespace showmysky
