// `calcmysky verify` and `calcmysky reference`: samples, the judge's shares of time, tables, and the programs.

#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "model/error_summary.hpp"
#include "process.hpp"
#include "reference_queries.hpp"
#include "verify_judge.hpp"
#include "verify_report.hpp"
#include "verify_samples.hpp"

using namespace sky;
using namespace sky::cli;
using Catch::Contains;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Molecules alone over a grey ground, in two colours; radius and scale height as asked.
physics::Medium exponentialAir(const double planetRadius, const double scaleHeight)
{
    physics::Medium m;
    m.planetRadius = planetRadius;
    m.topOfAtmosphere = 15 * scaleHeight;
    m.sunAngularRadius = 0.0046;
    m.wavelengthsNm = {450, 650};
    m.solarIrradiance = {1.8, 1.5};
    m.groundAlbedo = {0.1, 0.2};
    physics::Species air;
    air.name = "air";
    for (int k = 0; k <= 60; ++k) {
        m.altitudes.push_back(m.topOfAtmosphere * k / 60);
        air.numberDensity.push_back(1e25 * std::exp(-m.altitudes.back() / scaleHeight));
    }
    for (int i = 0; i <= 180; ++i) {
        m.scatteringAngles.push_back(std::numbers::pi * i / 180);
        for (int w = 0; w < 2; ++w)
            air.phaseFunction.push_back(3 / (16 * std::numbers::pi) * (1 + std::pow(std::cos(m.scatteringAngles.back()), 2)));
    }
    air.extinctionCrossSection = {0.24 / (1e25 * scaleHeight), 0.055 / (1e25 * scaleHeight)};
    air.singleScatteringAlbedo = {1, 1};
    m.species.push_back(air);
    return m;
}

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("error summary: noise adds its variance and is taken off again")
{
    // Errors of exactly 3 and 5 parts with a noise of 4 are, on average over signs, errors of 0: 3^2 + 5^2 = 2 4^2 + 2.
    model::ErrorSummary summary;
    summary.add(3e-3, 4e-3);
    summary.add(-5e-3, 4e-3);
    CHECK(summary.rms() == Approx(1e-3));
    CHECK(summary.mean() == Approx(-1e-3));
    CHECK(summary.noise() == Approx(4e-3));
    CHECK(summary.worst() == Approx(5e-3));
    // A difference smaller than the noise is no error that could be told, and the uncertainty says how large it may be.
    model::ErrorSummary small;
    small.add(1e-3, 4e-3);
    CHECK(small.rms() == 0);
    CHECK(small.uncertainty() == Approx(std::pow(2., 0.25) * 4e-3));
    model::ErrorSummary exact;
    exact.add(0.02, 0);
    CHECK(exact.rms() == Approx(0.02));
    CHECK(exact.uncertainty() == 0);
}

TEST_CASE("samples: on the Earth they lie where its regimes are")
{
    const SampleScale scale = sampleScale(exponentialAir(6371e3, 8e3));
    CHECK(scale.suns[0].low / degree == Approx(4).margin(0.3));
    CHECK(scale.suns[1].low / degree == Approx(-1).margin(0.1));
    CHECK(scale.suns[2].low / degree == Approx(-6).margin(0.5));
    REQUIRE(scale.altitudes.size() == 5);
    CHECK(scale.altitudes[0] == 0);
    CHECK(scale.altitudes[2] == Approx(12e3).epsilon(0.1));
    CHECK(scale.altitudes[4] == 120e3);
}

TEST_CASE("samples: inside the air, clear of the Sun, in every cell, on planets of any size")
{
    const double radius = GENERATE(100e3, 3390e3, 6371e3, 70e6);
    const physics::Medium medium = exponentialAir(radius, 10e3);
    const auto samples = sampleSky(medium, 9);
    REQUIRE(samples.size() == 3 * 5 * 9);
    int downwards = 0, throughTheLimb = 0, groundFromSpace = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto& q = samples[i].query;
        INFO("sample " << i);
        CHECK(static_cast<std::size_t>(samples[i].regime) == i / 45);
        CHECK((q.altitude >= 0 && q.altitude <= medium.topOfAtmosphere));
        CHECK((q.viewZenithAngle >= 0 && q.viewZenithAngle <= std::numbers::pi));
        CHECK((q.wavelength == 0 || q.wavelength == 1));
        if (samples[i].altitudeIndex == 0)
            CHECK(q.viewZenithAngle <= std::numbers::pi / 2);
        if (samples[i].altitudeIndex == 4) { // nothing there is above the camera
            const double nearest = (radius + medium.topOfAtmosphere) * std::sin(q.viewZenithAngle);
            CHECK((q.viewZenithAngle > std::numbers::pi / 2 && nearest < radius + medium.topOfAtmosphere));
            ++(nearest < radius ? groundFromSpace : throughTheLimb);
            continue;
        }
        downwards += q.viewZenithAngle > std::numbers::pi / 2 + 0.1;
        const double cosine = std::cos(q.viewZenithAngle) * std::cos(q.sunZenithAngle) +
                              std::sin(q.viewZenithAngle) * std::sin(q.sunZenithAngle) * std::cos(q.relativeAzimuth);
        CHECK(cosine < std::cos(5 * degree));
    }
    CHECK(downwards > 9);
    CHECK(groundFromSpace > 15); // of 27
    CHECK(throughTheLimb > 3);
    // More rows begin with fewer: results of short and long runs can be compared row by row.
    CHECK(sampleSky(medium, 20)[20].query.sunZenithAngle == samples[9].query.sunZenithAngle);
}

TEST_CASE("samples: wavelengths without sunlight are left out, and none at all is refused")
{
    physics::Medium medium = exponentialAir(6371e3, 8e3);
    medium.solarIrradiance = {0, 1};
    for (const Sample& sample : sampleSky(medium, 6))
        CHECK(sample.query.wavelength == 1);
    medium.solarIrradiance = {0, 0};
    CHECK_THROWS_WITH(sampleSky(medium, 6), Contains("no sunlight"));
}

TEST_CASE("judge: rows are as noisy as asked, or share the time")
{
    const montecarlo::Reference reference(exponentialAir(6371e3, 8e3));
    const std::vector<montecarlo::Query> queries{{0, 60 * degree, 30 * degree, 1, 0}, {0, 88 * degree, 80 * degree, 2, 1}};
    JudgeSettings settings;
    settings.orders = 2;
    settings.relativeError = 3e-3;
    double progress = 0;
    const auto unlimited = judge(reference, queries, settings, [&](double f) { progress = f; });
    CHECK(progress == 1);
    for (const auto& result : unlimited)
        CHECK(relativeNoise(result) <= 3e-3);
    settings.seconds = 1.5;
    settings.relativeError = 1e-4;
    settings.seed = 5;
    const auto limited = judge(reference, queries, settings, [](double) {});
    for (std::size_t i = 0; i < queries.size(); ++i) {
        CHECK(limited[i].single == unlimited[i].single);
        // Two estimates with independent noise: 4 standard errors are passed once in 10^4 times, and seeds are fixed.
        CHECK(std::abs(limited[i].multiple - unlimited[i].multiple) <
              4 * std::hypot(limited[i].multipleStderr, unlimited[i].multipleStderr));
    }
}

TEST_CASE("judge: time goes to the row that is of use soonest, then to the noisiest, never to one without light")
{
    const auto row = [](const double noise, const double light = 1, const std::int64_t paths = 1 << 20) {
        montecarlo::Result r;
        r.multiple = light;
        r.multipleStderr = noise * light;
        r.paths = paths;
        return r;
    };
    CHECK(neediest({row(0.001), row(0.9), row(0.2), row(0.04)}, 1e-3) == 2);
    CHECK(neediest({row(0.001), row(0.02), row(0.04)}, 1e-3) == 2);
    CHECK(neediest({row(0.01), row(0.04, 1, 100)}, 1e-3) == 1); // so few paths don't know how noisy they are
    CHECK(neediest({row(0.02), row(0.2, 1e-20), row(0, 0)}, 1e-3) == 0);
    CHECK(neediest({row(1e-4), row(0.2, 1e-20)}, 1e-3) == 2);
}

TEST_CASE("queries: columns in any order, a table of results can be asked again, mistakes are named")
{
    const std::vector<double> wavelengths{391.333, 485.333};
    const EclipseScale scale{1737.4e3, 1.5e11};
    std::istringstream good("lambda_nm,note,altitude_m,sza_deg,vza_deg,relaz_deg\n485.333,x,2000,95,89.5,180\r\n\n");
    const auto queries = readQueries(good, "q.csv", wavelengths, scale);
    REQUIRE(queries.size() == 1);
    CHECK(queries[0].altitude == 2000);
    CHECK(queries[0].sunZenithAngle == Approx(95 * degree));
    CHECK(queries[0].viewZenithAngle == Approx(89.5 * degree));
    CHECK(queries[0].relativeAzimuth == Approx(std::numbers::pi));
    CHECK(queries[0].wavelength == 1);
    CHECK_FALSE(queries[0].moon.has_value());
    std::istringstream eclipse("lambda_nm,altitude_m,sza_deg,vza_deg,relaz_deg,moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m\n"
                               "485.333,0,40,30,20,40.1,-0.2,371925e3\n485.333,0,40,30,20,,,\n");
    const auto moons = readQueries(eclipse, "q.csv", wavelengths, scale);
    REQUIRE((moons.size() == 2 && moons[0].moon && !moons[1].moon));
    CHECK(moons[0].moon->zenithAngle == Approx(40.1 * degree));
    CHECK(moons[0].moon->relativeAzimuth == Approx(-0.2 * degree));
    CHECK(moons[0].moon->distance == 371925e3);
    CHECK(moons[0].moon->radius == 1737.4e3);
    const std::string header = "altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm\n";
    const auto complaint = [&](const std::string& text) {
        std::istringstream file(text);
        try {
            readQueries(file, "q.csv", wavelengths, scale);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(complaint("altitude_m,sza_deg,vza_deg,lambda_nm\n"), Contains("q.csv:1: there is no column `relaz_deg`"));
    CHECK_THAT(complaint(header + "0,10,20,30,400\n"), Contains("q.csv:2: ") && Contains("391.333, 485.333"));
    CHECK_THAT(complaint(header + "0,10,20,30,391.333\n0,ten,20,30,391.333\n"), Contains("q.csv:3: sza_deg is `ten`"));
    CHECK_THAT(complaint("moon_zenith_deg," + header), Contains("needs all of moon_zenith_deg, moon_azimuth_deg"));
    CHECK_THAT(complaint(header + "0,10\n"), Contains("vza_deg is ``"));
    CHECK_THAT(complaint(header + "-5,10,20,30,391.333\n"), Contains("altitude_m is negative"));
}

TEST_CASE("report: cells hold their rows, the largest error is found")
{
    Verification v;
    v.directory = "model";
    v.source = "moments";
    v.scale = sampleScale(exponentialAir(6371e3, 8e3));
    VerifiedRow row;
    row.sample = {Regime::Sunset, 2, {12e3, 1.55, 1, 0, 0}};
    row.judged.single = 0.5;
    row.judged.multiple = 0.5;
    row.modelSingle = 0.51;
    row.modelMultiple = 0.52;
    v.rows = {row};
    CHECK(row.error() == Approx(0.03));
    CHECK(row.singleError() == Approx(0.01));
    CHECK(largestError(v) == Approx(0.03));
    std::ostringstream table, text;
    printTable(v, table);
    CHECK_THAT(table.str(), Contains("all orders") && Contains("nothing to compare") && Contains("3.00 %") && Contains("1.00 %") &&
                                Contains("from space"));
    writeJson(v, text);
    const auto json = nlohmann::json::parse(text.str());
    CHECK(json["orders"] == "all");
    CHECK(json["cells"].size() == 15);
    CHECK(json["regimes"]["sunset"]["rms_error"].get<double>() == Approx(0.03));
    CHECK(json["rows"][0]["error"].get<double>() == Approx(0.03));
    v.rows.clear(); // an error of nothing is none, and says nothing
    v.unsureRows = 90;
    CHECK_THROWS_WITH(largestError(v), Contains("No sample of model could be judged") && Contains("of 90 the reference stayed unsure"));
}

TEST_CASE("verify and reference: what to look at must be said")
{
    const auto complaint = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), CALCMYSKY);
        test::Run run;
        run.arguments = arguments;
        const auto outcome = test::run(run);
        CHECK(outcome.exitCode == 2);
        return outcome.error;
    };
    CHECK_THAT(complaint({"verify"}), Contains("Which model?"));
    CHECK_THAT(complaint({"verify", "no-such-model"}), Contains("no-such-model"));
    CHECK_THAT(complaint({"verify", "m", "--fail-above", "2"}), Contains("--fail-above"));
    CHECK_THAT(complaint({"verify", "m", "--seconds", "0"}), Contains("--seconds"));
    CHECK_THAT(complaint({"reference"}), Contains("Which atmosphere?"));
    CHECK_THAT(complaint({"reference", "m"}), Contains("Where to look?"));
    CHECK_THAT(complaint({"reference", "m", "q.csv", "--grid", "default"}), Contains("Where to look?"));
    CHECK_THAT(complaint({"reference", "m", "--grid", "fine"}), Contains("--grid"));
    CHECK_THAT(complaint({"reference", "m", "q.csv", "--ground-light", "distance=5km"}), Contains("needs a radius"));
    CHECK_THAT(complaint({"reference", "m", "q.csv", "--ground-light", "radus=5km"}), Contains("Did you mean `radius`?"));
}

TEST_CASE("verify finds a good model good, and reference answers its own table", "[gl][slow]")
{
    const test::TemporaryDirectory directory;
    const auto calcmysky = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), CALCMYSKY);
        test::Run run;
        run.arguments = arguments;
        run.directory = directory.path();
        return test::run(run);
    };
    if (calcmysky({"doctor"}).exitCode != 0) {
        WARN("skipped: no OpenGL 4.3 here; see calcmysky doctor");
        return;
    }
    const std::string earth = std::string(SKY_SOURCE_DIR) + "/bench/earth-small-4-wavelengths.atmo";
    REQUIRE(calcmysky({earth, "--out-dir", "model", "--only", "moments", "-q"}).exitCode == 0);
    const auto verified = calcmysky({"verify", "model", "--seconds", "12", "--json", "model.json", "-q", "--fail-above", "0.1"});
    INFO(verified.output << verified.error);
    CHECK(verified.exitCode == 0);
    CHECK_THAT(verified.output, Contains("orders 1 to 4") && Contains("twilight"));
    const auto json = nlohmann::json::parse(contentOf(directory.path() / "model.json"));
    // The goals for moments are 0.3 and 0.4 %; the rest is the judge's noise in so short a time.
    CHECK(json["regimes"]["day"]["rms_error"].get<double>() < 0.01);
    CHECK(json["regimes"]["sunset"]["rms_error"].get<double>() < 0.015);
    const std::size_t samples = json["rows"].size() + json["unsure_samples"].get<std::size_t>() + json["dark_samples"].get<std::size_t>();
    CHECK(samples == 90);

    // Air so thin that its light is nobody's: its error isn't known, and no bound is met.
    const std::regex thickness("cross section at 1 um: [^ ]*");
    directory.file("dark.atmo", std::regex_replace(contentOf(earth), thickness, "cross section at 1 um: 1e-25"));
    REQUIRE(calcmysky({"dark.atmo", "--out-dir", "dark", "--only", "moments", "-q"}).exitCode == 0);
    const auto dark = calcmysky({"verify", "dark", "--seconds", "1", "-q", "--fail-above", "0.1"});
    INFO(dark.output << dark.error);
    CHECK(dark.exitCode == 1);
    CHECK_THAT(dark.error, Contains("No sample of dark could be judged"));

    directory.file("q.csv", "altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm\n0,60,30,90,391.333\n");
    const auto asked = calcmysky({"reference", "model", "q.csv", "--relative-error", "0.003", "-q"});
    INFO(asked.error);
    REQUIRE(asked.exitCode == 0);
    CHECK_THAT(asked.output, Contains("\nmodel,4,0,60,30,90,391.333,"));
    // The same from the description, and from what came out before.
    directory.file("again.csv", asked.output);
    const auto again = calcmysky({"reference", earth, "again.csv", "--relative-error", "0.003", "-q", "-o", "out.csv"});
    INFO(again.error);
    CHECK(again.exitCode == 0);
    CHECK_THAT(contentOf(directory.path() / "out.csv"), Contains("earth-small-4-wavelengths,4,0,60,30,90,391.333,"));
}
