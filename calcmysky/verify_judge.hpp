#pragma once
// The Monte Carlo reference on many queries within a given time.

#include <functional>
#include <vector>

#include "montecarlo/reference.hpp"

namespace sky::cli {

struct JudgeSettings {
    int orders = 0;              ///< as montecarlo::Settings
    double relativeError = 1e-3; ///< a row with less noise is good enough
    double seconds = 0;          ///< for all rows together; 0: as long as relativeError needs
    std::uint64_t seed = 1;
};

/// Radiances of all queries, in their order. With a time limit every row gets an equal share of half of it, then the
/// noisiest rows get the rest, a share at a time.
///   progress  called with the fraction of the work done, between rows
///   throws    Cancelled once Ctrl-C was pressed
std::vector<montecarlo::Result> judge(const montecarlo::Reference& reference, const std::vector<montecarlo::Query>& queries,
                                      const JudgeSettings& settings, const std::function<void(double)>& progress);

/// Radiance per unit solar irradiance, 1/sr, that nobody sees: a millionth of what the Earth's sky has in late twilight. Relative errors of less
/// say nothing.
constexpr double darkest = 1e-14;

/// Standard error of a result's single + multiple, relative to it; infinite where there is no light.
double relativeNoise(const montecarlo::Result& result);

} // namespace sky::cli
