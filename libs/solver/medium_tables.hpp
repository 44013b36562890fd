#pragma once
#include "atmo/description.hpp"
#include "gl/context.hpp"
#include "physics/medium.hpp"
#include <string>
#include <vector>

namespace sky::solver {

/// How far the integral of a phase function over the sphere may be from one before it is said that it was divided by that.
constexpr double phaseNormalisationTolerance = 2e-3;

/// Evaluates the description's GLSL blocks on the GPU, once; nothing downstream needs them again.
/// Altitude nodes are put where the densities need them: densities are log-linear between nodes to 1e-4, jumps are
/// enclosed by two neighbouring floats.
///   warnings  gets a sentence for each phase function that was far from normalised
///   throws    AtmoError where a block doesn't compile, or returns what is no density or phase function
physics::Medium evaluateMedium(const atmo::Description& description, const gl::Api& api, std::vector<std::string>& warnings);

} // namespace sky::solver
