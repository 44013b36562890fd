#pragma once
// Bins that are narrow where much happens: a few sums on the bits of a number find one.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace sky::montecarlo {

/// Bins of a number, crowded about 0: even ones within +-scale, then as many in each octave of |x| / scale + 1.
template<int perOctaveBits>
class CrowdedBins
{
public:
    ///   low  <= 0 <= high
    CrowdedBins(double scale, double low, double high) : scale_(scale), below_(stepsTo(-low) + 1), above_(stepsTo(high) + 1) {}

    int count() const { return below_ + above_; }
    /// The bin of x; the first or the last where x lies beyond.
    int of(double x) const
    {
        const int steps = stepsTo(std::abs(x));
        return below_ + (x < 0 ? -1 - std::min(steps, below_ - 1) : std::min(steps, above_ - 1));
    }
    double middle(int bin) const
    {
        const int steps = bin < below_ ? below_ - 1 - bin : bin - below_;
        const auto bits = (static_cast<std::uint64_t>(steps) << shift) + (std::uint64_t{1} << (shift - 1)) + one;
        return (bin < below_ ? -scale_ : scale_) * (std::bit_cast<double>(bits) - 1);
    }

private:
    static constexpr int shift = 52 - perOctaveBits; // the leading bits of a double are its octave and the place therein
    static constexpr std::uint64_t one = std::bit_cast<std::uint64_t>(1.);
    int stepsTo(double x) const { return static_cast<int>((std::bit_cast<std::uint64_t>(x / scale_ + 1) - one) >> shift); }

    double scale_;
    int below_, above_;
};

} // namespace sky::montecarlo
