#pragma once
// Light of a glowing ground by the Monte Carlo judge: what `calcmysky reference --ground-light` does.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "montecarlo/ground_light.hpp"
#include "montecarlo/reference.hpp"
#include "verify_judge.hpp"

namespace sky::cli {

/// "all", or "distance=50km,azimuth=30,radius=5km" of a disc: metres or kilometres, degrees.
///   returns  nothing for all of the ground
///   throws   UsageError
std::optional<montecarlo::GroundDisc> readGroundLight(const std::string& option, const std::string& text);

/// Results with the scattered light in `multiple` and the ground itself in `groundDirect`, as shares of the ground's radiance.
/// `settings` as for judge(), but the time is shared evenly.
std::vector<montecarlo::Result> judgeGroundLight(const montecarlo::Reference& reference, const std::vector<montecarlo::Query>& queries,
                                                 const std::optional<montecarlo::GroundDisc>& disc, const JudgeSettings& settings,
                                                 const std::function<void(double)>& progress);

} // namespace sky::cli
