#pragma once
#include "physics/directions.hpp"
#include "physics/optics.hpp"
#include "solver/bake.hpp"
#include <string>

namespace sky::solver {

/// How finely to compute, as one choice. Points of the measured front of time against error: docs/accuracy.
struct Quality {
    physics::MomentSettings moments;
    BakeSettings bake;
};

/// \param name   draft, normal, fine or reference     throws UsageError
/// \param medium what it holds decides the degree: molecules alone need 2; peaks that are truncated more than the rest
Quality qualityFor(const std::string& name, const physics::Medium& medium);

} // namespace sky::solver
