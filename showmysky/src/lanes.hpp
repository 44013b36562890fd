#pragma once
// Loops over wavelengths, written so that compilers make vectors of them.

#include <bit>
#include <cmath>
#include <cstdint>

// The widest vectors that the machine has; elsewhere the compiler's default.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SKY_WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2,fma", "default")))
#else
#define SKY_WIDEST_VECTORS
#endif

namespace showmysky {

/// 2^x for -126 <= x <= 126 (beyond, the nearest of these): relative error < 3e-7, without a call. Taylor polynomial of
/// degree 7 on -1/2 .. 1/2.
inline float exp2Lane(float x)
{
    x = x < -126.f ? -126.f : x > 126.f ? 126.f : x;
    const float whole = static_cast<float>(static_cast<std::int32_t>(x + (x < 0 ? -0.5f : 0.5f)));
    const float y = x - whole;
    const float p =
        1 + y * (0.69314718f +
                 y * (0.24022651f +
                      y * (0.055504109f +
                           y * (0.0096181291f + y * (0.0013333558f + y * (0.00015403530f + y * 0.000015252734f))))));
    const auto exponent = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole) + 127) << 23;
    return p * std::bit_cast<float>(exponent);
}

} // namespace showmysky
