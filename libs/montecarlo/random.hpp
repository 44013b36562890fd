#pragma once
// Random numbers of our own, so that a seed gives the same answer with every compiler and standard library.

#include <array>
#include <bit>
#include <cstdint>

namespace sky::montecarlo {

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection of 64-bit words that scatters neighbouring inputs.
constexpr std::uint64_t scramble(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// xoshiro256++ (Blackman, Vigna 2019). One independent stream per (seed, stream) pair.
class Random
{
public:
    Random(std::uint64_t seed, std::uint64_t stream)
    {
        std::uint64_t x = scramble(seed) ^ scramble(stream * 0xd1342543de82ef95u + 1);
        for (auto& word : state_)
            word = x = scramble(x);
    }

    std::uint64_t word()
    {
        const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
        const std::uint64_t t = state_[1] << 17;
        state_[2] ^= state_[0];
        state_[3] ^= state_[1];
        state_[1] ^= state_[2];
        state_[0] ^= state_[3];
        state_[2] ^= t;
        state_[3] = std::rotl(state_[3], 45);
        return result;
    }

    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(word() >> 11) * 0x1p-53; }

private:
    std::array<std::uint64_t, 4> state_{};
};

} // namespace sky::montecarlo
