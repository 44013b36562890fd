#include "blue_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace showmysky::app {

namespace {

/// Ones on a torus, and how crowded each place is: the sum of a Gaussian around every one.
class Pattern
{
public:
    explicit Pattern(int side) : side_(side), ones_(size()), crowding_(size(), 0.f), kernel_(size())
    {
        constexpr float sigma = 1.5f; // pixels, as in the paper
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const auto dx = static_cast<float>(std::min(x, side - x)), dy = static_cast<float>(std::min(y, side - y));
                kernel_[index(x, y)] = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
            }
    }

    std::size_t size() const { return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_); }
    bool at(std::size_t place) const { return ones_[place] != 0; }

    void set(std::size_t place, bool one)
    {
        ones_[place] = one;
        const int px = static_cast<int>(place) % side_, py = static_cast<int>(place) / side_;
        const float sign = one ? 1.f : -1.f;
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x)
                crowding_[index(x, y)] += sign * kernel_[index((x - px + side_) % side_, (y - py + side_) % side_)];
    }
    std::size_t tightestCluster() const { return extreme(true, -1.f); }
    std::size_t largestVoid() const { return extreme(false, 1.f); }

private:
    std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
    }
    /// Among places of that kind, the one with the least sign * crowding.
    std::size_t extreme(bool one, float sign) const
    {
        std::size_t best = size();
        for (std::size_t i = 0; i < size(); ++i)
            if (at(i) == one && (best == size() || sign * crowding_[i] < sign * crowding_[best]))
                best = i;
        return best;
    }

    int side_;
    std::vector<std::uint8_t> ones_;
    std::vector<float> crowding_, kernel_;
};

} // namespace

std::vector<float> blueNoise(int side)
{
    Pattern start(side);
    const std::size_t count = start.size(), first = count / 10;
    std::uint32_t random = 1;
    for (std::size_t placed = 0; placed < first;) {
        random = random * 1664525u + 1013904223u; // Numerical Recipes' generator: any scatter will do
        const std::size_t place = (random >> 8) % count;
        if (!start.at(place)) {
            start.set(place, true);
            ++placed;
        }
    }
    // Move ones from clusters into voids until they are evenly spread.
    for (;;) {
        const std::size_t cluster = start.tightestCluster();
        start.set(cluster, false);
        const std::size_t gap = start.largestVoid();
        start.set(gap, true);
        if (gap == cluster)
            break;
    }
    std::vector<float> thresholds(count);
    const auto rank = [&](std::size_t place, std::size_t value) {
        thresholds[place] = (static_cast<float>(value) + 0.5f) / static_cast<float>(count);
    };
    Pattern fewer = start;
    for (std::size_t value = first; value-- > 0;) {
        const std::size_t cluster = fewer.tightestCluster();
        fewer.set(cluster, false);
        rank(cluster, value);
    }
    for (std::size_t value = first; value < count; ++value) {
        const std::size_t gap = start.largestVoid();
        start.set(gap, true);
        rank(gap, value);
    }
    return thresholds;
}

} // namespace showmysky::app
