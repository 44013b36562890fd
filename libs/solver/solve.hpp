#pragma once
// The main job: a description in, a model directory out.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "atmo/description.hpp"

namespace sky::gl {
class HeadlessContext;
}

namespace sky::physics {
struct Medium;
}

namespace sky::solver {

/// Parts of a model that can be asked for or left out.
enum class Part { Moments, Transmittance, Irradiance, Single, Multiple, LightPollution, Eclipsed };

/// All parts, in the order in which they are listed for people.
inline const std::vector<Part>& allParts()
{
    static const std::vector<Part> parts{Part::Moments,  Part::Transmittance,  Part::Irradiance, Part::Single,
                                         Part::Multiple, Part::LightPollution, Part::Eclipsed};
    return parts;
}

/// The name of a part on the command line and in manifests.
inline std::string nameOf(Part part)
{
    switch (part) {
    case Part::Moments: return "moments";
    case Part::Transmittance: return "transmittance";
    case Part::Irradiance: return "irradiance";
    case Part::Single: return "single";
    case Part::Multiple: return "multiple";
    case Part::LightPollution: return "light-pollution";
    case Part::Eclipsed: return "eclipsed";
    }
    return {};
}

struct Options {
    std::set<Part> parts{allParts().begin(), allParts().end()}; ///< what to write
    bool radiance = false;                                      ///< spectral tables instead of XYZW
    int texturePrecisionBits = 11;                              ///< significand bits kept in 3D textures, 1..24
    std::optional<std::pair<int, int>> altitudeLayers;          ///< first and last layer to bake, counted from 0
    std::optional<double> tolerance;                            ///< relative; below it orders and harmonics stop
    std::string quality = "normal";                             ///< draft, normal, fine, reference
    bool qualityByTolerance = false;                            ///< replace it by the cheapest predicted to reach the tolerance
    std::optional<double> predictedError;                       ///< of a quality that was picked so: see settled()
    bool saveIrradianceOrders = false;
    bool saveScatteringDensity = false;
    bool saveScatteringDensity2FromGround = false;
    bool saveDeltaScattering = false;
    bool saveAccumulatedScattering = false;
    bool saveLightPollution = false;
    std::size_t maxMemoryBytes = 0; ///< 0: no bound
};

/// Hears how the work goes on. Fractions are of the whole work done so far, 0..1, and never fall.
struct Progress {
    virtual ~Progress() = default;
    /// A stage begins when `fractionOfAll` is done.
    virtual void stage(const std::string& name, double fractionOfAll) = 0;
    virtual void advance(double fractionOfAll) = 0;
    /// True once the user wants to stop; ask often, then throw Cancelled.
    virtual bool cancelled() const = 0;
    virtual void warning(const std::string& sentence) = 0;
    /// Something to know that is no reason to worry.
    virtual void remark(const std::string&) {}
};

/// One thing that a run would compute or skip.
struct PlanItem {
    std::string what;
    bool computed = true;
    std::string why;             ///< why it is skipped, or why it takes this form
    std::size_t memoryBytes = 0; ///< while it is computed
    std::size_t diskBytes = 0;
    double seconds = 0; ///< estimate
};

/// What solve() would do with the same arguments. A quality that is to be picked must be settled() before.
///   medium  from evaluateMedium(); without it, where there is no OpenGL, the moments' time and size are those of the sample Earth
std::vector<PlanItem> plan(const atmo::Description& description, const Options& options, const physics::Medium* medium = nullptr);
/// A sentence where what can't be split takes more than --max-memory.
std::optional<std::string> beyondMemory(const std::vector<PlanItem>& plan, const Options& options);

/// Computes the model and puts it into `outDir` in one step at the end: whatever happens before, an old model stays whole.
///   throws  Cancelled, AtmoError (the GLSL blocks), GlError, NumericsError, FileError
void solve(const atmo::Description& description, const Options& options, gl::HeadlessContext& context, const std::filesystem::path& outDir,
           Progress& progress);

/// Compiles the description's GLSL blocks.
///   throws  AtmoError with the line of the .atmo file
void validate(const atmo::Description& description, gl::HeadlessContext& context);

} // namespace sky::solver
