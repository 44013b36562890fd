// What a run says before it begins: what it skips and why, and how much it will take.
#include "solver/plan.hpp"
#include "solver/layered_light.hpp"
#include "solver/medium_tables.hpp"
#include "support.hpp"

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;
namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> skippedOf(const std::vector<PlanItem>& items)
{
    std::map<std::string, std::string> reasons;
    for (const auto& item : items)
        if (!item.computed)
            reasons[item.what] = item.why;
    return reasons;
}

bool computes(const std::vector<PlanItem>& items, const std::string& what)
{
    for (const auto& item : items)
        if (item.what == what)
            return item.computed;
    return false;
}

} // namespace

TEST_CASE("plan: what is not asked for, and what the scene doesn't need, is skipped with its reason")
{
    SceneText scene;
    Options options = draft();
    options.parts = {Part::Transmittance, Part::Multiple};
    auto skipped = skippedOf(plan(scene.parse(), options));
    CHECK(skipped.at("moments") == "not asked for");
    CHECK(skipped.at("single") == "not asked for");
    CHECK(skipped.count("multiple") == 0);

    scene.orders = "1";
    skipped = skippedOf(plan(scene.parse(), draft()));
    CHECK(skipped.at("multiple") == "only one order of scattering was asked for");
    CHECK(skipped.at("moments") == "a single order needs no moments");

    scene.orders = "all";
    CHECK(skippedOf(plan(scene.parse(), draft())).count("multiple") == 0);

    auto night = scene.parse();
    night.solarIrradiance = {0, 0};
    CHECK(skippedOf(plan(night, draft())).at("irradiance") == "the Sun gives no light");

    scene.species = scene.absorber();
    skipped = skippedOf(plan(scene.parse(), draft()));
    for (const char* part : {"moments", "single", "multiple"})
        CHECK(skipped.at(part) == "nothing in this atmosphere scatters");
    CHECK(skipped.count("irradiance") == 0);
    CHECK(skipped.count("transmittance") == 0);
}

TEST_CASE("plan: no table is planned for scatterers that scatter nothing")
{
    SceneText scene;
    scene.species = SceneText::rayleigh() + SceneText::dust("general", "single scattering albedo: 0, 0") +
                    SceneText::scatterer("ghost", "1e20", "vec4(1.0/(4.0*PI))", "smooth", "0 um^2");
    const auto items = plan(scene.parse(), draft());
    CHECK(computes(items, "single-scattering/air"));
    CHECK(skippedOf(items).at("single-scattering/dust") == "it scatters no light");
    CHECK(skippedOf(items).at("single-scattering/ghost") == "it scatters no light");
}

TEST_CASE("plan: a table of single scattering says what it will hold")
{
    SceneText scene;
    scene.species = SceneText::rayleigh() + SceneText::dust();
    Options options = draft();
    std::map<std::string, std::string> forms;
    for (const auto& item : plan(scene.parse(), options))
        forms[item.what] = item.why;
    CHECK(forms.at("single-scattering/air") == "as XYZ and scotopic luminance");
    CHECK(forms.at("single-scattering/dust") == "as spectral radiance");
    options.radiance = true;
    for (const auto& item : plan(scene.parse(), options))
        forms[item.what] = item.why;
    CHECK(forms.at("single-scattering/air") == "as spectral radiance");
}

TEST_CASE("plan: more work takes more of everything")
{
    const auto totals = [](const SceneText& scene, const Options& options) {
        PlanItem sum;
        for (const auto& item : plan(scene.parse(), options)) {
            sum.memoryBytes += item.memoryBytes;
            sum.diskBytes += item.diskBytes;
            sum.seconds += item.seconds;
        }
        return sum;
    };
    SceneText scene;
    scene.views = "64";
    scene.suns = scene.altitudes = "16";
    Options options = draft();
    const auto small = totals(scene, options);
    options.altitudeLayers = {3, 4};
    const auto layers = totals(scene, options);
    CHECK(layers.diskBytes < small.diskBytes);
    CHECK(layers.seconds < small.seconds);
    options = draft();
    options.quality = "reference";
    CHECK(totals(scene, options).seconds > small.seconds);
    options = draft();
    options.texturePrecisionBits = 24;
    CHECK(totals(scene, options).diskBytes > small.diskBytes);
    options = draft();
    options.saveAccumulatedScattering = true;
    CHECK(workOf(scene.parse(), options, needsOf(scene.parse(), options)).total() >
          workOf(scene.parse(), draft(), needsOf(scene.parse(), draft())).total());
}

TEST_CASE("plan: what the air asks for is known once its blocks have run", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const auto momentsOf = [&](const SceneText& scene, Options options = draft()) {
        std::vector<std::string> warnings;
        const auto medium = evaluateMedium(scene.parse(), context->api(), warnings);
        for (const auto& item : plan(scene.parse(), options, &medium))
            if (item.what == "moments")
                return item;
        return PlanItem{};
    };
    SceneText clear, cloud;
    clear.orders = cloud.orders = "all";
    const std::string henyeyGreenstein = "vec4((1.0-0.64)/(4.0*PI)*pow(1.64-1.6*dotViewSun,-1.5))";
    cloud.species +=
        SceneText::scatterer("cloud", "altitude < 2.0*km && altitude > 1.0*km ? 1e8 : 0.0", henyeyGreenstein, "smooth", "100 um^2");
    const auto thin = momentsOf(clear), thick = momentsOf(cloud);
    CHECK(thick.memoryBytes > thin.memoryBytes);
    CHECK(thick.diskBytes > 5 * thin.diskBytes);
    CHECK(thick.seconds > 2 * thin.seconds);
    SceneText few = cloud;
    few.orders = "2"; // nothing to keep or to invert for later ones
    CHECK(momentsOf(few).memoryBytes < thick.memoryBytes);
    CHECK(LayeredLight::bytes(46, 3, 0) == 3 * 47. * 47 * 8); // a value a level, and the ground's
    CHECK(LayeredLight::bytes(46, 1, 14) == 139. * 139 * 8);  // three harmonics at most
    Options options = draft();
    options.maxMemoryBytes = 1;
    CHECK(momentsOf(cloud, options).memoryBytes < thick.memoryBytes);
}

TEST_CASE("plan: the size on disk is estimated to within a factor of three", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    scene.wavelengths = 4;
    scene.views = "32";
    scene.azimuths = "4";
    scene.suns = "16";
    scene.altitudes = "8";
    scene.species += SceneText::dust();
    const Run run(*context, scene.parse());
    std::uintmax_t planned = 0, written = 0, plannedTables = 0, writtenTables = 0;
    for (const auto& item : plan(scene.parse(), draft())) {
        planned += item.diskBytes;
        if (item.what.find("scattering") != std::string::npos) {
            CHECK(computes(plan(scene.parse(), draft()), item.what) == run.has(item.what));
            plannedTables += item.diskBytes;
        }
    }
    for (const auto& entry : fs::recursive_directory_iterator(run.model.directory())) {
        written += entry.is_regular_file() ? fs::file_size(entry.path()) : 0;
        if (entry.path().string().find("scattering") != std::string::npos && entry.is_regular_file())
            writtenTables += fs::file_size(entry.path());
    }
    INFO("planned " << planned << " written " << written << "; 4D tables planned " << plannedTables << " written " << writtenTables);
    CHECK(double(planned) / double(written) < 3);
    CHECK(double(planned) / double(written) > 1 / 3.);
    CHECK(double(plannedTables) / double(writtenTables) < 3);
    CHECK(double(plannedTables) / double(writtenTables) > 1 / 3.);
}
