#pragma once
// Sixteen floats that are computed together: eight wavelengths of eclipsed light, then the same of uneclipsed light.

#include "base/lanes.hpp"
#include <cstddef>
#include <new>
#include <vector>

namespace sky::eclipse {

constexpr int waves = 8;         ///< wavelengths of a group
constexpr int lanes = 2 * waves; ///< eclipsed, uneclipsed

using Lane = float __attribute__((vector_size(lanes * sizeof(float))));

/// std::allocator forgets that vectors want aligned memory.
template<class Value>
struct AlignedAllocator {
    using value_type = Value;
    static constexpr std::align_val_t alignment{lanes * sizeof(float)};
    AlignedAllocator() = default;
    template<class Other>
    AlignedAllocator(const AlignedAllocator<Other>&)
    {
    }
    Value* allocate(std::size_t count) { return static_cast<Value*>(::operator new(count * sizeof(Value), alignment)); }
    void deallocate(Value* memory, std::size_t) { ::operator delete(memory, alignment); }
    bool operator==(const AlignedAllocator&) const { return true; }
};
using Lanes = std::vector<Lane, AlignedAllocator<Lane>>;

inline int groupsOf(int wavelengths) { return (wavelengths + waves - 1) / waves; }

/// The same number for eclipsed and uneclipsed light of each wavelength of a group; beyond the last wavelength 0.
template<class Number>
void fillLane(Lane& lane, const Number* values, int group, int wavelengths)
{
    for (int i = 0; i < waves; ++i) {
        const int w = group * waves + i;
        lane[i] = lane[waves + i] = w < wavelengths ? static_cast<float>(values[w]) : 0.f;
    }
}

} // namespace sky::eclipse
