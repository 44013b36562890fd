#pragma once
#include "physics/directions.hpp"
#include "solver/gather.hpp"
#include <vector>

namespace sky::solver {

/// Fine suns per sun of the grid inside the iteration: its errors average out over directions.
constexpr int sweepRefinement = 2;

/// When the iteration ends.
struct OrderLimit {
    int orders = 4;       ///< of the light that is to be seen: the field needs one event less
    bool all = false;     ///< go on until the last event changes the whole series, closed, by less than `tolerance`
    double tolerance = 0; ///< relative, rms; 0: exactly `orders`, or where all are wanted what the settings say
    int most = 200;       ///< events, where all are wanted
};

/// The converged radiation field and what it cost.
struct RadiationField {
    physics::Moments total;                 ///< of all events, with those to come where all orders are wanted
    std::vector<physics::Moments> perEvent; ///< kept on request: those computed one by one, the last one with all that follow
    physics::Moments firstFromGround;       ///< likewise: the part of event 1 that is reflection by the ground
    /// [event - 1] likewise: [altitude][sun][wavelength], downward, unit solar irradiance.
    std::vector<std::vector<double>> irradiance;
    int eventCount = 0;   ///< computed one by one, and sweeps over all that follow
    double remainder = 0; ///< rms: relative change by the last event, or what late ones leave, where a tolerance decided
    bool ended = true;    ///< false: all events were wanted, and after the last that may be computed more is left than the tolerance
};

/// Source iteration for the radiance moments (docs/method): each sweep gathers, for every level, Sun and direction, the light
/// that the last event's field scatters or reflects into that ray, and projects it onto the harmonics.
///   blockBytes  of radiances gathered at a time, at least of one level; 0: no bound
///   breath  called between dispatches with the fraction of the sweeps done so far
///   throws  NumericsError where a value is not finite
RadiationField iterate(const gl::Api& api, const Scene& scene, const physics::MomentGrid& grid, const physics::MomentSettings& settings,
                       const OrderLimit& limit, bool keepEvents, const std::function<void(double)>& breath, std::size_t blockBytes = 0);

} // namespace sky::solver
