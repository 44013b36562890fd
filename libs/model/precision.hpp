#pragma once
// Fewer bits for smaller files: rounding to a given number of significand bits, and rows of halves with an exponent.

#include <cstddef>
#include <cstdint>

namespace sky::model {

/// Nearest value with `bits` significand bits (1..24), ties to even; finite stays finite.
float roundedToBits(float value, int bits);

/// What is wrong with a row of values, found by bit patterns: no compiler option or driver can hide it.
enum class Flaw { None, NotANumber, Infinite, Negative };

struct RowScan {
    float largest = 0; ///< largest magnitude, if flawless
    Flaw flaw = Flaw::None;
    std::size_t position = 0; ///< of the first flaw
};

RowScan scanRow(const float* values, std::size_t count, bool isSigned);

/// Exponent e for a row of halves whose largest magnitude is `largest`, so that values are stored as value / 2^e.
///
/// `previous` is kept where it serves as well: neighbouring rows then differ by their values alone, which compresses
/// better. The stored maximum is 2^10 .. 2^15, so that all values above 2^-24 of it keep the full precision of a half.
int rowExponent(float largest, int previous);

/// Rounds values to `bits` (1..11), divides them by 2^exponent and stores them as halves' bit patterns.
void toHalves(const float* values, std::size_t count, int bits, int exponent, std::uint16_t* halves);

} // namespace sky::model
