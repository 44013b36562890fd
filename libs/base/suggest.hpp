#pragma once
// "Did you mean ...?"

#include <string>
#include <string_view>
#include <vector>

namespace sky {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
int editDistance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or "" where none is near: at most a third of the word's letters may be wrong.
std::string closest(std::string_view word, const std::vector<std::string>& candidates);

/// " Did you mean `x`?" where a candidate is near, "" otherwise: ready to end an error message with.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

} // namespace sky
