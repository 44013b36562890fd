#pragma once
#include "physics/directions.hpp"
#include "physics/optics.hpp"
#include "solver/bake.hpp"
#include <string>
#include <vector>

namespace sky::solver {

/// How finely to compute, as one choice. Points of the measured front of time against error: docs/accuracy.
struct Quality {
    physics::MomentSettings moments;
    BakeSettings bake;
};

/// Names of the points of the front, from the cheapest to the finest: draft, normal, fine, reference and what lies between them.
const std::vector<std::string>& qualityNames();

/// \param name   one of qualityNames()                throws UsageError
/// \param medium    what it holds decides the degree: molecules alone need 2; peaks that are truncated more than the rest
/// \param tolerance drops harmonics that change less than this share of the light; 0: only those that are not there
Quality qualityFor(const std::string& name, const physics::Medium& medium, double tolerance = 0);

/// Time of the moments at this quality, by that of `normal`.
double relativeWork(const std::string& quality);

/// Kinds of air by what makes them hard, from the easiest on.
enum class Air {
    Clear,  ///< a phase function of degree 2 or less: molecules
    Dusty,  ///< sharper ones, of which nothing is truncated
    Dense,  ///< no peak truncated, and an optical depth of scattering above 1.2
    Hazy,   ///< truncated peaks in an optical depth of scattering up to 1.2
    Sharp,  ///< peaks there, truncated or not, of which most is beyond all harmonics
    Cloudy, ///< and above
};
Air airOf(const physics::Medium& medium);

/// A quality that a tolerance picked.
struct Pick {
    std::string quality;
    double predictedError; ///< rms, relative, of the radiance from moments in the worst of day, sunset and twilight: docs/accuracy
    bool reached;          ///< predictedError <= tolerance
    std::string sentence;  ///< all that, for people
};

/// The cheapest quality predicted to reach `tolerance` in such air; where none is, the cheapest of those that err least.
Pick pickQuality(double tolerance, const physics::Medium& medium);

/// Sentences about scatterers that throw more than 3/4 of their light into a peak that harmonics don't hold, a few degrees wide, where together
/// they do most of the scattering: to the solver such light goes straight on, or is blurred over ten degrees. Sunlight scattered
/// once is exact all the same but for a Sun near the horizon, so the sentence is only for air that also scatters light of the ground, or light
/// scattered before: above a ground that reflects, or where the horizontal ray is deep. More harmonics don't help (docs/stress.md).
std::vector<std::string> unresolvedPeaks(const physics::Medium& medium);

/// `options` with their quality picked, where they ask for that. Tells `progress` what and why.
Options settled(Options options, const physics::Medium& medium, Progress& progress);

/// From which change on orders and harmonics are dropped. A picked quality leaves them a quarter of the tolerance: in the root of the
/// sum of squares, next to what the grid takes, that is 3 %.
double orderTolerance(const Options& options);

} // namespace sky::solver
