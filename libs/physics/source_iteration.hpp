#pragma once
#include "physics/directions.hpp"
#include "physics/sky.hpp"
#include <functional>

namespace sky::physics {

/// Source iteration for the moments in double precision on the CPU: the twin of the GPU solver, used to tell rounding from
/// discretisation and by tests. Same grids, same rays, same quadrature.
///   orders     number of events the field may have had, >= 1 (one less than the order of the light that is to be seen)
///   sunChords  2: the twin of the GPU's sweeps, step by step (solver::sweepRefinement); 0: cubics between the grid's Suns
///   returns    the moments summed over events 1..orders
Moments iterateSource(const Medium& medium, const Profile& profile, const Optics& optics, const SunTable& sun, const MomentGrid& grid,
                      const MomentSettings& settings, int orders, int sunChords = 0, int threads = 2);

} // namespace sky::physics
