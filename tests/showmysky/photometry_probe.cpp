// `showmysky probe` and `showmysky info` as their users run them.

#include "../calcmysky/process.hpp"
#include "showmysky/photometry.hpp"
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

namespace {

using sky::test::Outcome;

constexpr auto header = "altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg\n";

Outcome runProgram(std::vector<std::string> arguments, const std::string& input = {})
{
    arguments.insert(arguments.begin(), SHOWMYSKY);
    sky::test::Run what;
    what.arguments = arguments;
    what.input = input;
    return sky::test::run(what);
}

Outcome probe(const std::string& input, std::vector<std::string> options = {})
{
    options.insert(options.begin(), {"probe", SHOWMYSKY_TEST_MODEL, "-"});
    return runProgram(options, input);
}

std::vector<std::string> split(const std::string& text, char by)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, by);)
        parts.push_back(part);
    return parts;
}

} // namespace

TEST_CASE("probe: repeats the columns and adds what the library answers")
{
    const auto outcome = probe("view_zenith_deg,name,altitude_m,sun_azimuth_deg,view_azimuth_deg,sun_zenith_deg\r\n"
                               "60,noon,0,10,100,30\r\n\r\n95,dusk,2000,10,100,+9.1e1\r\n");
    INFO(outcome.error);
    REQUIRE(outcome.exitCode == 0);
    const auto lines = split(outcome.output, '\n');
    REQUIRE(lines.size() == 3);
    const auto names = split(lines[0], ','), values = split(lines[2], ',');
    const showmysky::Photometer photometer(SHOWMYSKY_TEST_MODEL);
    const std::size_t count = photometer.wavelengthsNm().size();
    REQUIRE(names.size() == 6 + count);
    REQUIRE(values.size() == names.size());
    CHECK(names[1] == "name");
    CHECK(names[7] == "L_391.3333nm");
    CHECK(lines[2].starts_with("95,dusk,2000,10,100,+9.1e1,"));
    const double degree = std::acos(-1.) / 180;
    std::vector<double> expected(count);
    photometer.radiance({2000, 91 * degree, 0, 95 * degree, 90 * degree}, showmysky::Photometer::wholeSky, expected.data());
    for (std::size_t w = 0; w < count; ++w)
        CHECK(std::stod(values[6 + w]) == Approx(expected[w]).epsilon(1e-4));
}

TEST_CASE("probe: textures give luminance near that of the moments")
{
    const std::string questions = std::string(header) + "0,40,0,60,120\n0,40,0,20,30\n";
    const auto textures = probe(questions, {"--source", "textures", "--layers", "single,multiple"});
    INFO(textures.error);
    REQUIRE(textures.exitCode == 0);
    const auto lines = split(textures.output, '\n');
    REQUIRE(lines.at(0).ends_with(",X,Y,Z,scotopic"));
    const showmysky::Photometer photometer(SHOWMYSKY_TEST_MODEL);
    const double degree = std::acos(-1.) / 180;
    const auto expected = photometer.luminance({0, 40 * degree, 0, 60 * degree, 120 * degree}, 6);
    CHECK(std::stod(split(lines.at(1), ',').at(6)) == Approx(expected.Y).epsilon(0.03)); // a small model's textures
}

TEST_CASE("probe: light pollution is answered from both sources, and cities are added to what was asked for")
{
    const std::string questions = std::string(header) + "2000,170,0,60,120\n";
    const showmysky::Photometer photometer(SHOWMYSKY_TEST_MODEL);
    const double degree = std::acos(-1.) / 180;
    const showmysky::Photometer::View view{2000, 170 * degree, 0, 60 * degree, 120 * degree};
    const auto glow = photometer.luminance(view, showmysky::Photometer::lightPollution);
    const auto textures = probe(questions, {"--source", "textures", "--layers", "light-pollution"});
    INFO(textures.error);
    REQUIRE(textures.exitCode == 0);
    CHECK(std::stod(split(split(textures.output, '\n').at(1), ',').at(6)) == Approx(glow.Y).epsilon(0.01));

    const std::vector<showmysky::City> cities{{20e3, 90 * degree, 3e3, 2, {}}, {9e3, 150 * degree, 3e3, 1, {}}};
    std::vector<double> light(photometer.wavelengthsNm().size()), own(light.size());
    photometer.radiance(view, showmysky::Photometer::lightPollution, own.data());
    photometer.cityRadiance(&view, 1, cities, light.data());
    const auto both = probe(questions, {"--layers", "light-pollution", "--city", "distance=20km,azimuth=90,radius=3km,luminance=2",
                                        "--city", "distance=9000 m, azimuth=150, radius=3km"});
    INFO(both.error);
    REQUIRE(both.exitCode == 0);
    const auto values = split(split(both.output, '\n').at(1), ',');
    for (const std::size_t w : {std::size_t(3), light.size() - 1})
        CHECK(std::stod(values.at(5 + w)) == Approx(own[w] + light[w]).epsilon(1e-5));
}

TEST_CASE("probe: bad rows are named by line and column")
{
    const auto outcome = probe(std::string(header) + "0,30,0,45\n0,x,0,45,90\n-1,30,0,45,90\n0,30,,45,90\n0,30,0,181,90\n"
                                                     "0,30,0,nan,90\n0,30,0,4 5,90\n1,2,3,4,5,6\n");
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.output.empty());
    const auto lines = split(outcome.error, '\n');
    const std::vector<std::string> expected{":2:8: the line has 4 cells; the header has 5.",
                                            ":3:3: sun_zenith_deg is \"x\"",
                                            ":4:1: altitude_m is -1; expected 0 or more.",
                                            ":5:6: sun_azimuth_deg is empty",
                                            ":6:8: view_zenith_deg is 181; expected 0 to 180.",
                                            ":7:8: view_zenith_deg is \"nan\"",
                                            ":8:8: view_zenith_deg is \"4 5\"",
                                            ":9:11: the line has 6 cells"};
    REQUIRE(lines.size() == expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
        CHECK_THAT(lines[i], Catch::StartsWith("standard input" + expected[i]));
}

TEST_CASE("probe: bad headers and options are refused with a sentence")
{
    const auto refused = [](const Outcome& outcome, const std::string& words) {
        CHECK(outcome.exitCode == 2);
        CHECK_THAT(outcome.error, Catch::Contains(words));
    };
    refused(probe(""), "is empty");
    refused(probe("altitude,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg\n"), "Did you mean `altitude`?");
    refused(probe("altitude_m," + std::string(header)), "is there twice");
    refused(probe("moon_zenith_deg," + std::string(header)), "all of moon_zenith_deg, moon_azimuth_deg and earth_moon_distance_m");
    refused(probe("moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m," + std::string(header) + "30,0,384400e3,0,30,0,45,90\n",
                  {"--source", "textures"}),
            "hold no eclipses");
    refused(probe(std::string(header) + "0,30,0,45,90\n", {"--city", "distance=5 miles"}), "of metres, or of kilometres with km");
    refused(probe(std::string(header) + "0,30,0,45,90\n", {"--city", "radus=5km"}), "Did you mean `radius`?");
    refused(probe(std::string(header) + "0,30,0,45,90\n", {"--city", "radius=5km,radius=6km"}), "given twice");
    refused(probe(header, {"--layers", "singel"}), "Did you mean `single`?");
    refused(probe(header, {"--source", "guess"}), "moments, textures or cpu");
    refused(runProgram({"probe", SHOWMYSKY_TEST_MODEL}), "needs a CSV file");
    refused(runProgram({"probe", SHOWMYSKY_TEST_MODEL, "nowhere.csv"}), "'nowhere.csv' can't be read");
    refused(runProgram({"probe", "nowhere", "-"}, header), "no model directory");
}

TEST_CASE("info: prints what the model holds, as text and as JSON")
{
    const auto text = runProgram({"info", SHOWMYSKY_TEST_MODEL, "--verify"});
    INFO(text.error);
    REQUIRE(text.exitCode == 0);
    for (const char* words : {"6371 km", "molecules, scatters", "ozone, absorbs only", "moments.exr", "sunElevation", "checksums"})
        CHECK_THAT(text.output, Catch::Contains(words));
    const auto json = runProgram({"info", SHOWMYSKY_TEST_MODEL, "--json"});
    CHECK(json.output.starts_with("{\n  \"format\": \"sky model\""));
    CHECK(runProgram({"info", "nowhere"}).exitCode == 2);
}
