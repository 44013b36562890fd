#pragma once
// Where a sky is looked at to tell how good a model of it is: places that matter, on a planet of any size.

#include <vector>

#include "montecarlo/reference.hpp"
#include "physics/medium.hpp"

namespace sky::cli {

enum class Regime { Day, Sunset, Twilight };
inline constexpr Regime allRegimes[] = {Regime::Day, Regime::Sunset, Regime::Twilight};
const char* nameOf(Regime regime);

/// Altitudes and ranges of the Sun that correspond to those of the Earth: altitudes scale with the thickness of the air that
/// scatters anything worth seeing, depths of the Sun with the dip of the horizon seen from its upper end.
struct SampleScale {
    std::vector<double> altitudes; ///< m: ground, and like 2, 12 and 60 km; the top of the atmosphere, which sees what space does
    struct Range {
        double low, high; ///< elevation of the Sun's centre, rad
    } suns[3];            ///< by Regime; on the Earth 90..4, 4..-1 and -1..-6 degrees
};
SampleScale sampleScale(const physics::Medium& medium);

struct Sample {
    Regime regime = Regime::Day;
    int altitudeIndex = 0; ///< into SampleScale::altitudes
    montecarlo::Query query;
};

/// `rowsPerCell` samples in each cell of regime and altitude, spread evenly by a low-discrepancy sequence: denser towards the
/// horizon, a quarter of them downwards where the camera is not on the ground, none within 5 degrees of the Sun. From the top of the atmosphere a
/// quarter looks through the limb and all others down, which tells even of air that lets no light to the ground. Wavelengths without sunlight are
/// left out. The same medium always gives the same samples, and more rows begin with fewer.
std::vector<Sample> sampleSky(const physics::Medium& medium, int rowsPerCell);

} // namespace sky::cli
