// What options do to a model: which tables it holds, and what is in them.
#include "base/error.hpp"
#include "physics/harmonics.hpp"
#include "solver/quality.hpp"
#include "support.hpp"
#include <algorithm>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;
namespace fs = std::filesystem;

namespace {

Options only(std::set<Part> parts)
{
    Options options = draft();
    options.parts = std::move(parts);
    return options;
}

/// Light of each order and up to each, as exactly as files can hold it.
Options withOrders()
{
    Options options = only({Part::Multiple, Part::Irradiance});
    options.texturePrecisionBits = 24;
    options.radiance = true;
    options.saveIrradianceOrders = options.saveDeltaScattering = options.saveAccumulatedScattering = true;
    return options;
}

} // namespace

TEST_CASE("options: a model holds the parts that were asked for, and says what it leaves out", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const auto description = SceneText().parse();
    const std::set<std::string> medium{"medium", "phase-functions"};
    struct Case {
        std::set<Part> parts;
        std::set<std::string> tables;
    };
    const std::vector<Case> cases{
        {{}, {}},
        {{Part::Transmittance}, {"transmittance"}},
        {{Part::Irradiance}, {"irradiance-direct", "irradiance-diffuse"}},
        {{Part::Single}, {"single-scattering/air"}},
        {{Part::Moments}, {"moments", "moments-ground-irradiance"}},
        {{Part::Multiple}, {"multiple-scattering"}},
        {{Part::Eclipsed}, {"eclipsed-double-scattering"}},
    };
    std::set<std::string> everything = medium;
    for (const auto& c : cases) {
        const Run run(*context, description, only(c.parts));
        auto expected = medium;
        expected.insert(c.tables.begin(), c.tables.end());
        everything.insert(c.tables.begin(), c.tables.end());
        CHECK(tableNames(run.model) == expected);
        std::set<std::string> skipped;
        for (const auto& s : run.model.manifest().skipped)
            skipped.insert(s.what);
        for (const Part part : allParts())
            CHECK((skipped.count(nameOf(part)) == 1) == (c.parts.count(part) == 0));
    }
    const Run all(*context, description);
    CHECK(tableNames(all.model) == everything);
    CHECK_FALSE(all.listener.fell);
    CHECK(all.listener.stages == std::vector<std::string>{"medium", "sunlight", "moments", "transmittance", "irradiance",
                                                          "single scattering", "multiple scattering", "eclipses", "writing"});
}

TEST_CASE("options: a range of altitude layers is those layers of the whole model", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.altitudes = "5";
    Options options = only({Part::Single, Part::Multiple});
    const Run whole(*context, scene.parse(), options);
    options.altitudeLayers = {1, 3};
    const Run some(*context, scene.parse(), options);
    for (const char* name : {"single-scattering/air", "multiple-scattering"}) {
        const auto& all = whole.model.table(name).axes[0].nodes;
        CHECK(some.model.table(name).axes[0].nodes == std::vector<double>(all.begin() + 1, all.begin() + 4));
        // Halves share an exponent along a row; what is dark there may lose bits with its neighbour.
        const auto a = some.model.readAll(name), b = whole.model.readRows(name, 4, 12);
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            CHECK(double(a[i]) == Approx(double(b[i])).epsilon(1e-3).margin(1e-6 * double(*std::max_element(b.begin(), b.end()))));
    }
}

TEST_CASE("options: fewer significand bits make smaller files of nearly the same numbers", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.views = "32";
    scene.azimuths = "8";
    scene.suns = "16";
    scene.altitudes = "4";
    Options options = only({Part::Multiple});
    std::uintmax_t before = 0;
    std::vector<float> exact;
    for (const int bits : {24, 16, 11, 6}) {
        options.texturePrecisionBits = bits;
        const Run run(*context, scene.parse(), options);
        const auto& table = run.model.table("multiple-scattering");
        const auto bytes = fs::file_size(run.model.directory() / table.file);
        const auto values = run.model.readAll(table.name);
        INFO("bits " << bits);
        CHECK(table.half == (bits <= 11));
        CHECK(run.model.manifest().settings.at("texture-save-precision") == std::to_string(bits));
        if (bits == 24)
            exact = values;
        else
            CHECK(bytes < before);
        before = bytes;
        double largest = 0;
        for (const float v : exact)
            largest = std::max(largest, double(v));
        for (std::size_t i = 0; i < values.size(); ++i) // half a unit of the last bit
            CHECK(double(values[i]) == Approx(double(exact[i])).epsilon(1.01 * std::ldexp(1., -bits)).margin(1e-8 * largest));
    }
}

TEST_CASE("options: a tolerance stops orders early and drops harmonics that are not missed", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.orders = "12";
    scene.species += SceneText::dust();
    Options options = only({Part::Moments});
    const Run twelve(*context, scene.parse(), options);
    options.tolerance = 0.02;
    const Run loose(*context, scene.parse(), options);
    const auto events = [](const Run& run) { return std::stoi(run.model.manifest().settings.at("moments.events")); };
    const auto degree = [](const Run& run) { return std::stoi(run.model.manifest().settings.at("moments.degree")); };
    CHECK(events(twelve) == 11); // the last event is the gather's
    CHECK(events(loose) < 8);
    CHECK(degree(twelve) == 2); // Rayleigh's
    CHECK(degree(loose) <= degree(twelve));
    CHECK(loose.model.manifest().estimatedError.at("orders left out") < 0.02);
    CHECK(twelve.model.manifest().estimatedError.count("orders left out") == 0);
    // ln I_00 at the zenith Sun, on the ground: what was left out is of the size of the tolerance.
    const auto a = twelve.model.readAll("moments"), b = loose.model.readAll("moments");
    const auto suns = twelve.model.table("moments").axes[2].nodes.size();
    CHECK(double(b[(suns - 1) * 2]) == Approx(double(a[(suns - 1) * 2])).margin(0.03));
}

TEST_CASE("options: intermediate tables are saved on request, and orders add up", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    Options options = withOrders();
    options.saveScatteringDensity = options.saveScatteringDensity2FromGround = true;
    const Run run(*context, SceneText().parse(), options);
    checkValues(run.model);
    CHECK(tableNames(run.model) ==
          std::set<std::string>{"medium", "phase-functions", "irradiance-direct", "irradiance-diffuse", "irradiance-order-1",
                                "irradiance-order-2", "multiple-scattering", "scattering-density/order-2", "scattering-density/order-3",
                                "scattering-density/order-2-from-ground", "delta-scattering/order-2", "delta-scattering/order-3",
                                "accumulated-scattering/order-2", "accumulated-scattering/order-3"});
    const auto read = [&](const std::string& name) { return run.model.readAll(name); };
    const auto total = read("multiple-scattering"), two = read("delta-scattering/order-2"), three = read("delta-scattering/order-3");
    CHECK(read("accumulated-scattering/order-2") == two);
    const auto accumulated = read("accumulated-scattering/order-3");
    double largest = 0;
    for (const float v : total)
        largest = std::max(largest, double(v));
    for (std::size_t i = 0; i < total.size(); ++i) {
        // Logarithms of a sum are interpolated, not sums of logarithms: a difference of second order in the grid.
        CHECK(double(accumulated[i]) == Approx(double(total[i])).epsilon(1e-4).margin(1e-7 * largest));
        CHECK(double(two[i]) + double(three[i]) == Approx(double(total[i])).epsilon(5e-3).margin(1e-6 * largest));
    }
    const auto diffuse = read("irradiance-diffuse"), one = read("irradiance-order-1"), second = read("irradiance-order-2");
    for (std::size_t i = 0; i < diffuse.size(); ++i)
        CHECK(double(one[i]) + double(second[i]) == Approx(double(diffuse[i])).epsilon(0.02).margin(1e-9));
    // Light from the ground is a part of all light that is scattered anew.
    const auto all = read("scattering-density/order-2"), ground = read("scattering-density/order-2-from-ground");
    const std::size_t texel = 6 * 2, harmonics = 6; // [harmonic][wavelength]
    REQUIRE(all.size() % (harmonics * 2) == 0);
    for (std::size_t i = 0; i < all.size(); i += texel)
        CHECK(ground[i] <= all[i] * 1.0001F);
}

TEST_CASE("options: with all orders the last of the intermediate tables has all that follow, and says so", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const Options options = withOrders();
    SceneText scene;
    scene.orders = "all";
    scene.suns = "8";
    // Optical depths of 0.12, whose series is closed, and 40, whose late events are told at once.
    for (const std::string density : {"1.5e24", "5e26"}) {
        scene.species = SceneText::rayleigh(density + "*exp(-altitude/(8.0*km))");
        const Run run(*context, scene.parse(), options);
        checkValues(run.model);
        std::map<std::string, int> orders; // tables by the kind
        for (const auto& table : run.model.tables())
            if (const auto at = table.name.find("order-"); at != std::string::npos) {
                int& most = orders[table.name.substr(0, at)];
                most = std::max(most, std::stoi(table.name.substr(at + 6)));
            }
        REQUIRE(orders.size() == 3);
        for (const auto& [kind, most] : orders)
            for (const int order : {most - 1, most}) {
                const bool says =
                    run.model.table(kind + "order-" + std::to_string(order)).quantity.find(" and all that follow") != std::string::npos;
                CHECK(says == (order == most));
            }
        const auto read = [&](const std::string& name) { return run.model.readAll(name); };
        const auto sumsTo = [&](const std::string& kind, int first, const std::string& total, double difference) {
            auto all = read(total), sum = std::vector<float>(all.size(), 0.F);
            for (int order = first; order <= orders.at(kind); ++order) {
                const auto one = read(kind + "order-" + std::to_string(order));
                std::transform(one.begin(), one.end(), sum.begin(), sum.begin(), std::plus<float>());
            }
            const double largest = double(*std::max_element(all.begin(), all.end()));
            for (std::size_t i = 0; i < all.size(); ++i)
                CHECK(double(sum[i]) == Approx(double(all[i])).epsilon(difference).margin(1e-5 * largest));
        };
        // Logarithms of a sum are interpolated, not sums of logarithms.
        sumsTo("irradiance-", 1, "irradiance-diffuse", 0.02);
        sumsTo("delta-scattering/", 2, "multiple-scattering", 0.02);
        const auto all = read("multiple-scattering"),
                   sum = read("accumulated-scattering/order-" + std::to_string(orders.at("accumulated-scattering/")));
        const double largest = double(*std::max_element(all.begin(), all.end()));
        for (std::size_t i = 0; i < all.size(); ++i)
            CHECK(double(sum[i]) == Approx(double(all[i])).epsilon(1e-3).margin(1e-6 * largest));
    }
}

TEST_CASE("options: a run that is stopped leaves nothing, or the old model", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const Scratch scratch;
    const auto description = SceneText().parse();
    Listener quiet;
    solve(description, only({Part::Transmittance}), *context, scratch.path / "old", quiet);
    const auto before = model::test::readFile(scratch.path / "old" / "manifest.json");
    for (const char* stage : {"medium", "moments", "single scattering", "multiple scattering"}) {
        INFO(stage);
        for (const char* place : {"new", "old"}) {
            Listener impatient;
            impatient.stopIn = stage;
            CHECK_THROWS_AS(solve(description, draft(), *context, scratch.path / place, impatient), Cancelled);
        }
        int entries = 0;
        for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratch.path))
            ++entries;
        CHECK(entries == 1);
        CHECK(model::test::readFile(scratch.path / "old" / "manifest.json") == before);
    }
}

TEST_CASE("options: a value that is no number ends the run, names its table and leaves nothing", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    auto description = SceneText().parse();
    description.solarIrradiance = {1e39, 1.5}; // beyond float
    const Scratch scratch;
    Listener quiet;
    try {
        solve(description, only({Part::Irradiance}), *context, scratch.path / "m", quiet);
        FAIL("was written");
    } catch (const NumericsError& error) {
        CHECK_THAT(error.what(), Catch::Contains("irradiance-direct") && Catch::Contains("infinite"));
    }
    CHECK(fs::is_empty(scratch.path));
}

TEST_CASE("options: the same run twice gives the same bytes", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.species += SceneText::dust() + scene.absorber();
    const Run first(*context, scene.parse()), second(*context, scene.parse());
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(first.model.directory())) {
        if (!entry.is_regular_file())
            continue;
        ++files;
        const auto name = fs::relative(entry.path(), first.model.directory());
        INFO(name.string());
        CHECK((model::test::readFile(entry.path()) == model::test::readFile(second.model.directory() / name)));
    }
    CHECK(files == static_cast<int>(first.model.manifest().files.size()) + 1);
    CHECK(second.model.manifest().files.size() == first.model.manifest().files.size());
}

TEST_CASE("options: qualities by name, each finer than the one before")
{
    physics::Medium air; // dust with a forward peak, so that the degree is the quality's
    air.planetRadius = 6.371e6;
    air.topOfAtmosphere = 1e5;
    air.wavelengthsNm = {550};
    air.altitudes = {0, 1e5};
    for (int i = 0; i <= 720; ++i)
        air.scatteringAngles.push_back(3.14159265358979323846 * i / 720);
    physics::Species dust;
    dust.numberDensity = {1, 1};
    dust.extinctionCrossSection = {5e-8}; // thin: its peak is not worth truncating
    dust.singleScatteringAlbedo = {1};
    for (const double angle : air.scatteringAngles) // Henyey-Greenstein, g = 0.6
        dust.phaseFunction.push_back(0.64 / (4 * 3.14159265358979323846 * std::pow(1.36 - 1.2 * std::cos(angle), 1.5)));
    air.species = {dust};
    int nodes = 0, degree = 0;
    for (const std::string& name : qualityNames()) {
        const auto quality = qualityFor(name, air);
        INFO(name);
        CHECK(quality.bake.directNodes > nodes);
        CHECK(quality.moments.degree >= degree);
        CHECK(qualityFor(name, air, 0.05).moments.degree < quality.moments.degree);
        nodes = quality.bake.directNodes;
        degree = quality.moments.degree;
    }
    try {
        qualityFor("best", air);
        FAIL("was accepted");
    } catch (const UsageError& error) {
        CHECK_THAT(error.what(), Catch::Contains("\"best\"") && Catch::Contains("draft, normal, good, fine, finer or reference"));
    }
}
