#pragma once
// A table of reference radiances (tests/reference/README.md) and the regimes by which errors are reported.

#include "model/evaluate.hpp"
#include "verify_samples.hpp"
#include <string>
#include <vector>

namespace sky::bench {

struct ReferenceRow {
    model::SkyGeometry geometry;
    double wavelengthNm;
    double radiance; ///< single + multiple, per unit solar irradiance
    double noise;    ///< one standard error of it
};

/// Rows that the judge could not tell to 5 % are left out, as `calcmysky verify` does.   throws FileError
std::vector<ReferenceRow> readReference(const std::string& path);

inline constexpr const char* regimeNames[] = {"day", "sunset", "twilight"};
/// Index into regimeNames; on the Earth day up to SZA 86 degrees, sunset to 91, twilight beyond.
int regimeOf(const ReferenceRow& row, const cli::SampleScale& scale);
/// Seen from where most of the air is below: from 9.6 km on above the Earth.
bool isHigh(const ReferenceRow& row, const cli::SampleScale& scale);

/// Index of the row's wavelength; -1 where the model has no such one.
int wavelengthIndex(const ReferenceRow& row, const std::vector<double>& wavelengthsNm);

} // namespace sky::bench
