// Run time of the moments against their error: every setting varied around the quality presets; and how the cost grows with the
// work. bench/run calls it and draws the plots.
//
//   bench_front front FILE.atmo REFERENCE.csv [--without SPECIES] [--orders N|all] [--name NAME] [--repeats N] [--presets LIST] [--against PRESET]
//   bench_front cost FILE.atmo [--repeats N]
//
// LIST: presets, separated by commas. With a ! a preset stands alone, without its neighbours; fine:degree=10:nodes=28! is `fine` with that changed.
//
// Time: from the medium to the finished moments, everything that depends on the settings. Wall clock depends on what else the
// machine does; so processor time of all threads stands beside it. Repeats are interleaved and the quickest counts.

#include "atmo/parse.hpp"
#include "base/error.hpp"
#include "gl/context.hpp"
#include "model/error_summary.hpp"
#include "physics/harmonics.hpp"
#include "reference_table.hpp"
#include "solver/iterate.hpp"
#include "solver/medium_tables.hpp"
#include "solver/plan.hpp"
#include "solver/quality.hpp"
#include <chrono>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <sys/resource.h>

using namespace sky;

namespace {

struct Seconds {
    double wall = 1e30, processor = 1e30;
};

double processorSeconds()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Point {
    std::string label; ///< a preset's name, or what was changed in it
    physics::MomentSettings settings;
    solver::OrderLimit limit;
    Seconds seconds{};
};

struct Field {
    physics::Optics optics;
    physics::Moments moments;
    int levels;
};

/// The moments as calcmysky computes them; keeps the quickest time.
Field compute(const gl::Api& api, const physics::Medium& medium, const solver::OrderLimit& limit, const physics::MomentSettings& settings,
              Seconds& quickest)
{
    const auto start = std::chrono::steady_clock::now();
    const double startProcessor = processorSeconds();
    const physics::Profile profile(medium);
    Field field{physics::makeOptics(medium, settings.degree, settings.truncatePeaks), {}, 0};
    const physics::SunTable sun(profile, field.optics, medium.sunAngularRadius);
    const physics::MomentGrid grid(profile, physics::largestExtinctions(field.optics), settings.altitudes, settings.suns,
                                   medium.sunAngularRadius);
    field.moments = iterate(api, {medium, profile, field.optics, sun}, grid, settings, limit, false, [](double) {}).total;
    field.levels = grid.altitudeCount();
    quickest.wall = std::min(quickest.wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    quickest.processor = std::min(quickest.processor, processorSeconds() - startProcessor);
    return field;
}

using Number = int physics::MomentSettings::*;

const std::map<std::string, std::vector<Number>>& numbers()
{
    using M = physics::MomentSettings;
    static const std::map<std::string, std::vector<Number>> list{
        {"altitudes", {&M::altitudes}},
        {"suns", {&M::suns}},
        {"degree", {&M::degree}},
        {"directions", {&M::groundDirections, &M::limbDirections, &M::skyDirections, &M::azimuths}},
        {"ground", {&M::groundDirections}},
        {"limb", {&M::limbDirections}},
        {"sky", {&M::skyDirections}},
        {"azimuths", {&M::azimuths}},
        {"nodes", {&M::nodes}},
        {"directNodes", {&M::directNodes}}};
    return list;
}

/// One setting changed at a time, a third down and half up; and fewer orders, where all are asked for.
std::vector<Point> around(const std::string& preset, const physics::MomentSettings& s, const solver::OrderLimit& limit)
{
    std::vector<Point> points{{preset, s, limit}};
    if (limit.all)
        for (const int orders : {2, 3, 4, 6, 8})
            points.push_back({preset + ", " + std::to_string(orders) + " orders", s, {orders, false, 0}});
    for (const char* name : {"altitudes", "suns", "degree", "directions", "nodes", "directNodes"})
        for (const double factor : {2 / 3., 1.5}) {
            Point point{preset + (factor < 1 ? ", fewer " : ", more ") + name, s, limit};
            for (const Number field : numbers().at(name))
                point.settings.*field = static_cast<int>(factor * (s.*field) + 0.5);
            points.push_back(point);
        }
    return points;
}

/// `NAME[:setting=value]...`
physics::MomentSettings settingsOf(const std::string& preset, const physics::Medium& medium)
{
    const auto parts = CLI::detail::split(preset, ':');
    physics::MomentSettings s = solver::qualityFor(parts.front(), medium).moments;
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const auto halves = CLI::detail::split(parts[i], '=');
        const auto found = numbers().find(halves.front());
        int number = 0;
        if (halves.size() != 2 || found == numbers().end() || !CLI::detail::lexical_cast(halves[1], number))
            throw UsageError("--presets: `" + parts[i] + "` is no setting and its number, as in degree=10.");
        for (const Number field : found->second)
            s.*field = number;
    }
    return s;
}

struct World {
    atmo::Description description;
    physics::Medium medium;
    solver::OrderLimit limit() const { return {std::max(2, description.scatteringOrders), description.allScatteringOrders, 0}; }
};

World readWorld(const gl::Api& api, const std::string& path, const std::string& without, const std::string& orders)
{
    World world{atmo::parseFile(path), {}};
    std::vector<std::string> warnings;
    world.medium = solver::evaluateMedium(world.description, api, warnings);
    if (!without.empty() && std::erase_if(world.medium.species, [&](const auto& s) { return s.name == without; }) == 0)
        throw UsageError("--without: there is no species `" + without + "`.");
    if (!orders.empty()) {
        world.description.allScatteringOrders = orders == "all";
        world.description.scatteringOrders = orders == "all" ? 0 : std::stoi(orders);
    }
    return world;
}

void printFront(const std::string& name, const World& world, const Point& point, const Field& field,
                const std::vector<bench::ReferenceRow>& rows)
{
    const auto scale = cli::sampleScale(world.medium);
    const auto sky = model::skyOfMoments(world.medium, field.optics, field.moments);
    model::ErrorSummary sums[4]; // by regime; all seen from high up
    for (const auto& row : rows) {
        const int w = bench::wavelengthIndex(row, world.medium.wavelengthsNm);
        if (w < 0 || !(row.radiance > 0)) // light that the judge didn't find has no relative error
            continue;
        const auto radiance = sky->radiance(row.geometry);
        const double error = (radiance.single[w] + radiance.multiple[w]) / row.radiance - 1;
        sums[bench::regimeOf(row, scale)].add(error, row.noise / row.radiance);
        if (bench::isHigh(row, scale))
            sums[3].add(error, row.noise / row.radiance);
    }
    const auto& s = point.settings;
    std::printf("%s,\"%s\",%d,%d,%d,%d,%d,%d,%d,%d,%d,%.4f,%.4f", name.c_str(), point.label.c_str(), field.levels,
                field.moments.grid.sunCount(), s.degree, s.groundDirections, s.limbDirections, s.skyDirections, s.azimuths, s.directNodes,
                s.nodes, point.seconds.wall, point.seconds.processor);
    for (const auto& sum : sums)
        std::printf(",%.6f,%.6f", sum.rms(), sum.uncertainty());
    std::printf("\n");
    std::fflush(stdout);
}

void front(const gl::Api& api, const std::string& name, const World& world, const std::vector<bench::ReferenceRow>& rows,
           const std::vector<std::string>& presets, const int repeats)
{
    std::vector<Point> points;
    for (const std::string& preset : presets) {
        const bool alone = preset.back() == '!'; // without its neighbours
        const std::string plain = alone ? preset.substr(0, preset.size() - 1) : preset;
        const auto more = around(plain, settingsOf(plain, world.medium), world.limit());
        points.insert(points.end(), more.begin(), alone ? more.begin() + 1 : more.end());
    }
    Seconds warmUp;
    compute(api, world.medium, points.front().limit, points.front().settings, warmUp);
    for (int i = 1; i < repeats; ++i)
        for (Point& point : points)
            compute(api, world.medium, point.limit, point.settings, point.seconds);
    for (Point& point : points) {
        const Field field = compute(api, world.medium, point.limit, point.settings, point.seconds);
        printFront(name, world, point, field, rows);
    }
}

/// The rows as that preset answers them, without noise: what is left is the error of coarser grids.
std::vector<bench::ReferenceRow> answeredBy(const gl::Api& api, const std::string& preset, const World& world,
                                            std::vector<bench::ReferenceRow> rows)
{
    Seconds ignored;
    const Field field = compute(api, world.medium, world.limit(), settingsOf(preset, world.medium), ignored);
    const auto sky = model::skyOfMoments(world.medium, field.optics, field.moments);
    std::erase_if(rows, [&](const auto& row) { return bench::wavelengthIndex(row, world.medium.wavelengthsNm) < 0; });
    for (auto& row : rows) {
        const auto radiance = sky->radiance(row.geometry);
        const int w = bench::wavelengthIndex(row, world.medium.wavelengthsNm);
        row.radiance = radiance.single[w] + radiance.multiple[w];
        row.noise = 0;
    }
    return rows;
}

/// The medium with its wavelengths repeated or cut to `count`.
physics::Medium withWavelengths(const physics::Medium& medium, const int count)
{
    physics::Medium m = medium;
    const auto repeat = [&](std::vector<double>& values, std::size_t rows) {
        std::vector<double> result;
        const std::size_t old = values.size() / rows;
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t w = 0; w < static_cast<std::size_t>(count); ++w)
                result.push_back(values[r * old + w % old]);
        values = result;
    };
    for (auto* values : {&m.wavelengthsNm, &m.solarIrradiance, &m.groundAlbedo})
        repeat(*values, 1);
    for (auto& s : m.species) {
        repeat(s.extinctionCrossSection, 1);
        repeat(s.singleScatteringAlbedo, 1);
        if (s.scatters())
            repeat(s.phaseFunction, m.scatteringAngles.size());
    }
    return m;
}

void cost(const gl::Api& api, const World& world, const int repeats)
{
    struct Task {
        std::string axis;
        double work;
        physics::Medium medium;
        Point point;
    };
    const physics::MomentSettings base = solver::qualityFor("normal", world.medium).moments;
    std::vector<Task> tasks;
    const auto add = [&](const std::string& axis, double work, const physics::Medium& medium, int orders, physics::MomentSettings s) {
        tasks.push_back({axis, work, medium, {axis, s, {orders, false, 0}}});
    };
    for (const int wavelengths : {4, 8, 16, 32})
        add("wavelengths", wavelengths, withWavelengths(world.medium, wavelengths), 4, base);
    for (const int orders : {2, 4, 8, 16})
        add("orders", orders, world.medium, orders, base);
    for (const int degree : {2, 4, 8, 16}) {
        auto s = base;
        s.degree = degree;
        add("harmonics", physics::harmonicCount(degree), world.medium, 4, s);
    }
    for (const int factor : {1, 2, 4, 8}) {
        auto s = base;
        s.suns = base.suns * factor;
        add("grid points", static_cast<double>(s.altitudes) * s.suns, world.medium, 4, s);
    }
    for (const int factor : {1, 2, 4}) {
        auto s = base;
        s.skyDirections *= factor, s.groundDirections *= factor, s.limbDirections *= factor;
        add("directions", (s.skyDirections + s.groundDirections + s.limbDirections) * s.azimuths, world.medium, 4, s);
    }
    Seconds warmUp;
    compute(api, world.medium, tasks.front().point.limit, base, warmUp);
    for (int i = 0; i < repeats; ++i)
        for (Task& task : tasks)
            compute(api, task.medium, task.point.limit, task.point.settings, task.point.seconds);
    for (const Task& task : tasks)
        std::printf("%s,%g,%.4f,%.4f\n", task.axis.c_str(), task.work, task.point.seconds.wall, task.point.seconds.processor);
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{"Run time of the moments against their error, and cost against work."};
    std::string description, reference, without, orders, against, name = "earth", presets = "draft,normal,fine!";
    int repeats = 2;
    auto* frontCommand = app.add_subcommand("front", "time against error around the quality presets");
    auto* costCommand = app.add_subcommand("cost", "time against work");
    for (auto* command : {frontCommand, costCommand}) {
        command->add_option("description", description, ".atmo file")->required();
        command->add_option("--without", without, "leave out a species");
        command->add_option("--orders", orders, "in place of the description's")->check(CLI::PositiveNumber | CLI::IsMember({"all"}));
        command->add_option("--repeats", repeats, "the quickest counts");
    }
    frontCommand->add_option("reference", reference, "CSV of reference radiances")->required();
    frontCommand->add_option("--name", name, "first column of the output");
    frontCommand->add_option("--presets", presets, "with their neighbours; those with a ! alone; NAME:degree=10 changes a setting");
    frontCommand->add_option("--against", against, "take this preset's answers in place of the table's");
    app.require_subcommand(1);
    CLI11_PARSE(app, argc, argv);
    try {
        const gl::HeadlessContext context{gl::HeadlessOptions{}};
        const World world = readWorld(context.api(), description, without, orders);
        if (frontCommand->parsed()) {
            auto rows = bench::readReference(reference);
            if (!against.empty())
                rows = answeredBy(context.api(), against, world, std::move(rows));
            front(context.api(), name, world, rows, CLI::detail::split(presets, ','), repeats);
        } else {
            cost(context.api(), world, repeats);
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "bench_front: %s\n", error.what());
        return error.inputMustChange() ? 2 : 1;
    }
}
