#pragma once
#include "physics/directions.hpp"
#include "physics/medium.hpp"
#include "solver/solve.hpp"

namespace sky::solver {

/// What the radiation field takes, and with it the table of moments. Known once the medium is: haze asks for more harmonics, clouds for
/// more levels and events.
struct FieldWork {
    double seconds;   ///< on two cores of a software driver, roughly
    double bytes;     ///< at the peak, beside what the program takes anyway
    double diskBytes; ///< of the moments
};

/// Events of light that all orders take, roughly: about as many as the optical depth makes.
int eventsOf(const physics::Medium& medium);

/// \param orders  of scattering; 0: all
FieldWork fieldWorkOf(const physics::Medium& medium, const Options& options, int orders);

} // namespace sky::solver
