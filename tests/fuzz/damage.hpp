#pragma once
#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// One of the texts with one to four random damages: a byte replaced, a piece cut out, a piece put in elsewhere too, or a mark of the language inserted.
///   marks  characters that mean something to the reader under test
inline std::string damaged(const std::vector<std::string>& texts, std::string_view marks, std::mt19937& engine)
{
    const auto below = [&](std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(engine); };
    std::string text = texts[below(texts.size())];
    for (std::size_t damage = below(4) + 1; damage > 0 && !text.empty(); --damage) {
        const std::size_t at = below(text.size()), length = std::min<std::size_t>(below(40) + 1, text.size() - at);
        switch (below(4)) {
        case 0: text[at] = static_cast<char>(below(256)); break;
        case 1: text.erase(at, length); break;
        case 2: text.insert(below(text.size()), text.substr(at, length)); break;
        default: text.insert(at, 1, marks[below(marks.size())]);
        }
    }
    return text;
}

} // namespace fuzz
