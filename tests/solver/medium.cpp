// Descriptions become tables: densities and phase functions as their formulas say, and errors that point into the description.
#include "../atmo/sample.hpp"
#include "../gl/context_for_tests.hpp"
#include "base/error.hpp"
#include "physics/harmonics.hpp"
#include "physics/profile.hpp"
#include "solver/medium_tables.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace sky;

namespace {

double density(const physics::Medium& medium, double altitude)
{
    const physics::Profile profile(medium);
    std::vector<double> n(medium.species.size());
    profile.densities(profile.intervalAt(altitude), altitude, n.data());
    return n[0];
}

const std::string molecules = "return 3.08458e25*exp(-altitude/(8.0*km));";
const std::string rayleigh = "return vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)));";

int lineOf(const std::string& text, const std::string& what)
{
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(what)), '\n'));
}

} // namespace

TEST_CASE("medium: densities, cross sections and phase functions are what the description says", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    const auto medium = solver::evaluateMedium(sample::parse(sample::text), context->api(), warnings);
    CHECK(warnings.empty());
    CHECK(medium.planetRadius == 6371e3);
    CHECK(medium.altitudes.front() == 0);
    CHECK(medium.altitudes.back() == 120e3);
    CHECK(std::is_sorted(medium.altitudes.begin(), medium.altitudes.end()));
    for (const double h : {0., 1., 777., 20e3, 119e3})
        CHECK(density(medium, h) == Approx(3.08458e25 * std::exp(-h / 8e3)).epsilon(4e-4)); // 1e-4 and the profile's 3e-4
    REQUIRE(medium.species.size() == 2);
    for (int w = 0; w < 4; ++w)
        CHECK(medium.species[0].extinctionCrossSection[w] == Approx(0.04022e-30 * std::pow(0.4 + 0.1 * w, -4)));
    CHECK(medium.species[0].achromatic);
    CHECK_FALSE(medium.species[1].scatters());
    CHECK(medium.species[1].numberDensity[5] == Approx(370 * 2.687e20 / 30e3).epsilon(1e-6));
    const auto moments = physics::phaseMoments(medium, medium.species[0], 2, 3);
    CHECK(moments[0] == Approx(1).epsilon(1e-4)); // 1201 angles
    CHECK(moments[1] == Approx(0).margin(1e-4));
    CHECK(moments[2] == Approx(0.1).margin(1e-4));
}

TEST_CASE("medium: jumps and kinks of densities are found to within a millionth of the atmosphere", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    const auto text = sample::with(molecules, "return altitude < 2345.6 ? 0.0 : altitude < 3456.7 ? 1e9 : altitude < 9876.5 ? 1e7 : 0.0;");
    const auto medium = solver::evaluateMedium(sample::parse(text), context->api(), warnings);
    CHECK(medium.altitudes.size() < 3000);
    const auto& n = medium.species[0].numberDensity;
    for (const double edge : {2345.6, 3456.7, 9876.5}) {
        const auto above = std::upper_bound(medium.altitudes.begin(), medium.altitudes.end(), edge + 0.001) - medium.altitudes.begin();
        INFO("edge " << edge);
        CHECK(medium.altitudes[above] - medium.altitudes[above - 1] < 0.12 + 1e-3);
    }
    for (std::size_t k = 0; k < n.size(); ++k) {
        const double h = medium.altitudes[k], nearest = std::min({std::abs(h - 2345.6), std::abs(h - 3456.7), std::abs(h - 9876.5)});
        if (nearest > 1e-3)
            CHECK(n[k] == Approx(h < 2345.6 ? 0. : h < 3456.7 ? 1e9 : h < 9876.5 ? 1e7 : 0.));
    }
}

TEST_CASE("medium: a density that is no number or negative is named with its altitude and its line", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    for (const std::string code :
         {"return 1e9 - altitude*1e5;", "return altitude > 50e3 ? sqrt(50e3 - altitude) : 1.0;", "return 1.0/(altitude*0.0);"}) {
        const auto text = sample::with(molecules, code);
        INFO(code);
        try {
            solver::evaluateMedium(sample::parse(text), context->api(), warnings);
            FAIL("was accepted");
        } catch (const AtmoError& error) {
            CHECK(error.location().line == lineOf(text, code));
            CHECK_THAT(error.what(), Catch::Contains("number density is") && Catch::Contains("finite and not negative"));
            CHECK_THAT(error.what(), Catch::StartsWith("test.atmo:"));
        }
    }
}

TEST_CASE("medium: a phase function that is negative, no number or nothing is named with its line", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    for (const std::string code : {"return vec4(dotViewSun);", "return vec4(1.0/(1.0-dotViewSun));", "return vec4(0.0);"}) {
        const auto text = sample::with(rayleigh, code);
        INFO(code);
        try {
            solver::evaluateMedium(sample::parse(text), context->api(), warnings);
            FAIL("was accepted");
        } catch (const AtmoError& error) {
            CHECK(error.location().line == lineOf(text, code));
            CHECK_THAT(error.what(), Catch::Contains("phase function is"));
        }
    }
}

TEST_CASE("medium: code that does not compile is reported at its line of the description", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    const auto text = sample::with(molecules, "return 3.0*density0*exp(-altitude);");
    try {
        solver::evaluateMedium(sample::parse(text), context->api(), warnings);
        FAIL("was accepted");
    } catch (const AtmoError& error) {
        CHECK(error.location().line == lineOf(text, "density0"));
        CHECK_THAT(error.what(), Catch::Contains("density0"));
    }
}

namespace {

/// Isotropic scattering as it is after evaluation, of a phase function with such an integral.
void checkRescaled(const gl::Api& api, const std::string& integral, std::vector<std::string>& warnings)
{
    const auto medium =
        solver::evaluateMedium(sample::parse(sample::with(rayleigh, "return vec4(" + integral + "/(4.0*PI));")), api, warnings);
    CHECK(physics::phaseMoments(medium, medium.species[0], 0, 0)[0] == Approx(1).epsilon(1e-9));
}

} // namespace

TEST_CASE("medium: a phase function that does not integrate to one is rescaled, with a warning that says by how much", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    checkRescaled(context->api(), "1.5", warnings);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("\"molecules\"") && Catch::Contains("integrates to 1.5") && Catch::Contains("instead of 1"));
}

TEST_CASE("medium: a phase function that is a thousandth off is rescaled without a word, since events multiply it", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    checkRescaled(context->api(), "1.001", warnings);
    CHECK(warnings.empty());
}

TEST_CASE("medium: every example can be evaluated, and its phase functions scatter all light", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    int examples = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SKY_SOURCE_DIR "/examples")) {
        if (entry.path().extension() != ".atmo")
            continue;
        INFO(entry.path().filename().string());
        ++examples;
        std::vector<std::string> warnings;
        const auto description = atmo::parseFile(entry.path());
        const auto medium = solver::evaluateMedium(description, context->api(), warnings);
        for (const auto& warning : warnings)
            FAIL_CHECK(warning);
        CHECK(medium.species.size() == description.scatterers.size() + description.absorbers.size());
        for (const auto& species : medium.species) {
            INFO(species.name);
            CHECK(*std::max_element(species.numberDensity.begin(), species.numberDensity.end()) > 0);
            if (species.scatters())
                CHECK(physics::phaseMoments(medium, species, 0, 0)[0] == Approx(1).epsilon(1e-9));
        }
    }
    CHECK(examples >= 8);
}

TEST_CASE("medium: an optical depth beyond all that can be computed is named with its line", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    std::vector<std::string> warnings;
    const std::string code = "return 3e38*exp(-altitude/(8.0*km));";
    const auto text = sample::with(molecules, code);
    try {
        solver::evaluateMedium(sample::parse(text), context->api(), warnings);
        FAIL("was accepted");
    } catch (const AtmoError& error) {
        CHECK(error.location().line == lineOf(text, code));
        CHECK_THAT(error.what(), Catch::Contains("optical depth of ") && Catch::Contains("at most 1e+06"));
    }
}
