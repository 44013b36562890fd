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
/// \param medium    what it holds decides the degree: molecules alone need 2; peaks that are truncated more than the rest
/// \param tolerance drops harmonics that change less than this share of the light; 0: only those that are not there
Quality qualityFor(const std::string& name, const physics::Medium& medium, double tolerance = 0);

} // namespace sky::solver
