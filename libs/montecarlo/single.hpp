#pragma once
// What needs no random numbers: light scattered once, and the ground in direct view.

#include "montecarlo/air.hpp"
#include "montecarlo/moon.hpp"
#include "montecarlo/sun.hpp"

#include <optional>

namespace sky::montecarlo {

/// A camera inside the atmosphere, the direction it looks in and the Sun.
struct Scene {
    Place camera;
    Vec view{0, 0, 1};
    SunDisc sun;
    std::optional<Eclipse> eclipse{};
};

struct Integral {
    double value = 0;
    double error = 0; ///< change when all steps were halved for the last time
};

/// Average of f(direction) over what a place sees of the solar disc.
template<class F>
double averageSun(const Scene& scene, double planetRadius, const Place& place, const Rule& across, const Rule& along, F&& f)
{
    return scene.eclipse ? scene.eclipse->average(planetRadius, place, along, f) : scene.sun.average(planetRadius, place, across, along, f);
}

/// Radiance of sunlight scattered exactly once in the air, per unit solar irradiance, 1/sr.
///   maxSeconds  no halving begins that would end later, as far as the last one tells; 0: no limit
///   error       below 5e-5 relative, or what Integral::error says where the shadow's edge defeats the steps, or time
Integral singleScattering(const Air& air, const Scene& scene, const Leg& leg, double maxSeconds = 0);

/// Radiance of the ground in direct view, lit by direct sunlight only, dimmed by the air in between, 1/sr.
/// 0 if the ray misses the ground.
double groundDirect(const Air& air, const Scene& scene, const Leg& leg);

} // namespace sky::montecarlo
