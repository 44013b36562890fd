#pragma once
// The table of an eclipse's light: what it is called, and for which eclipses it holds.

#include "model/manifest.hpp"
#include "physics/eclipse.hpp"

namespace sky::model {

/// Light of orders 2 and up while Sun and Moon stand concentric before the camera (docs/format.md).
constexpr const char* eclipseTable = "eclipsed-double-scattering";

/// The largest departure from concentric discs of the table's sizes for which the table is taken, over the difference of both radii.
constexpr double eclipseTableMargin = 0.03;

/// True if bodies stand as the table has them: the separation of the discs and the differences of their radii from the table's add up to
/// at most eclipseTableMargin. Farther aside one side of the horizon is brighter than the other, which no table of concentric discs knows.
///   throws  RangeError where the Moon can't be there
bool eclipseTableFits(const Manifest& manifest, const physics::EclipseBodies& bodies);

} // namespace sky::model
