#pragma once
#include "solver/rays.hpp"

namespace sky::solver {

/// The radiation field as the fold reads it: moments resampled to a fine axis of the Sun's elevation, on which the gather
/// may interpolate linearly. In main memory, wavelengths padded to whole sets of four.
struct FineField {
    int suns = 0, harmonics = 0, stride = 0; ///< stride: padded wavelengths
    double vLowest = 0;
    std::vector<float> moments; ///< [altitude][sun][lm][wavelength]: log2 I_00, then I_lm / I_00
    std::vector<float> ground;  ///< [sun][wavelength]: log2 of the diffuse irradiance of the ground

    /// \param refinement fine Suns per Sun of the moments' grid
    FineField(const physics::Moments& moments, int refinement);
};

/// Folds what depends on a ray alone into azimuthal terms per node and Sun, so that the gather meets degree + 1 numbers
/// instead of (degree + 1)(degree + 2) / 2, and no altitudes (shaders/lib/scattered.glsl):
///     g_m = sum over l, i of w_i lambda_l,i (I_lm / I_00) P_lm(mu)
/// Done here because a CPU's vectors suit it better than a software driver's loads and scalar stores (docs/method 8).
///   source  [ray][node + ground][sun][1 + term][wavelength], rays first .. first + count - 1; term 0 is log2 I_00
void fold(const FineField& field, const ScatteredRays& rays, int first, int count, float* source);

} // namespace sky::solver
