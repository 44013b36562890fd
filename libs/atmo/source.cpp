#include "atmo/source.hpp"

#include <algorithm>

namespace sky::atmo {

namespace {

constexpr std::size_t longestShownLine = 160; // bytes; a terminal or two of context around the caret
constexpr std::size_t longestQuotation = 60;

bool isContinuationByte(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Moves `at` back to the beginning of the UTF-8 character that it may have cut.
std::size_t characterStart(std::string_view text, std::size_t at)
{
    while (at > 0 && at < text.size() && isContinuationByte(text[at]))
        --at;
    return at;
}

std::vector<std::string> splitLines(std::string_view text)
{
    std::vector<std::string> lines(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool carriageReturn = text[i] == '\r';
        if (carriageReturn || text[i] == '\n') {
            if (carriageReturn && i + 1 < text.size() && text[i + 1] == '\n')
                ++i;
            lines.emplace_back();
        } else {
            lines.back() += text[i];
        }
    }
    return lines;
}

} // namespace

std::string printable(std::string_view text)
{
    std::string safe(text);
    for (char& c : safe)
        if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F)
            c = '?';
    return safe;
}

std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && isBlank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string inBackticks(std::string_view text)
{
    if (text.size() <= longestQuotation)
        return "`" + printable(text) + "`";
    return "`" + printable(text.substr(0, characterStart(text, longestQuotation))) + "...`";
}

Source::Source(std::string_view text, std::string fileName) : fileName_(std::move(fileName))
{
    if (text.starts_with("\xEF\xBB\xBF"))
        text.remove_prefix(3);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw AtmoError({fileName_, 1, 1}, "the file is UTF-16 text; save it as UTF-8");
    const std::size_t nul = text.find('\0');
    lines_ = splitLines(text.substr(0, nul));
    if (nul != std::string_view::npos)
        throw AtmoError({fileName_, lineCount(), 0}, "a NUL byte; expected a text file, this looks like a binary one");
}

void Source::fail(Position place, const std::string& message) const
{
    const std::string_view whole = line(place.line);
    const std::size_t offset = characterStart(whole, std::min(place.offset, whole.size()));
    const auto charactersIn = [](std::string_view part) {
        return static_cast<int>(std::count_if(part.begin(), part.end(), [](char c) { return !isContinuationByte(c); }));
    };
    const int column = 1 + charactersIn(whole.substr(0, offset));
    if (whole.size() <= longestShownLine)
        throw AtmoError({fileName_, place.line, column}, message, printable(whole));

    // The base class puts the caret under the column of the line that it is given, so a window into a long line gets
    // its own caret here.
    const std::size_t begin = characterStart(whole, offset > longestShownLine / 2 ? offset - longestShownLine / 2 : 0);
    const std::size_t end = characterStart(whole, std::min(whole.size(), begin + longestShownLine));
    const std::string shown = printable(whole.substr(begin, end - begin));
    std::string caretLine;
    for (std::size_t i = begin; i < offset; ++i)
        if (!isContinuationByte(whole[i]))
            caretLine += whole[i] == '\t' ? '\t' : ' ';
    throw AtmoError({fileName_, place.line, column}, message + "\n    " + shown + "\n    " + caretLine + "^");
}

} // namespace sky::atmo
