#pragma once
// Sixteen floats that are computed together: eight wavelengths of eclipsed light, then the same of uneclipsed light.

#include "base/lanes.hpp"

namespace sky::eclipse {

constexpr int waves = 8;         ///< wavelengths of a group
constexpr int lanes = 2 * waves; ///< eclipsed, uneclipsed

using Lane = float __attribute__((vector_size(lanes * sizeof(float))));

using Lanes = base::VectorsOf<Lane>;

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
