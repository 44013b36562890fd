// The table of light pollution in a model: when it is made, what it holds, and that its orders add up.
#include "model/glow_tables.hpp"
#include "model/medium_tables.hpp"
#include "physics/colour.hpp"
#include "physics/glow_light.hpp"
#include "physics/table_axes.hpp"
#include "support.hpp"

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

/// 500 nm and 560 nm, with a lamp whose luminance is 1 only after scaling.
SceneText lampScene()
{
    SceneText scene;
    scene.minNm = 500;
    scene.maxNm = 560;
    scene.species += "light pollution relative radiance: 2e-3, 1e-3\nlight pollution texture size for VZA: 16\n"
                     "light pollution texture size for altitude: 6\n";
    return scene;
}

Options onlyGlow()
{
    Options options = draft();
    options.parts = {Part::LightPollution};
    return options;
}

std::string whySkipped(const model::Model& model)
{
    for (const auto& s : model.manifest().skipped)
        if (s.what == "light-pollution")
            return s.why;
    return "it is there";
}

} // namespace

TEST_CASE("light pollution: nothing is computed without a spectrum, and the manifest says why", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const Run dark(*context, SceneText().parse(), onlyGlow());
    CHECK(tableNames(dark.model) == std::set<std::string>{"medium", "phase-functions"});
    CHECK(whySkipped(dark.model) == "the description gives no `light pollution relative radiance`");
    auto black = lampScene().parse();
    black.lightPollutionRadiance = {0, 0};
    const Run run(*context, black, onlyGlow());
    CHECK(whySkipped(run.model) == "the ground gives no visible light");
    CHECK_FALSE(run.has("light-pollution"));
}

TEST_CASE("light pollution: the ground itself has the luminance 1, from near by", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    auto scene = lampScene();
    scene.albedo = "0";
    const Run run(*context, scene.parse(), onlyGlow());
    checkValues(run.model);
    CHECK(whySkipped(run.model) == "it is there");
    REQUIRE(run.listener.warnings.size() == 1);
    CHECK_THAT(run.listener.warnings[0], Catch::Contains("was scaled to 1"));
    const model::GlowTable table(run.model);
    CHECK(table.isLuminance());
    const auto ground = table.slice(0);
    CHECK(ground[1] == Approx(1).epsilon(1e-6));                             // Y towards the nadir, from the ground
    CHECK(ground[(table.views() - 1) * 4 + 1] == Approx(0.08).margin(0.03)); // optical depth 0.12 above, half the sphere, more orders
    double value[4];
    table.sample(ground, 0, -0.3, value);
    CHECK(value[1] == Approx(1).epsilon(1e-6));
}

TEST_CASE("light pollution: spectral tables hold the scaled lamp, and agree with the moments", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    auto options = onlyGlow();
    options.radiance = true;
    const Run run(*context, lampScene().parse(), options);
    checkValues(run.model);
    const auto& lamp = run.model.manifest().lightPollutionRadiance;
    CHECK(lamp[0] == Approx(2 * lamp[1]));
    const auto weights = physics::luminanceWeights(run.model.manifest().wavelengthsNm);
    CHECK(lamp[0] * weights[0][1] + lamp[1] * weights[1][1] == Approx(1));

    const auto medium = model::readMedium(run.model);
    const auto moments = model::readGlow(run.model);
    const auto profile = physics::glowProfile(medium);
    const auto optics = physics::glowOptics(medium, moments.degree);
    const physics::GlowLight light(medium, optics, moments);
    physics::RayTracer tracer(profile, optics, physics::GlowSettings().cells);
    const model::GlowTable table(run.model);
    const auto altitudes = physics::altitudeNodes(profile.planet(), 6);
    for (const double altitude : {altitudes[0], altitudes[2], altitudes[5]}) {
        const auto slice = table.slice(altitude);
        const auto mu = physics::viewMuNodes(profile.planet(), altitude, table.views());
        for (const int k : {0, 5, 7, 8, 12, 15}) {
            double direct[2];
            light.seen(tracer.cells(altitude, mu[k], k < 8, physics::GlowLight::deepest), direct);
            for (int w = 0; w < 2; ++w)
                CHECK(slice[k * 2 + w] == Approx(direct[w] * lamp[w]).epsilon(1e-3)); // moments are stored as floats
        }
    }
}

TEST_CASE("light pollution: the saved orders add up to the table", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    auto options = onlyGlow();
    options.saveLightPollution = true;
    const Run run(*context, lampScene().parse(), options);
    checkValues(run.model);
    const auto whole = run.model.readAll("light-pollution");
    std::vector<double> sum(whole.size(), 0.);
    int orders = 0;
    for (; run.has("light-pollution/order-" + std::to_string(orders)); ++orders) {
        const auto part = run.model.readAll("light-pollution/order-" + std::to_string(orders));
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += double(part[i]);
    }
    CHECK(orders == std::stoi(run.model.manifest().settings.at("light-pollution.events")) + 2); // 0, and one more than the field's
    for (std::size_t i = 0; i < sum.size(); ++i) {
        CHECK(sum[i] <= double(whole[i]) * (1 + 1e-5));
        CHECK(sum[i] >= double(whole[i]) * 0.99); // the rest closes the series
    }
}

TEST_CASE("light pollution: edge scenes", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    auto empty = lampScene(); // nothing scatters: the ground is dimmed, the sky is black
    const std::string keys = empty.species.substr(empty.species.find("light pollution"));
    empty.species = empty.absorber() + keys;
    const Run black(*context, empty.parse(), onlyGlow());
    checkValues(black.model);
    const model::GlowTable table(black.model);
    const auto slice = table.slice(0);
    for (int k = 0; k < table.views(); ++k)
        CHECK((slice[k * 4 + 1] > 0) == (k < table.views() / 2));
    auto fog = lampScene();
    fog.albedo = "1";
    fog.species = SceneText::rayleigh("altitude < 500.0 ? 2e28 : 1e22*exp(-altitude/(8.0*km))") + keys; // optical depth 100
    const Run bright(*context, fog.parse(), onlyGlow());
    checkValues(bright.model);
    auto odd = lampScene().parse();
    odd.lightPollutionSize = {2, 2};
    const Run smallest(*context, odd, onlyGlow());
    CHECK(model::GlowTable(smallest.model).views() == 4);
}
