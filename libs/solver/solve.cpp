// From a description to a model directory: the stages, in the order of the method (docs/method).

#include "solver/solve.hpp"
#include "atmo/write.hpp"
#include "base/error.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "physics/table_axes.hpp"
#include "solver/bake.hpp"
#include "solver/debug_tables.hpp"
#include "solver/eclipse_table.hpp"
#include "solver/light_pollution.hpp"
#include "solver/medium_tables.hpp"
#include "solver/plan.hpp"
#include "solver/quality.hpp"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace sky::solver {

namespace {

/// True never, for work that asks many times: throws.
bool stopIfCancelled(const Progress& progress)
{
    if (progress.cancelled())
        throw Cancelled("Stopped on request; nothing was written.");
    return false;
}

/// Shares of the whole work for the progress bar, and the point where a user may stop.
class Stages
{
public:
    Stages(Progress& progress, const Work& work) : progress_(progress), work_(work), whole_(work.total()) {}
    /// Begins a stage that takes `seconds` of the estimate; the returned function reports its progress and throws if cancelled.
    std::function<void(double)> begin(const std::string& name, double seconds)
    {
        check();
        const double from = done_;
        done_ += seconds;
        progress_.stage(name, reached(from));
        return [this, from, seconds](double fraction) {
            check();
            progress_.advance(reached(from + seconds * fraction));
        };
    }
    const Work& work() const { return work_; }
    /// Once more is known of what will be done. The fractions that were told don't fall.
    void reestimate(const Work& work)
    {
        work_ = work;
        whole_ = work.total();
    }

private:
    void check() const { stopIfCancelled(progress_); }
    double reached(double seconds)
    {
        fraction_ = std::clamp(seconds / whole_, fraction_, 1.);
        return fraction_;
    }
    Progress& progress_;
    Work work_;
    double whole_, done_ = 0, fraction_ = 0;
};

model::Manifest describe(const atmo::Description& description, const Options& options, const physics::Medium& medium)
{
    model::Manifest manifest;
    manifest.generator = "calcmysky " SKY_VERSION;
    model::describeMedium(manifest, medium);
    manifest.sunDistance = description.sunDistance;
    manifest.moonDistance = description.moonDistance;
    manifest.moonRadius = description.moonRadius;
    for (std::size_t s = 0; s < description.scatterers.size(); ++s) {
        const auto type = description.scatterers[s].phaseFunctionType;
        manifest.species[s].phaseFunctionType = type == atmo::PhaseFunctionType::General      ? "general"
                                                : type == atmo::PhaseFunctionType::Achromatic ? "achromatic"
                                                                                              : "smooth";
    }
    manifest.scatteringOrders = description.scatteringOrders;
    manifest.allScatteringOrders = description.allScatteringOrders;
    manifest.settings["quality"] = options.quality;
    if (options.tolerance)
        manifest.settings["tolerance"] = (std::ostringstream() << *options.tolerance).str();
    if (options.predictedError)
        manifest.estimatedError["rms, as predicted"] = *options.predictedError;
    manifest.settings["radiance"] = options.radiance ? "yes" : "no";
    manifest.settings["texture-save-precision"] = std::to_string(options.texturePrecisionBits);
    // What a renderer needs to know of tables that it fills itself.
    manifest.settings["eclipse.azimuths"] = std::to_string(description.eclipsedScatteringSize.relativeAzimuth);
    manifest.settings["eclipse.views"] = std::to_string(description.eclipsedScatteringSize.viewZenithAngle);
    return manifest;
}

std::string notEnded(const RadiationField& field)
{
    std::ostringstream text;
    text << "Light scattered any number of times had not ended after " << field.eventCount << " events: as the last ones changed it, "
         << std::fixed << std::setprecision(field.remainder < 0.1 ? 1 : 0) << 100 * field.remainder << " % may be missing.";
    return text.str();
}

} // namespace

void solve(const atmo::Description& description, const Options& asked, gl::HeadlessContext& context, const std::filesystem::path& outDir,
           Progress& progress)
{
    const gl::Api& api = context.api();
    const Needs needs = needsOf(description, asked);
    Stages stages(progress, workOf(description, asked, needs, nullptr));
    model::ModelWriter writer(outDir);

    // 1. The medium as tables.
    auto breath = stages.begin("medium", stages.work().medium);
    std::vector<std::string> warnings;
    const physics::Medium medium = evaluateMedium(description, api, warnings);
    const auto glow = glowSpectrum(description, warnings);
    for (const auto& sentence : warnings)
        progress.warning(sentence);
    const Options options = settled(asked, medium, progress);
    std::optional<FieldWork> fieldWork;
    if (needs.field)
        fieldWork = fieldWorkOf(medium, options, description.allScatteringOrders ? 0 : description.scatteringOrders);
    if (options.maxMemoryBytes > 0)
        if (const auto sentence = beyondMemory(plan(description, options, &medium), options))
            progress.warning(*sentence);
    stages.reestimate(workOf(description, options, needs, fieldWork ? &*fieldWork : nullptr, &medium));
    model::Manifest manifest = describe(description, options, medium);
    manifest.lightPollutionRadiance = glow;
    manifest.warnings = warnings;
    manifest.skipped = needs.skipped;
    model::writeMedium(writer, medium);
    writer.text("description.atmo", atmo::write(description));

    // 2. Optics, and sunlight at every altitude.
    breath = stages.begin("sunlight", stages.work().sunlight);
    Quality quality = qualityFor(options.quality, medium, orderTolerance(options));
    quality.moments.truncatePeaks = quality.moments.truncatePeaks && needs.severalOrders; // light in a peak would count as not scattered
    const physics::Profile profile(medium);
    const physics::Optics optics = physics::makeOptics(medium, quality.moments.degree, quality.moments.truncatePeaks);
    const base::StopRequest stop = [&progress] { return stopIfCancelled(progress); };
    const physics::SunTable sun(profile, optics, medium.sunAngularRadius, physics::SunTable::usualAltitudes,
                                physics::SunTable::usualElevations, stop);
    const Scene scene{medium, profile, optics, sun, stop};
    const physics::MomentGrid grid(profile, physics::largestExtinctions(optics), quality.moments.altitudes, quality.moments.suns,
                                   medium.sunAngularRadius);
    const auto sunAxis = physics::sunTableAxis(grid.darkDepth(),
                                               physics::sunsetShare(profile, physics::largestExtinctions(optics), medium.sunAngularRadius));
    const BakeJob job{description, options, scene, quality.bake, sunAxis, description.scatteringSize};
    model::describeOptics(manifest, optics, quality.moments.truncatePeaks);
    const auto warn = [&](const std::string& sentence) {
        manifest.warnings.push_back(sentence);
        progress.warning(sentence);
    };
    for (const auto& sentence : unresolvedPeaks(medium))
        warn(sentence);

    // 3. The radiation field: moments of every event, summed.
    RadiationField field;
    if (needs.field) {
        breath = stages.begin("moments", stages.work().moments);
        const OrderLimit limit{std::max(2, description.scatteringOrders), description.allScatteringOrders, orderTolerance(options)};
        field = iterate(api, scene, grid, quality.moments, limit, needs.everyEvent, breath, resultBytes(options));
        manifest.settings["moments.events"] = std::to_string(field.eventCount);
        if (limit.all || options.tolerance)
            manifest.estimatedError["orders left out"] = field.remainder;
        if (!field.ended)
            warn(notEnded(field));
        if (needs.moments)
            model::writeMoments(writer, "moments", field.total);
    }

    // 4. Tables that were asked for.
    if (needs.transmittance) {
        breath = stages.begin("transmittance", stages.work().transmittance);
        bakeTransmittance(job, writer);
    }
    if (needs.irradiance) {
        breath = stages.begin("irradiance", stages.work().irradiance);
        bakeIrradiance(job, needs.field ? &field : nullptr, options.saveIrradianceOrders, writer);
    }
    if (needs.single) {
        breath = stages.begin("single scattering", stages.work().single);
        bakeSingleScattering(api, job, writer, breath);
    }
    if (needs.multiple) {
        breath = stages.begin("multiple scattering", stages.work().multiple);
        bakeMultipleScattering(api, job, field.total, "multiple-scattering", "multiple scattering", writer, breath);
    }
    if (needs.eclipsed) {
        breath = stages.begin("eclipses", stages.work().eclipsed);
        bakeEclipsed(api, job, field.total, writer, breath);
    }
    if (needs.lightPollution) {
        breath = stages.begin("light pollution", stages.work().lightPollution);
        bakeLightPollution(description, options, medium, glow, writer, manifest, breath);
    }
    if (needs.everyEvent) {
        breath = stages.begin("debugging tables", stages.work().debugging);
        writeDebugTables(api, job, field, writer, breath);
    }

    breath = stages.begin("writing", stages.work().writing);
    writer.commit(manifest, breath);
}

void validate(const atmo::Description& description, gl::HeadlessContext& context)
{
    std::vector<std::string> warnings;
    evaluateMedium(description, context.api(), warnings);
}

} // namespace sky::solver
