#include "base/error.hpp"

namespace sky {

namespace {

std::string describe(const SourceLocation& place, const std::string& message, const std::string& sourceLine)
{
    std::string text = place.file.empty() ? std::string("<text>") : place.file;
    if (place.line > 0)
        text += ":" + std::to_string(place.line);
    if (place.column > 0)
        text += ":" + std::to_string(place.column);
    text += ": " + message;
    if (!sourceLine.empty()) {
        text += "\n    " + sourceLine;
        if (place.column > 0) {
            // Tabs are kept so that the caret stays under its character; UTF-8 continuation bytes take no column.
            text += "\n    ";
            int column = 1;
            for (const char c : sourceLine) {
                if (column >= place.column)
                    break;
                if ((static_cast<unsigned char>(c) & 0xC0) == 0x80)
                    continue;
                text += c == '\t' ? '\t' : ' ';
                ++column;
            }
            text += "^";
        }
    }
    return text;
}

} // namespace

AtmoError::AtmoError(const SourceLocation& place, const std::string& message, const std::string& sourceLine)
    : Error(describe(place, message, sourceLine)), place_(place)
{
}

} // namespace sky
