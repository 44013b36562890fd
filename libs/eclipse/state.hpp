#pragma once
#include "eclipse/convergence.hpp"
#include "eclipse/kernels.hpp"
#include "eclipse/rays.hpp"
#include <optional>

namespace sky::eclipse {

/// Moments at all points of the grid, and the diffuse irradiance of the ground that goes with them.
struct Light {
    int degree = 0;
    Lanes moments;    ///< [group][level][point][harmonic]
    Lanes irradiance; ///< [group][point]
    std::size_t harmonics() const { return static_cast<std::size_t>(allHarmonics(degree)); }
};

struct ScatteredField::State {
    State(std::shared_ptr<const AirRays> rays, const physics::SunTable& sun, const physics::EclipseBodies& bodies, const Orders& orders,
          SunlightLeft left);

    std::shared_ptr<const AirRays> air;
    const physics::SunTable& sun;
    Orders orders;
    SunlightLeft sunlightLeft;
    Frame frame;
    Grid grid, fine;           ///< of the field; of sunlight
    std::vector<Turn> turns;   ///< [event]: directions of its light; the last of all later events
    std::vector<Vector> sunAt; ///< [point of the grid]
    Lanes sunlight;            ///< [group][level of sunlight][point of fine]
    Lanes sunnyGround;         ///< [group][point of fine], irradiance
    Light last, before, total;
    std::optional<Convergence> convergence; ///< with all orders
    int events = 0;
    bool lit = false, done = false;

    const Turn& turn() const { return turns[std::min(static_cast<std::size_t>(events), turns.size() - 1)]; }
    std::size_t points() const { return static_cast<std::size_t>(grid.points()); }
    std::size_t levels() const { return static_cast<std::size_t>(air->levels.count()); }
    const Lane* momentsAt(const Light& light, int group, int level) const
    {
        return &light
                    .moments[(static_cast<std::size_t>(group) * levels() + static_cast<std::size_t>(level)) * points() * light.harmonics()];
    }

    void shine();         ///< sunlight at all points
    Light gather() const; ///< the light of the next event
    void gatherLevel(int level, Light& light) const;
    /// What the ground reflects of its irradiance, [point of source], along a ray.
    void addGround(const GridRay& ray, int group, const Grid& source, const Lane* irradiance, struct Scratch& scratch) const;
    void directRay(const GridRay& ray, int group, struct Scratch& scratch) const;
    void scatteredRay(const GridRay& ray, int group, struct Scratch& scratch) const;
    void add(const Light& light);
    ViewLight look(const Light& light, const TracedViews& views, const std::vector<double>& azimuths) const;
    bool known(); ///< whether later events no longer change quotients
    void close(); ///< adds the tail of the series
};

} // namespace sky::eclipse
