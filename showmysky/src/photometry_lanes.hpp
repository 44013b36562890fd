#pragma once
// Eight wavelengths at a time: the compiler's vector type, and the exponential function on it.

#include "base/lanes.hpp"
#include <algorithm>
#include <cstdint>
#include <vector>

namespace showmysky::lanes {

constexpr int count = 8;
using Lanes = float __attribute__((vector_size(count * sizeof(float))));
using Integers = std::int32_t __attribute__((vector_size(count * sizeof(std::int32_t))));

// No function with vectors as arguments is called across files: its ABI doesn't matter.
#pragma GCC diagnostic ignored "-Wpsabi"
// Helpers are compiled into each of its variants.
#define SKY_INLINE [[gnu::always_inline]] inline

SKY_INLINE Lanes all(float x) { return x - Lanes{}; }

/// Wavelengths in steps of eight, the last step filled up with zeros.
struct alignas(count * sizeof(float)) Block { // without AVX the compiler would align less than variants with AVX take for granted
    Lanes v;
};
using Blocks = std::vector<Block>;
/// The same memory as numbers, one after the other.
inline float* floats(Blocks& blocks) { return reinterpret_cast<float*>(blocks.data()); }
inline const float* floats(const Blocks& blocks) { return reinterpret_cast<const float*>(blocks.data()); }
constexpr int blocksFor(int wavelengths) { return (wavelengths + count - 1) / count; }

/// [rows][wavelengths] to [rows][blocks], times a factor.
template<class Real>
Blocks toBlocks(const Real* values, std::size_t rows, int wavelengths, double factor = 1)
{
    const int blocks = blocksFor(wavelengths);
    Blocks result(rows * blocks, Block{all(0)});
    for (std::size_t row = 0; row < rows; ++row)
        for (int w = 0; w < wavelengths; ++w)
            result[row * blocks + w / count].v[w % count] = static_cast<float>(double(values[row * wavelengths + w]) * factor);
    return result;
}

/// e^x with a relative error below 3e-7; x is held within -87..87.
/// 2^n e^r with |r| <= ln(2) / 2, e^r by its series: the first term left out, r^7 / 7!, is below 1.3e-7.
SKY_INLINE Lanes exponential(const Lanes& of)
{
    const Lanes raised = of < -87.f ? all(-87.f) : of, x = raised > 87.f ? all(87.f) : raised;
    // Adding 1.5 * 2^23 rounds to an integer in the last digits. ln(2) in two parts keeps the digits of r.
    const Lanes n = (x * 1.44269504f + 12582912.f) - 12582912.f;
    const Lanes r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    Lanes sum = all(1.f / 720);
    sum = sum * r + 1.f / 120;
    sum = sum * r + 1.f / 24;
    sum = sum * r + 1.f / 6;
    sum = sum * r + 0.5f;
    sum = sum * r + 1.f;
    sum = sum * r + 1.f;
    const Integers power = (__builtin_convertvector(n, Integers) + 127) << 23;
    return sum * reinterpret_cast<Lanes>(power);
}

} // namespace showmysky::lanes
