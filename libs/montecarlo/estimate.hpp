#pragma once
// Runs batches of random paths on all threads until the asked-for error is reached.

#include "montecarlo/paths.hpp"
#include "montecarlo/reference.hpp"

namespace sky::montecarlo
{

/// Fills multiple, multipleStderr and paths of `result`; result.single counts towards the radiance that the relative
/// error refers to. Batches have random streams of their own and are summed in their order.
void addPaths(const Air& air, const Scene& scene, Orders orders, const Query& query, const Settings& settings,
              Result& result);

} // namespace sky::montecarlo
