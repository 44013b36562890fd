// Scenes at the edges of the language: all are computed, and every number is one.
#include "model/evaluate.hpp"
#include "model/medium_tables.hpp"
#include "physics/colour.hpp"
#include "support.hpp"
#include <algorithm>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

double largest(const model::Model& model, const std::string& table)
{
    const auto values = model.readAll(table);
    return double(*std::max_element(values.begin(), values.end()));
}

} // namespace

TEST_CASE("edge scene: a vacuum lets all light pass, and what it lacks is skipped with a reason", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.species = "";
    const Run run(*context, scene.parse());
    checkValues(run.model);
    CHECK(tableNames(run.model) == std::set<std::string>{"transmittance", "irradiance-direct"});
    CHECK(model::readMedium(run.model).species.empty());
    for (const float t : run.model.readAll("transmittance"))
        CHECK(t == 1.F);
    CHECK(largest(run.model, "irradiance-direct") == Approx(1.5).epsilon(1e-5)); // the Sun at the zenith
    std::set<std::string> dark;
    for (const auto& skipped : run.model.manifest().skipped)
        if (skipped.why == "nothing in this atmosphere scatters")
            dark.insert(skipped.what);
    CHECK(dark == std::set<std::string>{"moments", "single", "multiple", "eclipsed"});
}

TEST_CASE("edge scene: smoke that only absorbs has a transmittance and no sky", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.species = scene.absorber();
    const Run run(*context, scene.parse());
    checkValues(run.model);
    CHECK(tableNames(run.model) == std::set<std::string>{"medium", "transmittance", "irradiance-direct"});
    // Vertical optical depth 1e5 x 1e-10 x 8000 = 0.08 but for what is above 100 km: last view of the first altitude.
    const auto t = run.model.readAll("transmittance");
    CHECK(double(t[3 * 2]) == Approx(std::exp(-0.08 * (1 - std::exp(-12.5)))).epsilon(1e-4)); // densities to 1e-4 and 3e-4
}

TEST_CASE("edge scene: scatterers that scatter nothing cost nothing", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.species = SceneText::rayleigh() + SceneText::dust("general", "single scattering albedo: 0, 0") +
                    SceneText::scatterer("ghost", "1e20", "vec4(1.0/(4.0*PI))", "smooth", "0 um^2");
    const Run run(*context, scene.parse());
    checkValues(run.model);
    CHECK(run.has("single-scattering/air"));
    CHECK_FALSE(run.has("single-scattering/dust"));
    CHECK_FALSE(run.has("single-scattering/ghost"));
    // Alone they make no sky at all, though they still absorb.
    scene.species = SceneText::dust("general", "single scattering albedo: 0, 0");
    const Run black(*context, scene.parse());
    checkValues(black.model);
    CHECK(tableNames(black.model) == std::set<std::string>{"medium", "phase-functions", "transmittance", "irradiance-direct"});
    CHECK(double(black.model.readAll("transmittance")[3 * 2]) == Approx(std::exp(-0.05)).epsilon(1e-4));
}

TEST_CASE("edge scene: one order makes single scattering only", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.orders = "1";
    const Run run(*context, scene.parse());
    checkValues(run.model);
    CHECK(tableNames(run.model) == std::set<std::string>{"medium", "phase-functions", "transmittance", "irradiance-direct",
                                                         "irradiance-diffuse", "single-scattering/air"});
    CHECK(run.model.manifest().scatteringOrders == 1);
}

TEST_CASE("edge scene: all orders end by themselves, over white ground too, and white is brighter than black", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.orders = "all";
    double brightness[2];
    for (const int albedo : {0, 1}) {
        scene.albedo = std::to_string(albedo);
        const Run run(*context, scene.parse());
        checkValues(run.model);
        CHECK(run.model.manifest().allScatteringOrders);
        const int events = std::stoi(run.model.manifest().settings.at("moments.events"));
        CHECK(events > 2);
        CHECK(events < 60);
        CHECK(run.model.manifest().estimatedError.at("orders left out") < 5e-3); // as `draft` asks for
        brightness[albedo] = largest(run.model, "multiple-scattering");
    }
    CHECK(brightness[1] > 1.2 * brightness[0]);
}

TEST_CASE("edge scene: all orders of a cloud without end are found as far as they are, and a warning says so", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.orders = "all";
    scene.albedo = "0";
    scene.radius = "256e6 m";
    scene.top = "1e6 m";
    // A cloud of optical depth 100 000 that absorbs nothing, and no air under it.
    scene.species = SceneText::scatterer("drops", "max(0.0, 1.0 - sqr(altitude/34e3 - 10.0))", "vec4(1.0/(4.0*PI))", "achromatic",
                                         "2.2 m^2", "single scattering albedo: 1, 1");
    Options options = draft();
    options.parts = {Part::Moments};
    const Run deep(*context, scene.parse(), options);
    checkValues(deep.model);
    REQUIRE(deep.listener.warnings.size() == 1);
    CHECK_THAT(deep.listener.warnings[0], Catch::StartsWith("Light scattered any number of times had not ended after "));
    CHECK(deep.model.manifest().warnings == deep.listener.warnings);
    CHECK(deep.model.manifest().estimatedError.at("orders left out") > 0.005);
    // Late events look so much alike that each changes the light by less than this long before most of it is there.
    options.tolerance = 0.02;
    const Run coarse(*context, scene.parse(), options);
    REQUIRE(coarse.listener.warnings.size() == 1);
    CHECK(coarse.model.manifest().estimatedError.at("orders left out") > 0.02);
    options.tolerance = {};
    scene.species = SceneText::rayleigh();
    const Run shallow(*context, scene.parse(), options);
    CHECK(shallow.listener.warnings.empty());
}

TEST_CASE("edge scene: planets and atmospheres of every size", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    for (const char* radius : {"100 km", "10 Gm"})
        for (const char* top : {"1 m", "1 Mm"}) {
            SceneText scene;
            scene.radius = radius;
            scene.top = top;
            scene.species = SceneText::rayleigh("1.5e24*exp(-8.0*altitude/atmosphereHeight)");
            INFO("R " << radius << " H " << top);
            const Run run(*context, scene.parse());
            checkValues(run.model);
            CHECK(largest(run.model, "single-scattering/air") > 0);
            CHECK(largest(run.model, "multiple-scattering") > 0);
        }
}

TEST_CASE("edge scene: a Sun that fills the sky, and one that is a point", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    for (const char* sun : {"0.5 AU", "1e20 AU"}) {
        SceneText scene;
        scene.sun = sun;
        INFO(sun);
        const Run run(*context, scene.parse());
        checkValues(run.model);
        CHECK(largest(run.model, "multiple-scattering") > 0);
        const auto direct = run.model.readAll("irradiance-direct"); // on the ground, Sun at the zenith; half a degree of disc
        CHECK(double(direct[3 * 2]) == Approx(1.5 * std::exp(-0.12)).epsilon(1e-3));
    }
}

TEST_CASE("edge scene: air of optical depth 1000", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.orders = "2"; // many levels: each sweep takes a second
    scene.species = SceneText::rayleigh("1.25e28*exp(-altitude/(8.0*km))");
    const Run run(*context, scene.parse());
    checkValues(run.model);
    // From space it is a bright ball; on the ground no sunlight arrives by itself.
    CHECK(largest(run.model, "single-scattering/air") > 0);
    CHECK(largest(run.model, "transmittance") == Approx(1));
    const auto direct = run.model.readAll("irradiance-direct");
    CHECK(direct[3 * 2] == 0.F); // Sun at the zenith, seen from the ground: exp(-1000)
}

TEST_CASE("edge scene: one wavelength, and a Sun without light", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.wavelengths = 1;
    scene.minNm = scene.maxNm = 555;
    const Run run(*context, scene.parse());
    checkValues(run.model);
    const auto xyz = run.model.readAll("multiple-scattering");
    const auto weights = physics::luminanceWeights({555});
    std::size_t brightest = 0; // texel
    for (std::size_t texel = 0; texel < xyz.size() / 4; ++texel)
        brightest = xyz[texel * 4 + 1] > xyz[brightest * 4 + 1] ? texel : brightest;
    CHECK(double(xyz[brightest * 4] / xyz[brightest * 4 + 1]) == Approx(weights[0][0] / weights[0][1]).epsilon(2e-3)); // 11 bits
    auto night = scene.parse();
    night.solarIrradiance = {0};
    const Run dark(*context, night);
    checkValues(dark.model);
    CHECK(tableNames(dark.model) == std::set<std::string>{"medium", "phase-functions", "transmittance"});
}

TEST_CASE("edge scene: light scattered once knows nothing of its phase function at other angles", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const auto skyOf = [&](const std::string& phase) {
        SceneText scene;
        scene.orders = "1";
        scene.species = SceneText::scatterer("dust", "1e24*exp(-altitude/(8.0*km))", "vec4(" + phase + ")", "achromatic", "100 fm^2");
        const Run run(*context, scene.parse());
        CHECK(run.model.manifest().settings.at("moments.truncatePeaks") == "no");
        return model::openSky(run.model, model::SkySource::Moments);
    };
    // Half of the light goes into a peak of a degree; the optical depth is 0.8.
    const auto even = skyOf("0.25/PI"), peaked = skyOf("0.125/PI + 0.5*exp(-sqr(acos(clamp(dotViewSun, -1.0, 1.0))/0.02))/(PI*0.0004)");
    for (const double sun : {0.3, 1.4, 1.6})
        for (const double view : {0.1, 1., 1.5}) {
            const model::SkyGeometry place{0, sun, view, 2};
            CHECK(peaked->radiance(place).single[0] ==
                  Approx(0.5 * even->radiance(place).single[0]).epsilon(0.003)); // the tabulated peak's integral
        }
}
