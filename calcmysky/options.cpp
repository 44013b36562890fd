#include "options.hpp"

#include <limits>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "help.hpp"
#include "solver/quality.hpp"
#include "values.hpp"

namespace sky::cli {

namespace {

/// The options as they were typed; turned into a Request once all of them are known.
struct Typed {
    std::string description, outDir;
    std::optional<std::string> only, skip, altitudes, quality, tolerance, precision, maxMemory, device;
    std::string progress = "auto", backend = "auto", extendSpectra = "error";
    bool radiance = false, noEclipsed = false, noTextures = false, validate = false, dryRun = false, listDevices = false;
    bool pointSampled = false, quiet = false, debug = false, debugFull = false;
    solver::Options save; ///< only its save... fields
};

void addModelOptions(CLI::App& app, Typed& typed)
{
    const std::string model = "What to write";
    app.add_option("description", typed.description, "The atmosphere: a .atmo file, or - for standard input")->option_text("FILE");
    app.add_option("--out-dir", typed.outDir, "Directory of the model; an old model there is replaced at the very end")
        ->option_text("DIR")
        ->group(model);
    app.add_flag("--radiance", typed.radiance, "Spectral radiance instead of XYZ and scotopic luminance")->group(model);
    app.add_option("--only", typed.only, "Write these parts alone, named below and separated by commas")->option_text("LIST")->group(model);
    app.add_option("--skip", typed.skip, "Leave these parts out")->option_text("LIST")->group(model);
    app.add_option("--altitudes", typed.altitudes, "Bake these altitude layers only, counted from 0 at the ground")
        ->option_text("A..B")
        ->group(model);
    app.add_flag("--no-eds-tex", typed.noEclipsed, "No eclipsed double scattering table, like --skip eclipsed")->group(model);
    app.add_option("--texture-save-precision", typed.precision,
                   "Significand bits kept in 3D textures, 1 to 24 (all); fewer make\nsmaller files. Default " +
                       std::to_string(solver::Options{}.texturePrecisionBits))
        ->option_text("BITS")
        ->group(model);

    const std::string accuracy = "How accurate, with what means";
    app.add_option("--quality", typed.quality, "draft, normal (the default), fine or reference")->option_text("NAME")->group(accuracy);
    app.add_option(
           "--tolerance", typed.tolerance,
           "Pick the cheapest quality predicted to err by less than this part.\nBeside --quality: drop the orders and harmonics that change less")
        ->option_text("X")
        ->group(accuracy);
    app.add_flag("--point-sampled-spectra", typed.pointSampled, "Read spectra in files at the wavelengths, not averaged over the bands")
        ->group(accuracy);
    app.add_option("--extend-spectra", typed.extendSpectra,
                   "Beyond the ends of a spectrum's file: zero, end (its last value)\nor error (the default)")
        ->option_text("RULE")
        ->group(accuracy);
    app.add_option("--max-memory", typed.maxMemory, "Split the work rather than use more, 1.5G for instance")
        ->option_text("SIZE")
        ->group(accuracy);
}

void addRunOptions(CLI::App& app, Typed& typed)
{
    const std::string look = "Look before you run";
    app.add_flag("--dry-run", typed.dryRun, "List what would be computed and skipped and why; memory, disk, time")->group(look);
    app.add_flag("--validate", typed.validate, "Only read the description and compile its code")->group(look);
    app.add_flag("--list-devices", typed.listDevices, "List the devices that --device takes")->group(look);

    const std::string talk = "How it talks";
    app.add_option("--progress", typed.progress, "auto, bar, json (one object per line on standard error) or none")
        ->option_text("STYLE")
        ->group(talk);
    app.add_flag("-q,--quiet", typed.quiet, "Print errors only")->group(talk);

    const std::string opengl = "OpenGL";
    app.add_option("--gl", typed.backend, "auto, egl or osmesa; auto tries EGL, then OSMesa")->option_text("BACKEND")->group(opengl);
    app.add_option("--device", typed.device, "The device of that number in --list-devices")->option_text("N")->group(opengl);
    app.add_flag("--opengl-debug", typed.debug, "Print the driver's errors and warnings")->group(opengl);
    app.add_flag("--opengl-debug-full", typed.debugFull, "Print everything that the driver says")->group(opengl);
}

void addDebuggingOptions(CLI::App& app, Typed& typed)
{
    const std::string debugging = "For developers: intermediate tables";
    app.add_flag("--no-save-tex", typed.noTextures, "No textures, only what is quick to compute, like --only moments")->group(debugging);
    app.add_flag("--save-irradiance", typed.save.saveIrradianceOrders, "Irradiance of the ground, each order")->group(debugging);
    app.add_flag("--save-scat-density", typed.save.saveScatteringDensity, "Scattering density, each order")->group(debugging);
    app.add_flag("--save-scat-density2-from-ground", typed.save.saveScatteringDensity2FromGround,
                 "Scattering density of order 2 from light off the ground")
        ->group(debugging);
    app.add_flag("--save-delta-scattering", typed.save.saveDeltaScattering, "Radiance of each order alone")->group(debugging);
    app.add_flag("--save-accum-scattering", typed.save.saveAccumulatedScattering, "Radiance summed up to each order")->group(debugging);
    app.add_flag("--save-light-pollution", typed.save.saveLightPollution, "Light pollution, each order")->group(debugging);
}

/// All long and short names that `app` understands.
std::vector<std::string> optionNames(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            names.push_back("-" + name);
    }
    return names;
}

/// Refuses what no option or argument took.
void refuseLeftovers(const CLI::App& app, const std::vector<std::string>& subcommandNames)
{
    std::vector<std::string> left = app.remaining();
    std::vector<std::string> known = optionNames(app);
    for (const CLI::App* sub : app.get_subcommands()) {
        const std::vector<std::string> more = sub->remaining(), names = optionNames(*sub);
        left.insert(left.end(), more.begin(), more.end());
        known.insert(known.end(), names.begin(), names.end());
    }
    if (left.empty())
        return;
    const std::string word = left.front().substr(0, left.front().find('='));
    if (word.size() > 1 && word.front() == '-')
        throw UsageError("There is no option `" + word + "`." + suggestion(word, known) + " See calcmysky --help.");
    const std::string first = app.get_option("description")->as<std::string>();
    throw UsageError("One description at a time: `" + first + "` and `" + word + "` were given." + suggestion(first, subcommandNames));
}

/// CLI11's own complaints, as sentences.
[[noreturn]] void rethrow(const CLI::ParseError& error)
{
    const std::string message = error.what();
    const std::string option = message.substr(0, message.find(':'));
    if (error.get_name() == "ArgumentMismatch" && message.find("missing") != std::string::npos)
        throw UsageError(option + " needs a value. See calcmysky --help.");
    if (error.get_name() == "ArgumentMismatch")
        throw UsageError(option + " was given more than once.");
    throw UsageError(message);
}

std::set<solver::Part> chosenParts(const Typed& typed)
{
    using solver::Part;
    if (typed.noTextures && typed.only)
        throw UsageError("--no-save-tex and --only both say what to write: give one of them.");
    std::set<Part> parts = solver::Options{}.parts;
    if (typed.noTextures)
        parts = {Part::Moments};
    if (typed.only)
        parts = readParts("--only", *typed.only);
    std::set<Part> skipped;
    if (typed.skip)
        skipped = readParts("--skip", *typed.skip);
    for (const Part part : skipped)
        if (typed.only && parts.contains(part))
            throw UsageError("--only asks for " + nameOf(part) + " and --skip leaves it out: drop it from one of them.");
    if (typed.noEclipsed && typed.only && parts.contains(Part::Eclipsed))
        throw UsageError("--only asks for eclipsed and --no-eds-tex leaves it out: drop one of them.");
    if (typed.noEclipsed)
        skipped.insert(Part::Eclipsed);
    for (const Part part : skipped)
        parts.erase(part);
    if (parts.empty())
        throw UsageError("These options leave nothing to write: the parts are " + partNames() + ".");
    if (typed.save.saveLightPollution && !parts.contains(Part::LightPollution))
        throw UsageError("--save-light-pollution needs the part light-pollution, which the other options leave out.");
    return parts;
}

solver::Options solverOptions(const Typed& typed)
{
    solver::Options options = typed.save;
    options.parts = chosenParts(typed);
    options.radiance = typed.radiance;
    if (typed.precision)
        options.texturePrecisionBits = readInteger("--texture-save-precision", *typed.precision, 1, 24);
    if (typed.altitudes)
        options.altitudeLayers = readLayers("--altitudes", *typed.altitudes);
    if (typed.tolerance)
        options.tolerance = readFraction("--tolerance", *typed.tolerance);
    if (typed.quality)
        options.quality = solver::qualityNames()[readChoice("--quality", *typed.quality, solver::qualityNames())];
    options.qualityByTolerance = typed.tolerance && !typed.quality;
    if (typed.maxMemory)
        options.maxMemoryBytes = readSize("--max-memory", *typed.maxMemory);
    return options;
}

gl::HeadlessOptions openglOptions(const Typed& typed)
{
    using enum gl::HeadlessBackend;
    gl::HeadlessOptions options;
    options.backend = std::vector{automatic, egl, osmesa}[readChoice("--gl", typed.backend, {"auto", "egl", "osmesa"})];
    if (typed.device) {
        options.device = readInteger("--device", *typed.device, 0, std::numeric_limits<int>::max());
        if (options.backend == osmesa)
            throw UsageError("--device chooses among the devices of EGL: it can't go with --gl osmesa.");
        options.backend = egl;
    }
    options.debug = typed.debugFull ? gl::DebugOutput::full : typed.debug ? gl::DebugOutput::on : gl::DebugOutput::off;
    return options;
}

atmo::ParseOptions parsingOptions(const Typed& typed)
{
    using atmo::OutsideRange;
    atmo::ParseOptions options;
    options.resampling = typed.pointSampled ? atmo::Resampling::Point : atmo::Resampling::BandAverage;
    options.outside = std::vector{OutsideRange::Zero, OutsideRange::EndValue,
                                  OutsideRange::Error}[readChoice("--extend-spectra", typed.extendSpectra, {"zero", "end", "error"})];
    return options;
}

Action chosenAction(const Typed& typed)
{
    if (typed.listDevices)
        return Action::ListDevices;
    if (typed.dryRun && typed.validate)
        throw UsageError("--dry-run and --validate are two different looks: give one of them.");
    if (typed.description.empty())
        throw UsageError("Which atmosphere? Give a .atmo file: calcmysky FILE --out-dir DIR. See calcmysky --help.");
    if (typed.dryRun || typed.validate)
        return typed.dryRun ? Action::DryRun : Action::Validate;
    if (typed.outDir.empty())
        throw UsageError("Where shall the model go? Add --out-dir DIR.");
    return Action::Compute;
}

} // namespace

Request parseCommandLine(int argc, const char* const* argv, const std::vector<std::unique_ptr<Subcommand>>& subcommands)
{
    Typed typed;
    CLI::App app(helpHeader(), "calcmysky");
    app.formatter(std::make_shared<HelpFormatter>());
    app.allow_extras();
    addModelOptions(app, typed);
    addRunOptions(app, typed);
    app.set_help_flag("-h,--help", "Print this text and stop")->group("How it talks");
    app.set_version_flag("-v,--version", versionText(), "Print the version and stop")->group("How it talks");
    addDebuggingOptions(app, typed);
    std::vector<std::pair<CLI::App*, Subcommand*>> added;
    std::vector<std::string> names;
    for (const auto& subcommand : subcommands) {
        added.emplace_back(subcommand->addTo(app), subcommand.get());
        added.back().first->fallthrough()->allow_extras();
        added.back().first->footer("The options about OpenGL, --progress and --quiet work here too: see calcmysky --help.");
        names.push_back(added.back().first->get_name());
    }
    app.footer(helpFooter()); // after the subcommands, which would inherit it

    Request request;
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        request.action = Action::ShowText;
        request.text = helpText(app);
        return request;
    } catch (const CLI::CallForVersion&) {
        request.action = Action::ShowText;
        request.text = versionText() + "\n";
        return request;
    } catch (const CLI::ParseError& error) {
        rethrow(error);
    }
    refuseLeftovers(app, names);

    request.gl = openglOptions(typed);
    request.quiet = typed.quiet;
    using enum ProgressStyle;
    request.progress = std::vector{Automatic, Bar, Json, None}[readChoice("--progress", typed.progress, {"auto", "bar", "json", "none"})];
    if (request.quiet && (request.progress == Bar || request.progress == Json))
        throw UsageError("--quiet and --progress " + typed.progress + " contradict each other: give one of them.");
    for (const auto& [sub, subcommand] : added)
        if (sub->parsed()) {
            if (!typed.description.empty())
                throw UsageError("`" + sub->get_name() + "` takes no description; to compute a file of that name, write ./" +
                                 sub->get_name() + ".");
            request.action = Action::Subcommand;
            request.subcommand = subcommand;
            return request;
        }
    request.action = chosenAction(typed);
    request.description = typed.description;
    request.outDir = typed.outDir;
    request.solver = solverOptions(typed);
    request.parsing = parsingOptions(typed);
    return request;
}

} // namespace sky::cli
