#include "atmo/value.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace sky::atmo {

namespace {

/// A unit is 10^exponent SI units; the astronomical unit (IAU 2012 B2) is a number of metres besides.
struct Unit {
    std::string_view name;
    Dimension dimension;
    int exponent;
    double metres = 1;
};

constexpr std::array<Unit, 26> units{{
    {"nm", Dimension::Length, -9},
    {"um", Dimension::Length, -6},
    {"mm", Dimension::Length, -3},
    {"m", Dimension::Length, 0},
    {"km", Dimension::Length, 3},
    {"Mm", Dimension::Length, 6},
    {"Gm", Dimension::Length, 9},
    {"AU", Dimension::Length, 0, 149597870700.0},
    {"nm^-1", Dimension::ReciprocalLength, 9},
    {"um^-1", Dimension::ReciprocalLength, 6},
    {"mm^-1", Dimension::ReciprocalLength, 3},
    {"m^-1", Dimension::ReciprocalLength, 0},
    {"km^-1", Dimension::ReciprocalLength, -3},
    {"Mm^-1", Dimension::ReciprocalLength, -6},
    {"Gm^-1", Dimension::ReciprocalLength, -9},
    {"am^2", Dimension::Area, -36},
    {"fm^2", Dimension::Area, -30},
    {"pm^2", Dimension::Area, -24},
    {"nm^2", Dimension::Area, -18},
    {"um^2", Dimension::Area, -12},
    {"mm^2", Dimension::Area, -6},
    {"cm^2", Dimension::Area, -4},
    {"m^2", Dimension::Area, 0},
    {"km^2", Dimension::Area, 6},
    {"Mm^2", Dimension::Area, 12},
    {"Gm^2", Dimension::Area, 18},
}};

// Dividing by a positive power of ten loses less than multiplying by a negative one: 360 nm stays 360e-9 m as written.
double timesPowerOfTen(double value, int exponent)
{
    const double power = std::pow(10.0, std::abs(exponent));
    return exponent < 0 ? value / power : value * power;
}

// The unit in ASCII: micro signs, superscript digits and minus signs as typed on some keyboards.
std::string asciiUnit(std::string_view text)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> foreign{{
        {"\xC2\xB5", "u"},
        {"\xCE\xBC", "u"},               // micro sign, Greek mu
        {"\xC2\xB2", "^2"},              // superscript 2
        {"\xE2\x81\xBB\xC2\xB9", "^-1"}, // superscript -1
        {"^\xE2\x88\x92", "^-"},
        {"\xE2\x88\x92", "-"}, // minus sign
    }};
    std::string unit(text);
    for (const auto& [from, to] : foreign)
        for (std::size_t at = unit.find(from); at != std::string::npos; at = unit.find(from, at + to.size()))
            unit.replace(at, from.size(), to);
    return unit;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

} // namespace

std::string_view nameOf(Dimension dimension)
{
    switch (dimension) {
    case Dimension::Length: return "length";
    case Dimension::ReciprocalLength: return "reciprocal length";
    case Dimension::Area: break;
    }
    return "area";
}

std::string unitsOf(Dimension dimension)
{
    std::string list;
    for (const Unit& unit : units)
        if (unit.dimension == dimension)
            list += (list.empty() ? "" : ", ") + std::string(unit.name);
    return list;
}

ValueReader::ValueReader(const Source& source, Position begin, std::string_view text) : source_(source), begin_(begin), text_(text) {}

void ValueReader::skipBlanks()
{
    while (at_ < text_.size() && isBlank(text_[at_]))
        ++at_;
}

bool ValueReader::atEnd()
{
    skipBlanks();
    return at_ == text_.size();
}

Position ValueReader::place()
{
    skipBlanks();
    return {begin_.line, begin_.offset + at_};
}

std::string_view ValueReader::peek()
{
    skipBlanks();
    return trimmed(text_.substr(at_));
}

std::string ValueReader::found() { return atEnd() ? "found nothing" : "found " + inBackticks(peek()); }

double ValueReader::number()
{
    const std::string_view text = peek();
    const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
    // Without this check from_chars would take "inf" and "nan".
    const bool digit =
        text.size() > sign && (isDigit(text[sign]) || (text[sign] == '.' && text.size() > sign + 1 && isDigit(text[sign + 1])));
    if (!digit)
        fail("expected a number, " + found());
    double value = 0;
    const char* begin = text.data() + (text[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value))
        fail("the number " + inBackticks(text) + " is too large or too small to be stored");
    at_ += static_cast<std::size_t>(end - text.data());
    return value;
}

int ValueReader::wholeNumber()
{
    const std::string_view text = peek();
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool goesOn = end != text.data() + text.size() && (*end == '.' || isLetter(*end));
    if (error == std::errc::invalid_argument || goesOn)
        fail("expected a whole number, " + found());
    if (error == std::errc::result_out_of_range)
        value = text.starts_with('-') ? std::numeric_limits<int>::min() : std::numeric_limits<int>::max();
    at_ += static_cast<std::size_t>(end - text.data());
    return value;
}

double ValueReader::quantity(Dimension dimension, int decimals)
{
    const double value = number();
    const Position unitPlace = place();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isBlank(text_[at_]) && text_[at_] != ',')
        ++at_;
    const std::string name = asciiUnit(text_.substr(begin, at_ - begin));
    const std::string expected = "expected a unit of " + std::string(nameOf(dimension)) + ": " + unitsOf(dimension);
    if (name.empty())
        failAt(unitPlace, "no unit after the number; " + expected);

    std::string suggestion;
    for (const Unit& unit : units) {
        if (unit.name == name) {
            if (unit.dimension != dimension)
                failAt(unitPlace, inBackticks(name) + " is a unit of " + std::string(nameOf(unit.dimension)) + "; " + expected);
            return timesPowerOfTen(value * unit.metres, unit.exponent + decimals);
        }
        if (unit.dimension == dimension && comparable(unit.name) == comparable(name))
            suggestion = " (did you mean `" + std::string(unit.name) + "`?)";
    }
    failAt(unitPlace, "unknown unit " + inBackticks(name) + suggestion + "; " + expected);
}

std::string_view ValueReader::word()
{
    skipBlanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && isLetter(text_[at_]))
        ++at_;
    return text_.substr(begin, at_ - begin);
}

bool ValueReader::accept(char sign)
{
    if (atEnd() || text_[at_] != sign)
        return false;
    ++at_;
    return true;
}

void ValueReader::expect(char sign, const std::string& after)
{
    if (!accept(sign))
        fail("expected `" + std::string(1, sign) + "` after " + after + ", " + found());
}

void ValueReader::skip(std::size_t count)
{
    skipBlanks();
    at_ += count;
}

void ValueReader::expectEnd()
{
    if (!atEnd())
        fail("expected the end of the line, " + found());
}

} // namespace sky::atmo
