#include "values.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "base/suggest.hpp"

namespace sky::cli {

namespace {

/// All of `text` as a number, or nothing.
template<class Number>
std::optional<Number> number(std::string_view text)
{
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        return {};
    return value;
}

std::string inQuotes(const std::string& text) { return "`" + text + "`"; }

std::string joined(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "" : ", ") + word;
    return all;
}

/// `value` with so many digits after the point.
std::string fixed(double value, int digits)
{
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, digits).ptr;
    return {text.data(), end};
}

/// At least two digits.
std::string twoDigits(long value) { return (value < 10 ? "0" : "") + std::to_string(value); }

} // namespace

int readInteger(const std::string& option, const std::string& text, int first, int last)
{
    const auto value = number<int>(text);
    if (!value || *value < first || *value > last) {
        const bool open = last == std::numeric_limits<int>::max();
        throw UsageError(
            option + " takes a whole number " +
            (open ? "from " + std::to_string(first) + " on" : "from " + std::to_string(first) + " to " + std::to_string(last)) + "; " +
            inQuotes(text) + " is none.");
    }
    return *value;
}

double readFraction(const std::string& option, const std::string& text)
{
    const auto value = number<double>(text);
    if (!value || !(*value > 0 && *value < 1))
        throw UsageError(option + " takes a number above 0 and below 1, 0.001 for instance; " + inQuotes(text) + " is none.");
    return *value;
}

std::set<solver::Part> readParts(const std::string& option, const std::string& text)
{
    std::vector<std::string> names;
    for (const solver::Part part : solver::allParts())
        names.push_back(nameOf(part));
    std::set<solver::Part> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        std::string name = text.substr(begin, end - begin);
        std::erase(name, ' ');
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw UsageError(option + ": there is no part " + inQuotes(name) + "." + suggestion(name, names) + " The parts are " +
                             joined(names) + ".");
        parts.insert(solver::allParts()[static_cast<std::size_t>(found - names.begin())]);
        begin = end + 1;
    }
    return parts;
}

std::pair<int, int> readLayers(const std::string& option, const std::string& text)
{
    const std::size_t dots = text.find("..");
    const auto first = number<int>(std::string_view(text).substr(0, dots));
    const auto last = dots == std::string::npos ? first : number<int>(std::string_view(text).substr(dots + 2));
    if (!first || !last || *first < 0 || *last < *first)
        throw UsageError(option + " takes altitude layers as FIRST..LAST, counted from 0 at the ground, 0..3 for instance; " +
                         inQuotes(text) + " is none.");
    return {*first, *last};
}

std::size_t readSize(const std::string& option, const std::string& text)
{
    const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
    const auto value = number<double>(std::string_view(text).substr(0, digits));
    std::string unit = text.substr(digits);
    std::erase(unit, ' ');
    std::transform(unit.begin(), unit.end(), unit.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    double factor = 1;
    bool known = unit.empty() || unit == "B";
    const std::string prefixes = "KMGT";
    for (std::size_t i = 0; i < prefixes.size() && !known; ++i) {
        const std::string prefix(1, prefixes[i]);
        known = unit == prefix || unit == prefix + "B" || unit == prefix + "IB";
        factor = std::pow(unit == prefix + "B" ? 1000. : 1024., static_cast<double>(i + 1));
    }
    // Less than a megabyte can only be a slip of the unit; more than 2^62 bytes, of the keyboard.
    if (!value || !known || *value * factor < 1e6 || *value * factor > 4.6e18)
        throw UsageError(option + " takes a size of at least 1 MB, 512M or 1.5GiB for instance; " + inQuotes(text) + " is none.");
    return static_cast<std::size_t>(*value * factor);
}

std::size_t readChoice(const std::string& option, const std::string& text, const std::vector<std::string>& choices)
{
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end())
        throw UsageError(option + ": " + inQuotes(text) + " is not one of " + joined(choices) + "." + suggestion(text, choices));
    return static_cast<std::size_t>(found - choices.begin());
}

std::string formatSize(std::size_t bytes)
{
    if (bytes == 0)
        return "-";
    double value = static_cast<double>(bytes);
    for (const char* unit : {" B", " kB", " MB"}) {
        if (value < 999.5)
            return fixed(value, bytes >= 1000 && value < 9.95 ? 1 : 0) + unit;
        value /= 1000;
    }
    return fixed(value, 2) + " GB";
}

std::string formatDuration(double seconds)
{
    if (seconds < 9.95)
        return fixed(seconds, seconds < 0.995 ? 2 : 1) + " s";
    const long whole = std::lround(seconds);
    if (whole < 60)
        return std::to_string(whole) + " s";
    if (whole < 3600)
        return std::to_string(whole / 60) + " min " + twoDigits(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + twoDigits(whole % 3600 / 60) + " min";
}

} // namespace sky::cli
