#pragma once
// Numbers, quantities with units and words, read from the value of an entry.

#include "atmo/document.hpp"

namespace sky::atmo {

enum class Dimension { Length, ReciprocalLength, Area };

/// "length", "reciprocal length" or "area".
std::string_view nameOf(Dimension dimension);
/// The units of a dimension for a message: "nm, um, mm, ...".
std::string unitsOf(Dimension dimension);

/// Reads one value from left to right. Whatever doesn't fit is an AtmoError at its place.
class ValueReader
{
public:
    ValueReader(const Source& source, Position begin, std::string_view text);
    ValueReader(const Source& source, const Entry& entry) : ValueReader(source, entry.valuePlace, entry.value) {}

    /// A finite decimal number, `1.5` or `-3e-7`.
    double number();
    /// A whole number, digits only.
    int wholeNumber();
    /// A number and a unit, in SI units times 10^`decimals` (9: nanometres for a length).
    double quantity(Dimension dimension, int decimals = 0);
    /// Letters up to the next sign that isn't one; empty if there are none.
    std::string_view word();
    /// Steps over `sign` (and blanks before it) if it comes next.
    bool accept(char sign);
    /// Steps over `sign` or complains.
    void expect(char sign, const std::string& after);
    /// Steps over `count` bytes of what peek() shows.
    void skip(std::size_t count);
    /// Complains about anything that is left.
    void expectEnd();

    bool atEnd();
    /// Where the next thing to read begins.
    Position place();
    /// What is left, without consuming it.
    std::string_view peek();
    [[noreturn]] void fail(const std::string& message) { source_.fail(place(), message); }
    [[noreturn]] void failAt(Position place, const std::string& message) const { source_.fail(place, message); }

private:
    void skipBlanks();
    std::string found();

    const Source& source_;
    Position begin_;
    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace sky::atmo
