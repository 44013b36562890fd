#pragma once
// Runs batches of random paths on all threads until the asked-for error is reached.

#include "montecarlo/paths.hpp"
#include "montecarlo/reference.hpp"

#include <functional>
#include <optional>

namespace sky::montecarlo {

/// The scene seen from where the line of sight enters the atmosphere; nothing if it misses it.
std::optional<Scene> sceneOf(const physics::Medium& medium, const Query& query);

/// Mean of a batch of so many paths.
using BatchMean = std::function<double(Random&, int)>;

/// Runs batches on all threads, each with a batch function of its own from `make`, until the error of their mean is as settings ask.
void runPaths(const std::function<BatchMean()>& make, const Query& query, const Settings& settings, Result& result);

/// Fills multiple, multipleStderr and paths of `result`; result.single counts towards the radiance that the relative
/// error refers to. Batches have random streams of their own and are summed in their order.
void addPaths(const Air& air, const Scene& scene, Orders orders, const Query& query, const Settings& settings, Result& result);

} // namespace sky::montecarlo
