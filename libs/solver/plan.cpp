#include "solver/plan.hpp"
#include "physics/sun.hpp"
#include "solver/eclipse_table.hpp"
#include "solver/light_pollution.hpp"
#include "solver/quality.hpp"
#include <algorithm>
#include <iomanip>
#include <sstream>

namespace sky::solver {

namespace {

/// Visits of a ray's node per second for one set of four wavelengths, a rough guess for llvmpipe on two cores.
constexpr double directVisits = 1.6e8, scatteredVisits = 8e7;

/// Bytes of the program with a driver in software; what a stage takes is beyond that.
constexpr double process = 90e6;

bool anyPositive(const atmo::Spectrum& spectrum)
{
    return std::any_of(spectrum.begin(), spectrum.end(), [](double v) { return v > 0; });
}

/// False for particles that only absorb, or do nothing: no table is made for them.
bool scattersLight(const atmo::Scatterer& s) { return s.crossSectionAt1um > 0 && anyPositive(s.singleScatteringAlbedo); }

double layersOf(const atmo::SizeScattering& s, const Options& options)
{
    return options.altitudeLayers ? options.altitudeLayers->second - options.altitudeLayers->first + 1 : s.altitude;
}

double texels(const atmo::SizeScattering& s, const Options& options)
{
    return double(s.viewZenithAngle) * s.dotViewSun * s.sunZenithAngle * layersOf(s, options);
}

/// Of the table of direct sunlight, as solve() makes it.
physics::SunTable::Cost sunlightOf(const physics::Medium& medium, const Options& options, const Needs& needs)
{
    const auto settings = qualityFor(options.quality, medium, orderTolerance(options)).moments;
    const auto optics = physics::makeOptics(medium, settings.degree, settings.truncatePeaks && needs.severalOrders);
    return physics::SunTable::costOf(physics::Profile(medium), optics, medium.sunAngularRadius);
}

/// Of densities and phase functions.
double bytesOf(const physics::Medium& medium)
{
    double values = 0;
    for (const auto& species : medium.species)
        values += double(species.numberDensity.size()) + double(species.phaseFunction.size());
    return values * sizeof(double);
}

/// 0: all
int ordersOf(const atmo::Description& d) { return d.allScatteringOrders ? 0 : d.scatteringOrders; }

std::string qualityOf(const Options& options)
{
    std::ostringstream text;
    text << "quality " << options.quality;
    if (options.predictedError)
        text << ", predicted error " << std::setprecision(2) << 100 * *options.predictedError << " %";
    return text.str();
}

} // namespace

Needs needsOf(const atmo::Description& d, const Options& options)
{
    Needs n;
    const auto has = [&](Part part) { return options.parts.count(part) > 0; };
    const bool scatters = std::any_of(d.scatterers.begin(), d.scatterers.end(), scattersLight);
    const bool lit = anyPositive(d.solarIrradiance), several = d.allScatteringOrders || d.scatteringOrders > 1;
    n.severalOrders = several;
    const auto decide = [&](bool& flag, Part part, bool possible, const std::string& why) {
        flag = has(part) && possible;
        if (!flag)
            n.skipped.push_back({nameOf(part), has(part) ? why : "not asked for"});
    };
    const std::string dark = !lit ? "the Sun gives no light" : "nothing in this atmosphere scatters";
    decide(n.transmittance, Part::Transmittance, true, "");
    decide(n.irradiance, Part::Irradiance, lit, dark);
    decide(n.single, Part::Single, scatters && lit, dark);
    decide(n.moments, Part::Moments, scatters && lit && several, several ? dark : "a single order needs no moments");
    decide(n.multiple, Part::Multiple, scatters && lit && several, several ? dark : "only one order of scattering was asked for");
    std::vector<std::string> ignored;
    decide(n.lightPollution, Part::LightPollution, !glowSpectrum(d, ignored).empty(),
           d.lightPollutionRadiance.empty() ? "the description gives no `light pollution relative radiance`"
                                            : "the ground gives no visible light");
    const auto moonless = noEclipse(d);
    decide(n.eclipsed, Part::Eclipsed, scatters && lit && several && !moonless,
           !scatters || !lit ? dark
           : !several        ? "only one order of scattering was asked for"
                             : moonless.value_or(""));
    n.everyEvent = scatters && lit && several &&
                   (options.saveScatteringDensity || options.saveScatteringDensity2FromGround || options.saveDeltaScattering ||
                    options.saveAccumulatedScattering);
    n.field = scatters && lit && (n.moments || n.multiple || n.eclipsed || n.irradiance || n.everyEvent);
    return n;
}

Work workOf(const atmo::Description& d, const Options& options, const Needs& needs, const FieldWork* const field,
            const physics::Medium* const medium)
{
    Work w;
    const double sets = (d.wavelengths.count + 3) / 4, quality = relativeWork(options.quality);
    const double events = d.allScatteringOrders ? 8 : std::max(1, d.scatteringOrders - 1);
    w.medium = 0.05;
    w.sunlight = medium ? sunlightOf(*medium, options, needs).seconds / 2 : 0.15;
    if (needs.field)
        w.moments = field ? field->seconds : (0.1 + 0.03 * sets * events) * quality;
    if (needs.transmittance)
        w.transmittance = 1e-5 * d.transmittanceSize.altitude * d.transmittanceSize.zenithAngle;
    if (needs.irradiance)
        w.irradiance = 1e-6 * d.irradianceSize.altitude * d.irradianceSize.zenithAngle * d.wavelengths.count;
    const double points = texels(d.scatteringSize, options) * sets;
    if (needs.single)
        w.single = points * 40 * quality / directVisits;
    if (needs.multiple)
        w.multiple = points * 14 * quality / scatteredVisits;
    if (needs.eclipsed)
        w.eclipsed = eclipseSeconds(d, options, medium);
    if (needs.lightPollution)
        w.lightPollution =
            (0.08 + 5e-6 * d.lightPollutionSize.altitude * d.lightPollutionSize.zenithAngle) * sets * (options.saveLightPollution ? 8 : 1);
    if (needs.everyEvent)
        w.debugging = events * (options.saveDeltaScattering + options.saveAccumulatedScattering) * points * 14 * quality / scatteredVisits;
    w.writing = 0.05;
    return w;
}

std::vector<PlanItem> plan(const atmo::Description& d, const Options& options, const physics::Medium* const medium)
{
    const Needs needs = needsOf(d, options);
    const auto known = needs.field && medium ? std::optional(fieldWorkOf(*medium, options, ordersOf(d))) : std::nullopt;
    const Work work = workOf(d, options, needs, known ? &*known : nullptr, medium);
    const double sets = (d.wavelengths.count + 3) / 4, points = texels(d.scatteringSize, options);
    const double bytes = options.texturePrecisionBits <= 11 ? 2 : 4, compressed = 0.7;
    const auto size = [](double value) { return static_cast<std::size_t>(value); };
    const auto sunlight = medium ? sunlightOf(*medium, options, needs) : physics::SunTable::Cost{8e5, 8e5, 0};
    // Medium and sunlight stay, and are copied to the GPU for every stage.
    const double held = 2 * (sunlight.bytes + (medium ? bytesOf(*medium) : 0));
    const auto memory = [held](double value) { return static_cast<std::size_t>(process + held + value); };
    const double layer = points / std::max(1., layersOf(d.scatteringSize, options)) * 16;
    // Results of as many views as --max-memory allows, and a layer of all, in twos while it is written.
    const auto baked = [&](double tables, double sheets) {
        const double results = tables * layer * sheets, bound = double(resultBytes(options));
        return (bound > 0 ? std::min(bound, results) : results) + results + 2 * layer * sheets;
    };
    std::vector<PlanItem> items;
    items.push_back({"medium", true, "densities and phase functions as tables, sunlight",
                     memory(4e6 + std::max(0., sunlight.peakBytes - 2 * sunlight.bytes)), size(3e5), work.medium + work.sunlight});
    if (needs.field) {
        const FieldWork field = known.value_or(FieldWork{work.moments, 8e6 * sets, 1.2e5 * sets});
        items.push_back(
            {"moments", true, qualityOf(options), memory(field.bytes), size(needs.moments ? field.diskBytes : 0), field.seconds});
    }
    if (needs.transmittance)
        items.push_back({"transmittance", true, "", memory(1e6),
                         size(d.transmittanceSize.altitude * d.transmittanceSize.zenithAngle * sets * 16 * compressed),
                         work.transmittance});
    if (needs.irradiance)
        items.push_back({"irradiance", true, "", memory(1e6),
                         size(2. * d.irradianceSize.altitude * d.irradianceSize.zenithAngle * sets * 16 * compressed), work.irradiance});
    if (needs.single)
        for (const auto& s : d.scatterers) {
            if (!scattersLight(s)) {
                items.push_back({"single-scattering/" + s.name, false, "it scatters no light", 0, 0, 0});
                continue;
            }
            const bool luminance = !options.radiance && s.phaseFunctionType != atmo::PhaseFunctionType::General;
            items.push_back({"single-scattering/" + s.name, true, luminance ? "as XYZ and scotopic luminance" : "as spectral radiance",
                             memory(30e6 + baked(double(d.scatterers.size()), luminance ? 1 : sets)),
                             size(points * bytes * compressed * (luminance ? 4 : d.wavelengths.count)),
                             work.single / double(d.scatterers.size())});
        }
    if (needs.multiple)
        items.push_back({"multiple-scattering", true, options.radiance ? "as spectral radiance" : "as XYZ and scotopic luminance",
                         memory(35e6 + baked(1, options.radiance ? sets : 1)),
                         size(points * bytes * compressed * (options.radiance ? d.wavelengths.count : 4)), work.multiple});
    if (needs.eclipsed) {
        const auto s = eclipseTableSize(d);
        const double texels = double(s.viewZenithAngle) * s.dotViewSun * s.sunZenithAngle;
        const double layers = points / std::max(1., double(d.scatteringSize.viewZenithAngle) * d.scatteringSize.dotViewSun *
                                                        d.scatteringSize.sunZenithAngle * sets);
        items.push_back({"eclipsed-double-scattering", true,
                         options.radiance ? "as spectral radiance, all orders from the second"
                                          : "as XYZ and scotopic luminance, all orders from the second",
                         memory(80e6 + texels * d.wavelengths.count * 6 * 4),
                         size(texels * layers * bytes * compressed * (options.radiance ? d.wavelengths.count : 4)), work.eclipsed});
    }
    if (needs.lightPollution) {
        const double texels = double(d.lightPollutionSize.altitude) * d.lightPollutionSize.zenithAngle;
        items.push_back(
            {"light-pollution", true, options.radiance ? "as spectral radiance, all orders" : "as XYZ and scotopic luminance, all orders",
             memory(2e6 + 1e6 * sets), size(texels * 4 * compressed * (options.radiance ? d.wavelengths.count : 4)), work.lightPollution});
    }
    for (const auto& s : needs.skipped)
        items.push_back({s.what, false, s.why, 0, 0, 0});
    return items;
}

std::optional<std::string> beyondMemory(const std::vector<PlanItem>& plan, const Options& options)
{
    const auto most =
        std::max_element(plan.begin(), plan.end(), [](const auto& a, const auto& b) { return a.memoryBytes < b.memoryBytes; });
    if (options.maxMemoryBytes == 0 || most == plan.end() || most->memoryBytes <= options.maxMemoryBytes)
        return std::nullopt;
    const auto megabytes = [](std::size_t bytes) { return std::to_string((bytes + 500000) / 1000000) + " MB"; };
    return "--max-memory: " + megabytes(options.maxMemoryBytes) + " won't be enough; however the work is split, about " +
           megabytes(most->memoryBytes) + " are needed for: " + most->what + ".";
}

std::size_t resultBytes(const Options& options)
{
    constexpr std::size_t fixedMemory = std::size_t(130) << 20; // the program, the driver, and what doesn't depend on sizes
    const std::size_t most = options.maxMemoryBytes;
    return most > 0 ? std::max<std::size_t>(1, (most - std::min(most, fixedMemory)) / 4) : 0;
}

} // namespace sky::solver
