#pragma once
// The grammar of a description, before any key has a meaning: entries, sections and code blocks.

#include "atmo/description.hpp"
#include "atmo/source.hpp"

namespace sky::atmo {

/// One entry. What stands before the first colon is the key; a token has no colon.
struct Entry {
    enum class Kind { Token, Value, Section, Code };

    std::string key; ///< as written, without the blanks around it
    Position keyPlace;
    Kind kind = Kind::Token;
    std::string value; ///< Value: one line, without comment and blanks around it
    Position valuePlace;
    std::vector<Entry> entries; ///< Section
    CodeBlock code;             ///< Code: the lines between the fences, joined by '\n', untouched
};

/// The entries of `source` in their order.
///   throws  AtmoError where brackets or fences don't match, or a line is neither entry nor comment
std::vector<Entry> readEntries(const Source& source);

/// `key` as it is compared: small letters; blanks, hyphens and underscores dropped; Angstrom's accents and the micro
/// sign in ASCII.
std::string comparable(std::string_view key);

} // namespace sky::atmo
