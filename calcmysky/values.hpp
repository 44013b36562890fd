#pragma once
// What stands behind an option, as typed values; and numbers as people read them.

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/solve.hpp"

namespace sky::cli {

// Each reader takes the option's name for its message, and throws UsageError with a whole sentence.

/// Whole number within `first`..`last`.
int readInteger(const std::string& option, const std::string& text, int first, int last);
/// Number above 0 and below 1.
double readFraction(const std::string& option, const std::string& text);
/// "moments,single": parts by name, separated by commas.
std::set<solver::Part> readParts(const std::string& option, const std::string& text);
/// "3..7" or "3": first and last altitude layer.
std::pair<int, int> readLayers(const std::string& option, const std::string& text);
/// "1500", "512M", "1.5GiB": bytes. K, M, G, T are powers of 1024 with or without iB; kB, MB, GB, TB powers of 1000.
std::size_t readSize(const std::string& option, const std::string& text);
/// One of `choices`; returns its index.
std::size_t readChoice(const std::string& option, const std::string& text, const std::vector<std::string>& choices);

/// "12.3 MB"; "0 B" is "-".
std::string formatSize(std::size_t bytes);
/// "0.25 s", "42 s", "3 min 05 s", "2 h 07 min".
std::string formatDuration(double seconds);

} // namespace sky::cli
