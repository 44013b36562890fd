#pragma once
// Loops over wavelengths, written so that compilers make vectors of them.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

// The widest vectors that the machine has; elsewhere the compiler's default.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SKY_WIDEST_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SKY_WIDEST_VECTORS
#endif

namespace sky::base {

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
                      y * (0.055504109f + y * (0.0096181291f + y * (0.0013333558f + y * (0.00015403530f + y * 0.000015252734f))))));
    const auto exponent = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole) + 127) << 23;
    return p * std::bit_cast<float>(exponent);
}

/// Parts of e^x = scale (1 + rest), -1/2 ln 2 <= ln(1 + rest) <= 1/2 ln 2, for -700 <= x <= 700 (beyond, the nearest of these): errors <
/// 4e-16 of scale.
struct ExponentialParts {
    double scale; ///< a power of two
    double rest;  ///< relative error < 1e-15
};

/// Taylor polynomial of degree 13 of e^r - 1. ln 2 comes in two parts, so that no digits of r are lost.
inline ExponentialParts exponentialParts(double x)
{
    constexpr double roundingShift = 0x1.8p52; // with it added, a double's last bits are a whole number
    x = x < -700. ? -700. : x > 700. ? 700. : x;
    const double shifted = x * 1.4426950408889634 + roundingShift, whole = shifted - roundingShift;
    const double r = (x - whole * 0x1.62e42feep-1) - whole * 0x1.a39ef35793c76p-33;
    const double high =
        1. / 5040 +
        r * (1. / 40320 + r * (1. / 362880 + r * (1. / 3628800 + r * (1. / 39916800 + r * (1. / 479001600 + r / 6227020800.)))));
    const double low = 0.5 + r * (1. / 6 + r * (1. / 24 + r * (1. / 120 + r * (1. / 720 + r * high))));
    return {std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52), r + r * r * low};
}

/// e^x in double, x as exponentialParts takes it: relative error < 1e-15, without a call.
inline double expLane(double x)
{
    const auto parts = exponentialParts(x);
    return parts.scale + parts.scale * parts.rest;
}

/// e^x - 1, of which small x leave all digits: relative error < 1e-15.
inline double expm1Lane(double x)
{
    const auto parts = exponentialParts(x);
    return (parts.scale - 1) + parts.scale * parts.rest;
}

/// log2 x for normal x > 0: error < 2e-7 of 1 or of the result. Series of artanh on sqrt(1/2) .. sqrt(2).
inline float log2Lane(float x)
{
    constexpr std::int32_t half = 0x3f3504f3; // bits of sqrt(1/2)
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t exponent = (bits - half) >> 23;
    const float mantissa = std::bit_cast<float>(bits - (exponent << 23));
    const float t = (mantissa - 1) / (mantissa + 1), z = t * t;
    const float series = 1 + z * (1.f / 3 + z * (1.f / 5 + z * (1.f / 7 + z * (1.f / 9))));
    return static_cast<float>(exponent) + 2.88539008f * t * series;
}

/// Arcsine, rad; x is held within -1..1. Error < 2e-7, and < 3e-7 of the result: x + x^3 P(x^2) with P fitted to the least largest error on
/// |x| <= 1/2, beyond that by asin x = pi/2 - 2 asin sqrt((1 - x) / 2).
inline float arcsineLane(float x)
{
    const float size = std::abs(x) < 1 ? std::abs(x) : 1.f;
    const bool steep = size > 0.5f;
    const float half = 0.5f - 0.5f * size, y = steep ? std::sqrt(half) : size, z = steep ? half : size * size;
    const float angle = y + y * z * (0.16666754f + z * (0.074952416f + z * (0.0454771f + z * (0.0241476f + z * 0.042218566f))));
    return std::copysign(steep ? 1.57079633f - 2 * angle : angle, x);
}

/// std::allocator forgets that vectors (GCC's vector_size) want aligned memory.
template<class Value>
struct VectorAllocator {
    using value_type = Value;
    static constexpr std::align_val_t alignment{64}; // the widest there are
    VectorAllocator() = default;
    template<class Other>
    VectorAllocator(const VectorAllocator<Other>&)
    {
    }
    Value* allocate(std::size_t count) { return static_cast<Value*>(::operator new(count * sizeof(Value), alignment)); }
    void deallocate(Value* memory, std::size_t) { ::operator delete(memory, alignment); }
    bool operator==(const VectorAllocator&) const { return true; }
};
template<class Vector>
using VectorsOf = std::vector<Vector, VectorAllocator<Vector>>;

} // namespace sky::base
