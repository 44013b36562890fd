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

/// Radiances of all queries, in their order. With a time limit every row gets an equal share of half of it, but a quarter of a second where
/// its paths take long; then rows get the rest a share at a time, those first that come to be sure soonest, then the noisiest.
///   progress  called with the fraction of the work done, between rows
///   throws    Cancelled once Ctrl-C was pressed
std::vector<montecarlo::Result> judge(const montecarlo::Reference& reference, const std::vector<montecarlo::Query>& queries,
                                      const JudgeSettings& settings, const std::function<void(double)>& progress);

/// Standard error of a result's single + multiple, relative to it; infinite where there is no light.
double relativeNoise(const montecarlo::Result& result);

/// Radiance per unit solar irradiance, 1/sr, that nobody sees: a millionth of what the Earth's sky has in late twilight. Relative errors of less
/// say nothing.
constexpr double darkest = 1e-14;
bool isDark(const montecarlo::Result& result);

/// Where few random paths carry most of the light, a mean of too few misses them, and its standard error misses that too. Seen
/// in deep twilight from 5 % on: 2.5 times too dark at a stated noise of 10 %.
constexpr double unsureNoise = 0.05;
constexpr std::int64_t fewestPaths = 2048; ///< that tell their own noise: where they are long, time may end before
bool isSure(const montecarlo::Result& result);

/// The row that gains most from more paths: of those that are unsure the least noisy, which comes to be of use soonest, or else the noisiest of
/// all; none without light. results.size() where all are as good as asked.
std::size_t neediest(const std::vector<montecarlo::Result>& results, double relativeError);

} // namespace sky::cli
