#pragma once
#include "base/lanes.hpp"
#include "solver/rays.hpp"
#include <array>

namespace sky::solver {

/// The radiation field as the fold reads it: in main memory, wavelengths padded to whole sets of four.
struct FoldField {
    /// suns: of the moments' grid, and one beyond the zenith (Moments::withSunBeyondZenith)
    int suns = 0, harmonics = 0, stride = 0; ///< stride: padded wavelengths
    std::array<float, 3> sunAxis{};          ///< of the axis of Suns: a, sinh a, v of the lowest (physics::MomentGrid)
    base::VectorsOf<float> moments;          ///< [altitude][sun][lm][wavelength]: log2 I_00, then I_lm / I_00
    std::vector<float> ground;               ///< [sun][wavelength]: log2 of the diffuse irradiance of the ground
    /// Where fine Suns stand among those of the grid: on a folded ray's axis of Suns the gather may interpolate linearly.
    std::vector<physics::Stencil> fineSuns;

    /// \param refinement fine Suns per Sun of the moments' grid
    FoldField(const physics::Moments& moments, int refinement);
    int fineSunCount() const { return static_cast<int>(fineSuns.size()); }
};

/// Folds what depends on a ray alone into azimuthal terms per node and Sun, so that the gather meets at most degree + 1 numbers
/// instead of (degree + 1)(degree + 2) / 2, and no altitudes (shaders/lib/scattered.glsl):
///     g_m = sum over l, i of w_i lambda_l,i (I_lm / I_00) P_lm(mu)
/// and adds up I_00 g_m of the nodes that share a station.
/// Done here because a CPU's vectors suit it better than a software driver's loads and scalar stores (docs/method 8).
/// Where only luminance is asked for, wavelengths collapse here too, once a ray instead of once a texel. Last, cubics put fine
/// Suns between those of the field: smooth numbers, so that folding the fine ones would only cost more.
///   azimuthal  highest azimuthal order that is kept
///   luminance  [padded wavelength][X, Y, Z, scotopic] of unit radiance; empty: spectral
///   source     [station][fine sun][1 + term][wavelength, or component of luminance], of rays first .. first + count - 1;
///              term 0 is log2 of a mean, the others are relative to it
void fold(const FoldField& field, const ScatteredRays& rays, int first, int count, int azimuthal,
          const std::vector<std::array<float, 4>>& luminance, float* source);

} // namespace sky::solver
