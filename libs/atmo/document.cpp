#include "atmo/document.hpp"

#include <array>
#include <utility>

namespace sky::atmo {

namespace {

constexpr std::string_view fence = "```";

// The line without its comment. A '#' between double quotes is part of a name or path.
std::string_view withoutComment(std::string_view line)
{
    bool inQuotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"')
            inQuotes = !inQuotes;
        if (line[i] == '#' && !inQuotes)
            return line.substr(0, i);
    }
    // An unbalanced quote must not swallow the comment.
    return inQuotes ? line.substr(0, line.find('#')) : line;
}

std::size_t offsetOf(std::string_view part, std::string_view whole) { return static_cast<std::size_t>(part.data() - whole.data()); }

class Reader
{
public:
    explicit Reader(const Source& source) : source_(source) {}

    std::vector<Entry> all()
    {
        std::vector<Entry> entries;
        while (nextLine()) {
            if (content_.front() == '}')
                fail("this `}` closes nothing; expected a key");
            entries.push_back(entry());
            if (entries.back().kind == Entry::Kind::Section)
                fillSection(entries.back());
        }
        return entries;
    }

private:
    // Steps to the next line that holds more than blanks and comment.
    bool nextLine()
    {
        while (line_ < source_.lineCount()) {
            ++line_;
            content_ = trimmed(withoutComment(source_.line(line_)));
            if (!content_.empty())
                return true;
        }
        return false;
    }

    Position placeOf(std::string_view part) const { return {line_, offsetOf(part, source_.line(line_))}; }
    [[noreturn]] void fail(const std::string& message) const { source_.fail(placeOf(content_), message); }

    Entry entry()
    {
        if (content_.front() == '{')
            fail("this `{` opens no section; expected a key and a colon before it");
        if (content_.starts_with(fence))
            fail("this code block belongs to no key; expected a key and a colon before it");

        Entry entry;
        const std::size_t colon = content_.find(':');
        const std::string_view key = trimmed(content_.substr(0, colon));
        entry.key = key;
        entry.keyPlace = placeOf(key);
        if (colon == std::string_view::npos)
            return entry;
        if (key.empty())
            fail("no key before the colon; expected `key: value`");

        const std::string_view value = trimmed(content_.substr(colon + 1));
        entry.kind = Entry::Kind::Value;
        entry.value = value;
        entry.valuePlace = {line_, placeOf(content_).offset + (value.empty() ? content_.size() : offsetOf(value, content_))};
        if (value.empty())
            lookForBlockBelow(entry);
        else if (value.front() == '{')
            openSection(entry, value);
        else if (value.starts_with(fence))
            readCode(entry, value);
        return entry;
    }

    // A section or a code block begins on the next line that isn't empty.
    void lookForBlockBelow(Entry& entry)
    {
        const int lineOfKey = line_;
        const std::string_view contentOfKey = content_;
        if (nextLine() && content_.front() == '{')
            return openSection(entry, content_);
        if (line_ > lineOfKey && content_.starts_with(fence))
            return readCode(entry, content_);
        line_ = lineOfKey;
        content_ = contentOfKey;
    }

    void openSection(Entry& entry, std::string_view brace)
    {
        if (trimmed(brace).size() > 1)
            source_.fail(placeOf(trimmed(brace.substr(1))), "text after `{`; expected the section to begin on the next line");
        entry.kind = Entry::Kind::Section;
        entry.value.clear();
        entry.valuePlace = placeOf(brace);
    }

    void fillSection(Entry& section)
    {
        while (nextLine()) {
            if (content_.front() == '}') {
                if (content_.size() > 1)
                    source_.fail(placeOf(trimmed(content_.substr(1))), "text after `}`; expected the next entry on a line of its own");
                return;
            }
            section.entries.push_back(entry());
            if (section.entries.back().kind == Entry::Kind::Section)
                source_.fail(section.entries.back().keyPlace,
                             "a section inside of " + inBackticks(section.key) + "; sections can't be nested (is a `}` missing?)");
        }
        source_.fail(section.valuePlace, "the section " + inBackticks(section.key) + " has no end; expected a line with `}`");
    }

    void readCode(Entry& entry, std::string_view opening)
    {
        const Position place = placeOf(opening);
        entry.kind = Entry::Kind::Code;
        entry.value.clear();
        entry.valuePlace = place;
        entry.code.file = source_.fileName();
        const std::string_view label = trimmed(opening.substr(fence.size()));
        if (!label.empty() && comparable(label) != "glsl")
            source_.fail(placeOf(label), "text after the opening ```; expected the code to begin on the next line");

        entry.code.firstLine = line_ + 1;
        bool first = true;
        while (line_ < source_.lineCount()) {
            const std::string_view line = source_.line(++line_);
            const std::size_t mark = line.find(fence);
            if (mark == std::string_view::npos) {
                if (!std::exchange(first, false))
                    entry.code.text += '\n';
                entry.code.text += line;
                continue;
            }
            if (!trimmed(line.substr(0, mark)).empty())
                source_.fail({line_, mark}, "code before the closing ```; expected it on a line of its own");
            const std::string_view rest = trimmed(withoutComment(line.substr(mark + fence.size())));
            if (!rest.empty())
                source_.fail(placeOf(rest), "text after the closing ```; expected the next entry on a line of its own");
            return;
        }
        source_.fail(place, "the code block of " + inBackticks(entry.key) + " has no end; expected a line with ```");
    }

    const Source& source_;
    int line_ = 0;
    std::string_view content_;
};

} // namespace

std::vector<Entry> readEntries(const Source& source) { return Reader(source).all(); }

std::string comparable(std::string_view key)
{
    static constexpr std::array<std::pair<std::string_view, char>, 6> foreign{{
        {"\xC3\x85", 'a'},
        {"\xC3\xA5", 'a'}, // A and a with a ring
        {"\xC3\x96", 'o'},
        {"\xC3\xB6", 'o'}, // O and o with two dots
        {"\xC2\xB5", 'u'},
        {"\xCE\xBC", 'u'}, // micro sign, Greek mu
    }};
    std::string result;
    while (!key.empty()) {
        bool replaced = false;
        for (const auto& [letter, ascii] : foreign) {
            if (key.starts_with(letter)) {
                result += ascii;
                key.remove_prefix(letter.size());
                replaced = true;
                break;
            }
        }
        if (replaced)
            continue;
        const char c = key.front();
        key.remove_prefix(1);
        if (!isBlank(c) && c != '-' && c != '_')
            result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

} // namespace sky::atmo
