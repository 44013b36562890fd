// Baked tables against the CPU's own quadrature of the same moments, against each other, and wavelength by wavelength.
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "model/scattering_table.hpp"
#include "physics/colour.hpp"
#include "physics/harmonics.hpp"
#include "physics/sky.hpp"
#include "physics/table_axes.hpp"
#include "solver/quality.hpp"
#include "support.hpp"
#include <algorithm>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;

namespace {

physics::SunTableAxis sunAxisOf(const model::TableSpec& table)
{
    const auto& parameters = table.axes[1].mapping.parameters;
    return {parameters.at("scale"), parameters.at("vDark")};
}

SceneText blueAir()
{
    SceneText scene;
    scene.species = "Scatterer \"air\":\n{\n  number density:\n  ```\n  return 3.08458e25*exp(-altitude/(8.0*km));\n  ```\n"
                    "  phase function:\n  ```\n  return vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)));\n  ```\n"
                    "  phase function type: smooth\n  cross section at 1 um: 0.04022 fm^2\n  angstrom exponent: 4\n}\n" +
                    SceneText::dust();
    return scene;
}

Options exact()
{
    Options options = draft();
    options.radiance = true;
    options.texturePrecisionBits = 24;
    return options;
}

/// The model's sky on the CPU in double precision, along rays that are told whether they meet the ground.
struct Twin {
    physics::Medium medium;
    physics::Profile profile;
    physics::Optics optics;
    physics::SunTable sun;
    physics::Moments moments;
    physics::SkyEvaluator sky;
    physics::RayTracer tracer;
    explicit Twin(const model::Model& model)
        : medium(model::readMedium(model)), profile(medium), optics(model::readOptics(model, medium)),
          sun(profile, optics, medium.sunAngularRadius), moments(model::readMoments(model)), sky(medium, profile, optics, sun),
          tracer(profile, optics)
    {
    }
    Twin(const Twin&) = delete;
};

/// Largest deviation of a texel, relative to its own value plus a floor.
struct Worst {
    double deviation = 0;
    std::string place;
    void see(double value, double truth, double floor, const std::string& where)
    {
        const double d = std::abs(value - truth) / (std::abs(truth) + floor);
        if (!(d <= deviation)) {
            deviation = d;
            place = where;
        }
    }
};

/// How far baked texels are from the twin with so many nodes along rays, for Suns down to `lowestSunDeg` below the
/// horizon.
struct Deviation {
    Worst single, multiple;
    Deviation(const Run& run, int singleNodes, int multipleNodes, double lowestSunDeg, double floorShare)
    {
        Twin twin(run.model);
        const auto& table = run.model.table("multiple-scattering");
        const auto& planet = twin.profile.planet();
        const int suns = static_cast<int>(table.axes[1].nodes.size()), views = static_cast<int>(table.axes[2].nodes.size());
        const auto azimuths = table.axes[3].nodes;
        const auto sunAxis = sunAxisOf(table);
        const auto air = run.model.readAll("single-scattering/air"), dust = run.model.readAll("single-scattering/dust");
        const auto texels = run.model.readAll("multiple-scattering");
        const double floor = floorShare * double(*std::max_element(texels.begin(), texels.end()));
        const int wavelengths = twin.optics.wavelengths;
        std::size_t at = 0;
        std::vector<double> one(wavelengths), more(wavelengths), phase(wavelengths);
        for (const double h : table.axes[0].nodes) {
            const auto mus = physics::viewMuNodes(planet, h, views);
            for (const double e : physics::sunElevationNodes(planet, h, sunAxis, suns))
                for (int view = 0; view < views; ++view) {
                    const auto direct = twin.tracer.trace(h, mus[view], singleNodes, view < views / 2);
                    const auto scattered = twin.tracer.trace(h, mus[view], multipleNodes, view < views / 2, physics::NodesFor::Field);
                    for (const double phi : azimuths) {
                        const double mu = mus[view], muSun = std::sin(e);
                        const double nu = std::clamp(mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(phi), -1., 1.);
                        std::fill(one.begin(), one.end(), 0.);
                        std::fill(more.begin(), more.end(), 0.);
                        twin.sky.singleAlong(direct, muSun, nu, true, one.data());
                        twin.sky.multipleAlong(scattered, twin.moments, muSun, nu, more.data());
                        physics::phaseFunctionAt(twin.medium, twin.medium.species[1], std::acos(nu), phase.data());
                        for (int w = 0; w < wavelengths; ++w, ++at) {
                            if (e - physics::horizonElevation(planet, h) < lowestSunDeg * 3.14159265358979323846 / 180)
                                continue;
                            const double light = twin.medium.solarIrradiance[w];
                            const auto where = "h " + std::to_string(h) + " Sun " + std::to_string(e) + " view " + std::to_string(view) +
                                               " phi " + std::to_string(phi) + " w " + std::to_string(w);
                            single.see(double(air[at]) + double(dust[at]) * phase[w], one[w] * light, floor, where);
                            multiple.see(double(texels[at]), more[w] * light, floor, where);
                        }
                    }
                }
        }
        REQUIRE(at == texels.size());
    }
};

/// Compares all tables that have a channel per wavelength, channel `w` of one with `stride` w of the other.
void compareWavelengths(const Run& few, const Run& many, int stride, double bound)
{
    const int n = few.model.manifest().wavelengthCount(), all = many.model.manifest().wavelengthCount();
    int compared = 0;
    for (const auto& table : few.model.tables()) {
        if (table.channelCount() != n || table.name == "medium")
            continue;
        const auto a = few.model.readAll(table.name), b = many.model.readAll(table.name);
        REQUIRE(a.size() / n == b.size() / all);
        const bool logarithms = table.isSigned; // moments: ratios, and logarithms down to -69
        const double floor = logarithms ? 1 : 0.02 * double(*std::max_element(b.begin(), b.end()));
        Worst worst;
        for (std::size_t i = 0; i < a.size(); ++i)
            worst.see(double(a[i]), double(b[i / n * all + i % n * stride]), floor, std::to_string(i));
        INFO(table.name << " at " << worst.place);
        CHECK(worst.deviation < bound);
        ++compared;
    }
    CHECK(compared >= 8);
}

} // namespace

TEST_CASE("baked tables: a texel is the CPU's quadrature of the same nodes, and near that of many", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene = blueAir();
    scene.views = "8";
    scene.azimuths = "3";
    scene.suns = "7";
    scene.altitudes = "3";
    Options options = exact();
    options.quality = "normal";
    const Run run(*context, scene.parse(), options);
    const auto nodes = qualityFor("normal", model::readMedium(run.model), 0).bake;
    const Deviation same(run, nodes.directNodesFor(7), nodes.nodes, -4, 1e-6);
    INFO("single at " << same.single.place << ", multiple at " << same.multiple.place);
    CHECK(same.single.deviation < 2e-3);   // sunlight in float32 near the horizon
    CHECK(same.multiple.deviation < 2e-2); // moments of a finer axis, linearly, where the twin is cubic
    const Deviation many(run, 300, 60, -4, 0.02);
    INFO("many nodes: single at " << many.single.place << ", multiple at " << many.multiple.place);
    CHECK(many.single.deviation < 0.1); // the horizon seen from the top of the air: the longest rays, the thinnest shadow
    CHECK(many.multiple.deviation < 5e-2);
}

TEST_CASE("baked tables: read at a node they give the node", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene = blueAir();
    scene.altitudes = "3";
    scene.suns = "5";
    Options options = exact();
    options.parts = {Part::Multiple};
    const Run run(*context, scene.parse(), options);
    const auto& spec = run.model.table("multiple-scattering");
    const model::ScatteringTable table(run.model, spec.name);
    const physics::Planet planet{run.model.manifest().planetRadius, run.model.manifest().topOfAtmosphere};
    const auto values = run.model.readAll(spec.name);
    const std::size_t columns = std::size_t(spec.columns()) * spec.channelCount();
    const float brightest = *std::max_element(values.begin(), values.end());
    for (int layer = 0; layer < 3; ++layer) {
        const double h = spec.axes[0].nodes[layer];
        const auto suns = physics::sunElevationNodes(planet, h, sunAxisOf(spec), 5);
        for (int sun = 1; sun < 5; ++sun) {
            const auto slice = table.slice(h, suns[sun]);
            for (std::size_t c = 0; c < columns; ++c)
                CHECK(double(slice[c]) ==
                      Approx(double(values[(std::size_t(layer) * 5 + sun) * columns + c])).epsilon(1e-5).margin(1e-12 * double(brightest)));
        }
    }
}

TEST_CASE("baked tables: luminance is the spectrum weighed by the eye, of 20 wavelengths in two batches", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene = blueAir();
    scene.wavelengths = 20;
    Options options = exact();
    options.parts = {Part::Single, Part::Multiple};
    const Run spectral(*context, scene.parse(), options);
    options.radiance = false;
    const Run luminance(*context, scene.parse(), options);
    const auto weights = physics::luminanceWeights(spectral.model.manifest().wavelengthsNm);
    for (const char* name : {"single-scattering/air", "multiple-scattering"}) {
        CHECK(luminance.model.table(name).channels == model::Channels::Luminance);
        CHECK(spectral.model.table(name).channels == model::Channels::SpectralRadiance);
        const auto xyzw = luminance.model.readAll(name), spectra = spectral.model.readAll(name);
        REQUIRE(xyzw.size() / 4 == spectra.size() / 20);
        const double brightest = double(*std::max_element(xyzw.begin(), xyzw.end()));
        for (std::size_t texel = 0; texel < xyzw.size() / 4; ++texel)
            for (int c = 0; c < 4; ++c) {
                double sum = 0;
                for (int w = 0; w < 20; ++w)
                    sum += double(spectra[texel * 20 + w]) * weights[w][c];
                CHECK(double(xyzw[texel * 4 + c]) ==
                      Approx(sum).epsilon(5e-3).margin(1e-11 * brightest)); // log Y and ratios to Y are interpolated, not what is summed
            }
    }
}

TEST_CASE("baked tables: wavelengths don't know of each other, be they many or few", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene = blueAir();
    // The shortest wavelength is in all: the levels follow the largest extinction. The nodes along rays follow the mean
    // of the wavelengths, so that what is left is their error of quadrature, with the few nodes of a draft.
    const auto with = [&](int count, double maxNm) {
        scene.wavelengths = count;
        scene.maxNm = maxNm;
        return scene.parse();
    };
    {
        const Run twenty(*context, with(20, 780), exact()), ten(*context, with(10, 760), exact()); // 20 nm steps, 40 nm steps
        compareWavelengths(ten, twenty, 2, 0.04);
    }
    const Run five(*context, with(5, 700), exact()), three(*context, with(3, 700), exact()), one(*context, with(1, 400), exact());
    compareWavelengths(three, five, 2, 0.04);
    compareWavelengths(one, five, 1, 0.04);
}

TEST_CASE("baked tables: types of phase functions differ in how single scattering is stored, not in what it is", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const char* density = "5e23*exp(-altitude/(8.0*km))";
    const char* phase = "vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)))";
    SceneText scene;
    scene.wavelengths = 3;
    scene.species.clear();
    for (const char* type : {"general", "achromatic", "smooth"})
        scene.species += SceneText::scatterer(type, density, phase, type, "10 fm^2");
    Options options = draft();
    options.texturePrecisionBits = 24;
    options.parts = {Part::Single};
    const Run run(*context, scene.parse(), options);
    CHECK(run.model.table("single-scattering/general").channels == model::Channels::SpectralRadiance);
    CHECK(run.model.table("single-scattering/achromatic").channels == model::Channels::Luminance);
    CHECK(run.model.table("single-scattering/smooth").channels == model::Channels::Luminance);
    const auto general = run.model.readAll("single-scattering/general"), achromatic = run.model.readAll("single-scattering/achromatic"),
               smooth = run.model.readAll("single-scattering/smooth");
    const auto weights = physics::luminanceWeights(run.model.manifest().wavelengthsNm);
    const auto& spec = run.model.table("single-scattering/smooth");
    const physics::Planet planet{run.model.manifest().planetRadius, run.model.manifest().topOfAtmosphere};
    const double brightest = double(*std::max_element(smooth.begin(), smooth.end()));
    CHECK(brightest > 0);
    std::size_t texel = 0;
    for (const double h : spec.axes[0].nodes)
        for (const double e : physics::sunElevationNodes(planet, h, sunAxisOf(spec), 4))
            for (const double mu : physics::viewMuNodes(planet, h, 4))
                for (const double phi : spec.axes[3].nodes) {
                    const double nu = mu * std::sin(e) + std::sqrt(1 - mu * mu) * std::cos(e) * std::cos(phi);
                    const double p = 3 / (16 * 3.14159265358979323846) * (1 + nu * nu);
                    for (int c = 0; c < 4; ++c) {
                        double sum = 0;
                        for (int w = 0; w < 3; ++w)
                            sum += double(general[texel * 3 + w]) * weights[w][c];
                        CHECK(double(achromatic[texel * 4 + c]) == Approx(sum).epsilon(1e-5).margin(1e-12 * brightest));
                        CHECK(double(smooth[texel * 4 + c]) ==
                              Approx(sum * p).epsilon(2e-4).margin(1e-12 * brightest)); // phase from its table
                    }
                    ++texel;
                }
    REQUIRE(texel * 4 == smooth.size());
}
