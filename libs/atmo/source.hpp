#pragma once
// The text of a description cut into lines, and the one way to complain about a place in it.

#include "base/error.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace sky::atmo {

/// A place in a Source: 1-based line, 0-based byte offset into it.
struct Position {
    int line = 1;
    std::size_t offset = 0;
};

/// Lines without their ends; CRLF, lone CR and a UTF-8 byte order mark are gone.
///   throws  AtmoError if the text is UTF-16 or has a NUL byte, so that it can't be a description
class Source
{
public:
    Source(std::string_view text, std::string fileName);

    const std::string& fileName() const { return fileName_; }
    int lineCount() const { return static_cast<int>(lines_.size()); }
    /// Line `number`, 1 <= number <= lineCount().
    std::string_view line(int number) const { return lines_[static_cast<std::size_t>(number) - 1]; }

    /// Throws AtmoError with the line and a caret under `place`.
    [[noreturn]] void fail(Position place, const std::string& message) const;

private:
    std::string fileName_;
    std::vector<std::string> lines_;
};

/// `text` between backticks for a message: shortened and printable.
std::string inBackticks(std::string_view text);

/// `text` with '?' for the signs that could disturb a terminal.
std::string printable(std::string_view text);

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// True for ' ' and '\t'.
constexpr bool isBlank(char c) { return c == ' ' || c == '\t'; }

} // namespace sky::atmo
