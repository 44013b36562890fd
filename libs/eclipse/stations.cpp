#include "eclipse/stations.hpp"
#include <algorithm>
#include <cmath>

namespace sky::eclipse {

namespace {

/// What the chord from node `a` to node `b` adds to the light of the nodes in between, of all light.
double chordError(const std::vector<Place>& nodes, const std::vector<double>& weight, std::size_t a, std::size_t b, double scale)
{
    double error = 0;
    for (std::size_t k = a + 1; k < b; ++k)
        error += 0.5 * weight[k] * static_cast<double>((nodes[k].distance - nodes[a].distance) * (nodes[b].distance - nodes[k].distance));
    return error / (scale * scale);
}

/// Nodes that become stations: the first, the last, and of the others as few as possible with chords that cost at most `most` each.
///   error  gets the sum of what they cost
std::vector<std::size_t> chosen(const std::vector<Place>& nodes, const std::vector<double>& weight, double scale, double most,
                                double& error)
{
    std::vector<std::size_t> result{0};
    error = 0;
    for (std::size_t b = 1; b < nodes.size(); ++b) {
        if (b + 1 < nodes.size() && chordError(nodes, weight, result.back(), b + 1, scale) <= most)
            continue;
        error += chordError(nodes, weight, result.back(), b, scale);
        result.push_back(b);
    }
    return result;
}

/// The same such that all chords together cost `tolerance` at most.
std::vector<std::size_t> chosen(const std::vector<Place>& nodes, const std::vector<double>& weight, double scale, double tolerance)
{
    double most = tolerance, error = 0;
    auto result = chosen(nodes, weight, scale, most, error);
    for (; error > tolerance; most *= 0.8)
        result = chosen(nodes, weight, scale, 0.8 * most, error);
    return result;
}

} // namespace

Sharing shareOut(const std::vector<Place>& nodes, const std::vector<double>& weight, const double scale, const double tolerance)
{
    Sharing result;
    if (nodes.empty())
        return result;
    const auto stations = chosen(nodes, weight, scale, tolerance);
    std::vector<Sharing::Part> at; // of one station: entries are levels until all are known
    for (std::size_t s = 0; s < stations.size(); ++s) {
        at.clear();
        const float here = nodes[stations[s]].distance;
        const std::size_t first = s > 0 ? stations[s - 1] + 1 : 0, end = s + 1 < stations.size() ? stations[s + 1] : nodes.size();
        for (std::size_t k = first; k < end; ++k) {
            float share = 1;
            if (k != stations[s]) {
                const float other = nodes[stations[k < stations[s] ? s - 1 : s + 1]].distance;
                share = other == here ? 0.5f : (nodes[k].distance - other) / (here - other);
            }
            const Place& place = nodes[k];
            at.push_back({static_cast<int>(k), place.level, share * (1 - place.share)});
            at.push_back({static_cast<int>(k), place.level + 1, share * place.share});
        }
        std::erase_if(at, [](const Sharing::Part& part) { return part.share == 0; });
        std::vector<int> levels;
        for (const auto& part : at)
            levels.push_back(part.entry);
        std::sort(levels.begin(), levels.end());
        levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
        auto& all = result.places.levels;
        const int before = static_cast<int>(all.size());
        for (auto& part : at)
            part.entry = before + static_cast<int>(std::lower_bound(levels.begin(), levels.end(), part.entry) - levels.begin());
        result.parts.insert(result.parts.end(), at.begin(), at.end());
        all.insert(all.end(), levels.begin(), levels.end());
        result.places.stations.push_back({here, before, static_cast<int>(levels.size())});
    }
    return result;
}

} // namespace sky::eclipse
