#pragma once

#include <ostream>
#include <vector>

#include "solver/solve.hpp"

namespace sky::cli {

/// The plan as an aligned table: what, whether, time, memory, disk, why; then the totals.
void printPlan(const std::vector<solver::PlanItem>& plan, std::ostream& to);

} // namespace sky::cli
