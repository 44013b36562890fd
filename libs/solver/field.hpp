#pragma once
#include "solver/rays.hpp"

namespace sky::solver {

/// The radiation field as the gather reads it: moments resampled to a fine axis of the Sun's elevation, on which linear
/// interpolation is enough (libs/solver/field.cpp says how fine).
struct FieldTexels {
    int suns;
    double vLowest;
    TexelBuffer moments; ///< [altitude][sun][lm][set]: log2 I_00, then I_lm / I_00
    TexelBuffer ground;  ///< [sun][set]: log2 of the diffuse irradiance of the ground
    FieldTexels(const gl::Api& api, const physics::Moments& moments, int refinement);

private:
    struct Data;
    FieldTexels(const gl::Api& api, const Data& data);
};

} // namespace sky::solver
