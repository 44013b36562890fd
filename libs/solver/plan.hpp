#pragma once
#include "model/manifest.hpp"
#include "physics/optics.hpp"
#include "solver/field_work.hpp"
#include "solver/solve.hpp"

namespace sky::solver {

/// What a run has to compute, after leaving out what was not asked for and what the scene does not need.
struct Needs {
    bool severalOrders = false; ///< than light scattered once
    bool field = false, everyEvent = false;
    bool moments = false, transmittance = false, irradiance = false, single = false, multiple = false, eclipsed = false,
         lightPollution = false;
    std::vector<model::Skipped> skipped;
};
Needs needsOf(const atmo::Description& description, const Options& options);

/// Estimated seconds of each stage on two cores of a software driver, for the progress bar and --dry-run.
struct Work {
    double medium = 0, sunlight = 0, moments = 0, transmittance = 0, irradiance = 0, single = 0, multiple = 0, eclipsed = 0,
           lightPollution = 0, debugging = 0, writing = 0;
    double total() const
    {
        return medium + sunlight + moments + transmittance + irradiance + single + multiple + eclipsed + lightPollution + debugging +
               writing;
    }
};
/// \param field, medium  as long as they are not known, the times of the moments and of the table of eclipses are guesses
Work workOf(const atmo::Description& description, const Options& options, const Needs& needs, const FieldWork* field = nullptr,
            const physics::Medium* medium = nullptr);

/// Bytes of results that may be gathered at a time under --max-memory: a quarter of what the fixed needs leave, since results exist on the
/// GPU, in its copy, where they go to, and while that is written. 0: no bound.
std::size_t resultBytes(const Options& options);

} // namespace sky::solver
