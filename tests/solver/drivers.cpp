// Drivers differ in their functions: what is computed must not.
#include "../gl/poor_driver.hpp"
#include "../gl/shader_interceptor.hpp"
#include "model/medium_tables.hpp"
#include "physics/profile.hpp"
#include "support.hpp"
#include <algorithm>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

/// A scene with something of everything: two scatterers, one of them hazy and sharp, an absorber, light pollution.
atmo::Description scene()
{
    SceneText text;
    text.species =
        SceneText::rayleigh() + SceneText::dust() + text.absorber() + "light pollution relative radiance: " + text.all("1") + "\n";
    text.views = "8", text.azimuths = "4", text.suns = "8";
    return text.parse();
}

Options wholeDigits()
{
    Options options = draft();
    options.texturePrecisionBits = 24; // tables as they were computed
    return options;
}

/// A scene whose own code calls what drivers may get wrong by most: angles by acos and asin, a profile by atan and tanh.
atmo::Description sceneOfAngles()
{
    SceneText text;
    text.species = SceneText::scatterer("air", "1.5e24*exp(-altitude/(8.0*km))*(1.0+0.1*atan(altitude/km)+0.1*tanh(altitude/(3.0*km)))",
                                        "vec4(1.0+0.5*cos(2.0*acos(clamp(dotViewSun, -1.0, 1.0)))+0.2*asin(clamp(dotViewSun, -1.0, 1.0)))",
                                        "general", "10 fm^2");
    text.views = "8", text.azimuths = "4", text.suns = "8";
    return text.parse();
}

/// Largest relative difference of densities above 1e-6 of the largest, between the altitudes of either, and of phase functions.
double difference(const physics::Medium& a, const physics::Medium& b)
{
    const physics::Profile first(a), second(b);
    const std::size_t count = b.species.size();
    REQUIRE(a.species.size() == count);
    REQUIRE(a.scatteringAngles == b.scatteringAngles);
    std::vector<double> n(count), m(count);
    double result = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double altitude = b.topOfAtmosphere * std::pow(i / 1000., 2);
        first.densities(first.intervalAt(altitude), altitude, n.data());
        second.densities(second.intervalAt(altitude), altitude, m.data());
        for (std::size_t s = 0; s < count; ++s)
            if (m[s] > 1e-6 * *std::max_element(b.species[s].numberDensity.begin(), b.species[s].numberDensity.end()))
                result = std::max(result, std::abs(n[s] / m[s] - 1));
    }
    for (std::size_t s = 0; s < count; ++s)
        for (std::size_t i = 0; i < b.species[s].phaseFunction.size(); ++i)
            result = std::max(result, std::abs(a.species[s].phaseFunction[i] / b.species[s].phaseFunction[i] - 1));
    return result;
}

/// Largest relative difference of the values of a table that are above 1e-6 of its largest. Logarithms and ratios, which have signs:
/// absolute, below one.
double difference(const model::Model& model, const model::Model& reference, const model::Table& table)
{
    const auto a = model.readAll(table.name), b = reference.readAll(table.name);
    REQUIRE(a.size() == b.size());
    const float floor = 1e-6F * *std::max_element(b.begin(), b.end());
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (table.isSigned || b[i] > floor)
            result = std::max(result, std::abs(double(a[i]) - double(b[i])) / std::max(table.isSigned ? 1. : 0., std::abs(double(b[i]))));
    return result;
}

} // namespace

TEST_CASE("drivers: tables depend little on a driver that uses up the errors it may make", "[gl]")
{
    struct Case {
        const char* name;
        atmo::Description description;
        double medium, tables; ///< largest differences
    };
    // Light through an optical depth of 13 loses exp(-13), which may be wrong by 29 ULP: 3.5e-6; of that a few together.
    // Densities of exp(-12.5) may be wrong by 28 ULP: 3.3e-6, and are written as floats. Angles of 4096 ULP, 4.9e-4, stand in the description's own
    // formulas, and nothing makes them better: 1.4e-3 of phase functions, and 3.4e-3 of light scattered once where the noise is random.
    for (const Case& c : {Case{"of everything", scene(), 1e-5, 5e-5}, Case{"of angles", sceneOfAngles(), 2e-3, 5e-3}}) {
        auto good = gl::testing::context();
        if (!good)
            return;
        const Run reference(*good, c.description, wholeDigits());
        const physics::Medium medium = model::readMedium(reference.model);
        for (const char* noise : {"poor_random(x)", "1.0", "-1.0"}) {
            CAPTURE(c.name, noise);
            gl::testing::ShaderInterceptor interceptor(gl::testing::poorDriver(noise));
            auto poor = gl::testing::context();
            REQUIRE(poor);
            interceptor.standBefore(*poor);
            const Run run(*poor, c.description, wholeDigits());
            REQUIRE(interceptor.shaders() > 3);
            CHECK(difference(model::readMedium(run.model), medium) < c.medium);
            for (const auto& table : reference.model.tables()) {
                CAPTURE(table.name);
                if (table.name == "medium" || table.name == "phase-functions")
                    continue; // as a medium, above: its altitudes may be others
                CHECK(difference(run.model, reference.model, table) < c.tables);
            }
        }
    }
}
