#include "base/suggest.hpp"

#include <algorithm>

namespace sky {

int editDistance(std::string_view a, std::string_view b)
{
    // Three rows of the table of distances between prefixes (optimal string alignment).
    std::vector<int> beforeLast, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int replaced = last[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
        }
        beforeLast = last;
        last = row;
    }
    return last[b.size()];
}

std::string closest(std::string_view word, const std::vector<std::string>& candidates)
{
    std::string best;
    int bestDistance = static_cast<int>(word.size()) / 3 + 1;
    for (const std::string& candidate : candidates) {
        const int distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            best = candidate;
            bestDistance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates)
{
    const std::string best = closest(word, candidates);
    return best.empty() ? std::string() : " Did you mean `" + best + "`?";
}

} // namespace sky
