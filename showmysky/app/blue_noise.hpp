#pragma once

#include <vector>

namespace showmysky::app {

/// Dither thresholds without low frequencies, on a torus: each of the values (k + 1/2) / side^2 once.
///   side     pixels, at least 4; the work grows as side^4: 0.1 s for 64
///   returns  [side][side], 0..1 exclusive
///   source   Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913 (1993)
std::vector<float> blueNoise(int side);

} // namespace showmysky::app
