#include "model/precision.hpp"

#include <bit>
#include <cmath>

namespace sky::model {

namespace {

constexpr std::uint32_t signBit = 0x80000000u, infinity = 0x7f800000u;

// Adding just below half a unit, plus one where the kept part is odd, then cutting: to nearest, ties to even. A carry
// runs into the exponent, which is right. Works on the bits so that loops over it become vector code.
std::uint32_t roundBits(std::uint32_t bits, int dropped)
{
    const std::uint32_t odd = (bits >> dropped) & 1u;
    const std::uint32_t keep = ~((1u << dropped) - 1u);
    const std::uint32_t rounded = (bits + ((1u << dropped) >> 1) - 1u + odd) & keep;
    // Rounded up to infinity: the largest finite value with so many bits is the nearest we have.
    return (rounded & infinity) == infinity ? bits & keep : rounded;
}

} // namespace

float roundedToBits(float value, int bits)
{
    return bits >= 24 ? value : std::bit_cast<float>(roundBits(std::bit_cast<std::uint32_t>(value), 24 - bits));
}

RowScan scanRow(const float* values, std::size_t count, bool isSigned)
{
    std::uint32_t largest = 0, negative = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(values[i]), magnitude = bits & ~signBit;
        largest = magnitude > largest ? magnitude : largest;
        negative |= magnitude ? bits : 0u; // minus zero is not negative
    }
    if (largest < infinity && (isSigned || !(negative & signBit)))
        return {std::bit_cast<float>(largest), Flaw::None, 0};
    for (std::size_t i = 0;; ++i) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(values[i]), magnitude = bits & ~signBit;
        if (magnitude > infinity)
            return {0, Flaw::NotANumber, i};
        if (magnitude == infinity)
            return {0, Flaw::Infinite, i};
        if (!isSigned && (bits & signBit) && magnitude)
            return {0, Flaw::Negative, i};
    }
}

int rowExponent(float largest, int previous)
{
    if (largest == 0)
        return previous;
    const int own = std::ilogb(largest); // 2^own <= largest < 2^(own + 1)
    const int stored = own - previous;
    return stored >= 10 && stored <= 14 ? previous : own - 13;
}

void toHalves(const float* values, std::size_t count, int bits, int exponent, std::uint16_t* halves)
{
    // 2^-112 moves the exponent of a half's range to where a float has the same bits: its denormals then are the
    // half's, rounded to nearest by the multiplication itself. In two steps, since the factor may leave float's range.
    const int shift = -exponent - 112;
    const float first = std::ldexp(1.f, shift / 2), second = std::ldexp(1.f, shift - shift / 2);
    const int dropped = 24 - bits;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t rounded = roundBits(std::bit_cast<std::uint32_t>(values[i]), dropped);
        const std::uint32_t scaled = std::bit_cast<std::uint32_t>(std::bit_cast<float>(rounded) * first * second);
        // Only denormals still have more than a half's bits.
        const std::uint32_t half = roundBits(scaled & ~signBit, 13) >> 13;
        halves[i] = static_cast<std::uint16_t>(half | ((scaled & signBit) >> 16));
    }
}

} // namespace sky::model
