// The table of eclipsed light: what stands in it, and when there is none.
#include "solver/eclipse_table.hpp"
#include "eclipse/field.hpp"
#include "model/evaluate.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "physics/table_axes.hpp"
#include "support.hpp"

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

SceneText scene()
{
    SceneText text;
    text.species = SceneText::rayleigh() + SceneText::dust();
    text.suns = "6";
    return text;
}

std::string skippedWhy(const SceneText& text, const std::string& moon = {}, const Options& options = draft())
{
    auto description = text.parse();
    if (moon == "far")
        description.moonDistance = 2 * description.sunDistance;
    if (moon == "near")
        description.moonDistance = description.planetRadius + 1e6;
    for (const auto& item : plan(description, options))
        if (item.what == "eclipsed")
            return item.why;
    return {};
}

/// A draft whose tables of eclipsed and of ordinary light are spectral and share their directions: three azimuths by four views, which is
/// what the eclipse's draft has, for two Suns.
struct Spectral {
    Options options = draft();
    SceneText text = scene();

    explicit Spectral(const std::string& altitudes)
    {
        options.parts = {Part::Moments, Part::Eclipsed, Part::Multiple};
        options.radiance = true;
        options.texturePrecisionBits = 24;
        text.views = "4";
        text.azimuths = "3";
        text.suns = "2";
        text.altitudes = altitudes;
    }
};

} // namespace

TEST_CASE("eclipse table: skipped with a reason where there is no eclipse, or no light of two orders")
{
    CHECK(skippedWhy(scene()).empty());
    CHECK_THAT(skippedWhy(scene(), "far"), Catch::Contains("expected less than the Sun's distance"));
    CHECK_THAT(skippedWhy(scene(), "near"), Catch::Contains("touches neither the air nor the camera"));
    auto single = scene();
    single.orders = "1";
    CHECK(skippedWhy(single) == "only one order of scattering was asked for");
    Options options = draft();
    options.parts.erase(Part::Eclipsed);
    CHECK(skippedWhy(scene(), {}, options) == "not asked for");
}

TEST_CASE("eclipse table: an odd number of views is rounded up, layers asked for alone cost less")
{
    auto description = scene().parse();
    description.eclipsedDoubleScatteringSize = {5, 7, 3, 2, 10};
    description.scatteringSize.altitude = 40;
    const auto size = eclipseTableSize(description);
    CHECK(size.viewZenithAngle == 8);
    CHECK(size.dotViewSun == 5);
    CHECK(size.sunZenithAngle == 3);
    CHECK(size.altitude == 40);
    CHECK(eclipseStates(description, draft()) == 12 * 3); // quotients at 12 altitudes serve 40
    Options options = draft();
    options.altitudeLayers = {0, 0};
    CHECK(eclipseStates(description, options) == 3); // the lowest alone
    description.eclipsedDoubleScatteringSize = {5, 7, 32, 2, 10};
    CHECK(eclipseStates(description, options) == 23); // by day every second Sun
}

TEST_CASE("eclipse table: the ordinary sky times the quotient of the eclipse's field", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const Spectral draft("3");
    const auto description = draft.text.parse();
    Run run(*context, description, draft.options);
    checkValues(run.model);
    REQUIRE(run.has("eclipsed-double-scattering"));
    const auto eclipsed = run.model.readAll("eclipsed-double-scattering"), ordinary = run.model.readAll("multiple-scattering");
    REQUIRE(eclipsed.size() == ordinary.size());
    int brighter = 0;
    for (std::size_t i = 0; i < eclipsed.size(); ++i)
        brighter += eclipsed[i] > 1.001f * ordinary[i]; // what rounding leaves where neither Sun nor Moon are seen
    CHECK(brighter == 0);

    // The zenith Sun at the ground: last of two Suns, first layer; all views and azimuths.
    const auto medium = model::readMedium(run.model);
    const physics::Profile profile(medium);
    const auto optics = model::readOptics(run.model, medium);
    const physics::SunTable sun(profile, optics, medium.sunAngularRadius);
    eclipse::FieldSettings settings; // finer than that of a draft: the bound is for its error
    const auto rays = eclipse::traceAir(medium, profile, optics, settings);
    physics::EclipseBodies bodies;
    bodies.planet = profile.planet();
    bodies.sunDistance = description.sunDistance;
    bodies.moonDistance = description.moonDistance;
    bodies.sunAngularRadius = medium.sunAngularRadius;
    eclipse::ScatteredField field(rays, sun, bodies, {description.scatteringOrders});
    while (!field.step()) {
    }
    const auto mu = physics::viewMuNodes(profile.planet(), 0, 4);
    const auto light = field.view({{0, mu[2], false}, {0, mu[3], false}}, physics::azimuthNodes(3));
    const std::size_t first = (1 * 4 + 2) * 3 * 2; // [layer 0][Sun 1][view 2][azimuth 0][wavelength 0]
    for (int i = 0; i < 2 * 3 * 2; ++i) {
        const float ratio = light.skyRatio(i / 6, i / 2 % 3, i % 2);
        CHECK(ratio < 0.03f);
        CHECK(eclipsed[first + std::size_t(i)] / ordinary[first + std::size_t(i)] == Approx(ratio).epsilon(0.15));
    }
}

TEST_CASE("eclipse table: between the ground and the first altitude that is solved, the air below the horizon is dark too", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    Spectral draft("24");
    draft.options.altitudeLayers = {1, 1}; // of 24: half-way, seen from the ground there is no such air
    Run run(*context, draft.text.parse(), draft.options);
    const auto eclipsed = run.model.readAll("eclipsed-double-scattering"), ordinary = run.model.readAll("multiple-scattering");
    REQUIRE(eclipsed.size() == ordinary.size());
    // The zenith Sun, [view][azimuth][wavelength], from nadir up.
    const std::size_t first = 1 * 4 * 3 * 2, half = 2 * 3 * 2;
    for (std::size_t i = 0; i < half; ++i) {
        INFO("texel " << i);
        CHECK(eclipsed[first + i] < 0.05f * ordinary[first + i]);
        CHECK(eclipsed[first + i] > 0);
    }
}

TEST_CASE("eclipse table: a run can be stopped while it is computed, and luminance is the same light", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    Options options = draft();
    options.parts = {Part::Eclipsed};
    model::test::Scratch scratch;
    Listener listener;
    listener.stopIn = "eclipses";
    CHECK_THROWS_AS(solve(scene().parse(), options, *context, scratch.path / "m", listener), Cancelled);
    CHECK_FALSE(std::filesystem::exists(scratch.path / "m"));

    Run run(*context, scene().parse(), options);
    CHECK(tableNames(run.model).count("moments") == 0); // the field is solved for it, and not kept
    CHECK_FALSE(run.listener.fell);
    checkValues(run.model);
    const auto texels = run.model.readAll("eclipsed-double-scattering");
    CHECK(*std::max_element(texels.begin(), texels.end()) > 1); // cd m^-2, a dusk overhead
}
