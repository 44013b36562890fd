// Interpolation of the 4D tables: nodes give what was written, logarithms go straight between them, the dark stays
// dark.
#include "model/scattering_table.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "physics/table_axes.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <functional>

using namespace sky;
using namespace sky::model;
using namespace sky::model::test;

namespace {

using sky::base::pi;
constexpr int suns = 5, views = 8, azimuths = 4;
const physics::Planet planet{6.371e6, 1.2e5}; // smallManifest's
const physics::SunTableAxis sunAxis = physics::sunTableAxis(0.4, 0.5);

Axis indices(const std::string& name, int count, const Mapping& mapping)
{
    Axis axis{name, "1", {}, mapping};
    for (int k = 0; k < count; ++k)
        axis.nodes.push_back(k);
    return axis;
}

TableSpec scatteringSpec(int layers)
{
    TableSpec spec;
    spec.name = "sky";
    spec.quantity = "radiance";
    spec.unit = "W m^-2 sr^-1 nm^-1";
    spec.axes = {{"altitude", "m", physics::altitudeNodes(planet, layers), {"horizon-distance", {}}},
                 indices("sunZenithAngle", suns, {"sun-from-horizon", {{"scale", sunAxis.scale}, {"vDark", sunAxis.vDark}}}),
                 indices("viewZenithAngle", views, {"horizon-halves", {{"scale", physics::horizonAngleScale}}}),
                 {"relativeAzimuth", "rad", physics::azimuthNodes(azimuths), {"uniform", {}}}};
    spec.rowAxes = 2;
    spec.channels = Channels::SpectralRadiance;
    spec.wavelengthsNm = smallManifest().wavelengthsNm;
    return spec;
}

using Value = std::function<double(int layer, int sun, int view, int azimuth, int channel)>;

Model written(const Scratch& scratch, const TableSpec& spec, const Value& value)
{
    std::vector<float> values;
    for (int layer = 0; layer < static_cast<int>(spec.axes[0].nodes.size()); ++layer)
        for (int sun = 0; sun < suns; ++sun)
            for (int view = 0; view < static_cast<int>(spec.axes[2].nodes.size()); ++view)
                for (int azimuth = 0; azimuth < static_cast<int>(spec.axes[3].nodes.size()); ++azimuth)
                    for (int c = 0; c < 4; ++c)
                        values.push_back(static_cast<float>(value(layer, sun, view, azimuth, c)));
    ModelWriter writer(scratch.path / "m");
    writer.table(spec, values);
    writer.commit(smallManifest());
    return Model::open(scratch.path / "m");
}

/// All different, over six decades.
double uneven(int layer, int sun, int view, int azimuth, int channel)
{
    return std::exp(1.7 * sun - 0.6 * layer + 0.3 * std::sin(7. * view + layer) + 0.1 * std::cos(2. * azimuth)) * (1 + 0.2 * channel);
}

std::vector<double> sampled(const ScatteringTable& table, double altitude, double sun, double view, double azimuth)
{
    std::vector<double> result(table.channels());
    table.sample(table.slice(altitude, sun), altitude, view, azimuth, result.data());
    return result;
}

} // namespace

TEST_CASE("scattering table: nodes of all four axes give what was written")
{
    const Scratch scratch;
    const int layers = 11; // more than are kept in memory
    const Model model = written(scratch, scatteringSpec(layers), uneven);
    const ScatteringTable table(model, "sky");
    CHECK(table.channels() == 4);
    CHECK(table.views() == views);
    CHECK(table.azimuths() == azimuths);
    const auto altitudes = physics::altitudeNodes(planet, layers);
    for (const int layer : {0, 10, 5, 4, 0, 7, 9, 1, 2, 3, 10}) { // to and fro: layers are dropped and read again
        const auto sunNodes = physics::sunElevationNodes(planet, altitudes[layer], sunAxis, suns);
        const auto muNodes = physics::viewMuNodes(planet, altitudes[layer], views);
        const double horizon = physics::horizonElevation(planet, altitudes[layer]);
        for (int sun = 0; sun < suns; ++sun) {
            const auto slice = table.slice(altitudes[layer],
                                           sunNodes[sun] + (sun == 0 ? 1e-12 : 0)); // not below the end by a rounding
            for (int view = 0; view < views; ++view)
                for (int azimuth = 0; azimuth < azimuths; ++azimuth)
                    for (int c = 0; c < 4; ++c) {
                        INFO("layer " << layer << " Sun " << sun << " view " << view << " azimuth " << azimuth << " channel " << c);
                        const double truth = uneven(layer, sun, view, azimuth, c);
                        // Float in, float out, and a place that is a node to within roundings.
                        CHECK(double(slice[(std::size_t(view) * azimuths + azimuth) * 4 + c]) == Approx(truth).epsilon(1e-6));
                        if (view == views / 2 - 1 || view == views / 2 || sun != 2)
                            continue; // the two on the horizon: below; other Suns: the same code
                        double result[4];
                        table.sample(slice, altitudes[layer], std::asin(muNodes[view]), pi * azimuth / (azimuths - 1), result);
                        CHECK(result[c] == Approx(truth).epsilon(1e-5));
                    }
            // The two sides of the horizon are told apart.
            double above[4], below[4];
            table.sample(slice, altitudes[layer], horizon, 0, above);
            table.sample(slice, altitudes[layer], horizon - 1e-9, 0, below);
            CHECK(above[0] == Approx(uneven(layer, sun, views / 2, 0, 0)).epsilon(1e-5));
            CHECK(below[0] == Approx(uneven(layer, sun, views / 2 - 1, 0, 0)).epsilon(1e-5));
        }
    }
}

TEST_CASE("scattering table: what is exponential over the nodes is exact between them")
{
    const Scratch scratch;
    const Model model = written(scratch, scatteringSpec(4), [](int layer, int sun, int view, int, int) {
        const int up = view < views / 2 ? views / 2 - 1 - view : view - views / 2; // steps from the horizon
        return std::exp(-0.9 * layer + 2.5 * sun - 0.7 * up);
    });
    const ScatteringTable table(model, "sky");
    const auto places = physics::altitudeNodes(planet, 31); // ten steps per layer, in the same measure
    for (const int step : {3, 15, 28})
        for (const double sunPlace : {0.2, 1.5, suns - 2.1}) // the last interval ends at the zenith: below
            for (const double viewPlace : {0.5, 1.7, 2.9}) {
                const double h = places[step], horizon = physics::horizonElevation(planet, h), range = pi / 2 - horizon;
                const double v = sunAxis.vDark + (1 - sunAxis.vDark) * sunPlace / (suns - 1);
                const double sun = horizon + range * std::sinh(sunAxis.scale * v) / std::sinh(sunAxis.scale);
                const double whole = std::asinh(range / physics::horizonAngleScale);
                const double view = horizon + physics::horizonAngleScale * std::sinh(whole * viewPlace / (views / 2 - 1));
                CHECK(sampled(table, h, sun, view, 0.3)[0] ==
                      Approx(std::exp(-0.9 * step / 10. + 2.5 * sunPlace - 0.7 * viewPlace)).epsilon(1e-5)); // floats
            }
}

TEST_CASE("scattering table: a Sun near the zenith is seen from both sides of it")
{
    const Scratch scratch;
    // On the way past the zenith azimuths turn round, so that this goes straight through it.
    const Model model = written(scratch, scatteringSpec(2), [](int, int sun, int, int azimuth, int) {
        return std::exp(0.7 * (suns - 1 - sun) * std::cos(pi * azimuth / (azimuths - 1)));
    });
    const ScatteringTable table(model, "sky");
    const double horizon = physics::horizonElevation(planet, 0), range = pi / 2 - horizon;
    for (const double fromZenith : {0., 0.1, 0.5, 0.8, 1.})
        for (int azimuth = 0; azimuth < azimuths; ++azimuth) {
            const double v = 1 - (1 - sunAxis.vDark) * fromZenith / (suns - 1), phi = pi * azimuth / (azimuths - 1);
            const double sun = horizon + range * std::sinh(sunAxis.scale * v) / std::sinh(sunAxis.scale);
            CHECK(sampled(table, 0, sun, 0.5, phi)[0] == Approx(std::exp(0.7 * fromZenith * std::cos(phi))).epsilon(1e-5)); // floats
        }
}

TEST_CASE("scattering table: azimuth goes round, the same on both sides of the Sun")
{
    const Scratch scratch;
    const Model model = written(scratch, scatteringSpec(2), uneven);
    const ScatteringTable table(model, "sky");
    for (const double phi : {0., 0.4, 2.9, pi}) {
        const double truth = sampled(table, 2e3, 0.3, 0.5, phi)[1];
        CHECK(sampled(table, 2e3, 0.3, 0.5, -phi)[1] == Approx(truth).epsilon(1e-12));
        CHECK(sampled(table, 2e3, 0.3, 0.5, phi + 6 * pi)[1] == Approx(truth).epsilon(1e-12));
    }
}

TEST_CASE("scattering table: below the dark end of the Sun it is dark, above the top as at the top")
{
    const Scratch scratch;
    const Model model = written(scratch, scatteringSpec(3), uneven);
    const ScatteringTable table(model, "sky");
    for (const double sun : {-0.45, -1., -pi / 2})
        for (const float value : table.slice(0, sun))
            CHECK(value == 0.F);
    CHECK(table.slice(0, pi / 2) == table.slice(0, 2.)); // no Sun stands higher
    CHECK(table.slice(-5, 0.2) == table.slice(0, 0.2));
}

TEST_CASE("scattering table: zeros among the nodes give neither NaN nor light from nowhere")
{
    const Scratch scratch;
    const Model model = written(scratch, scatteringSpec(3), [](int layer, int sun, int view, int azimuth, int c) {
        return sun < 2 || view == 6 ? 0. : uneven(layer, sun, view, azimuth, c);
    });
    const ScatteringTable table(model, "sky");
    for (double h : {0., 3e3, 5e4})
        for (double sun = -0.4; sun < 1.6; sun += 0.11)
            for (double view = -1.5; view < 1.6; view += 0.13)
                for (const double value : sampled(table, h, sun, view, 1)) {
                    CHECK(std::isfinite(value));
                    CHECK(value >= 0);
                    CHECK(value < 2 * std::exp(1.7 * 4) * 1.6);
                }
    const auto dark = physics::sunElevationNodes(planet, 0, sunAxis, suns);
    CHECK(sampled(table, 0, 0.5 * (dark[0] + dark[1]), 0.4, 1)[0] == 0);
}

TEST_CASE("scattering table: other tables are refused with a sentence")
{
    struct Change {
        const char* name;
        std::function<void(TableSpec&)> apply;
        const char* expected;
    };
    const std::vector<Change> changes{
        {"another mapping", [](TableSpec& s) { s.axes[1].mapping.id = "uniform"; }, "sun-from-horizon"},
        {"no parameter", [](TableSpec& s) { s.axes[1].mapping.parameters.erase("vDark"); }, "sun-from-horizon"},
        {"no scale", [](TableSpec& s) { s.axes[1].mapping.parameters["scale"] = 0; }, "with a scale of 0 to 100"},
        {"a scale beyond numbers", [](TableSpec& s) { s.axes[1].mapping.parameters["scale"] = 1e3; }, "with a scale of 0 to 100"},
        {"nothing but dark", [](TableSpec& s) { s.axes[1].mapping.parameters["vDark"] = 1; }, "sun-from-horizon"},
        {"an odd number of views", [](TableSpec& s) { s.axes[2].nodes.pop_back(); }, "viewZenithAngle (even, 4 or more)"},
        {"one azimuth", [](TableSpec& s) { s.axes[3].nodes.resize(1); }, "relativeAzimuth"},
        {"other rows", [](TableSpec& s) { s.rowAxes = 1; }, "expected the axes"},
    };
    for (const auto& change : changes) {
        const Scratch scratch;
        TableSpec spec = scatteringSpec(2);
        change.apply(spec);
        const Model model = written(scratch, spec, uneven);
        INFO(change.name);
        try {
            const ScatteringTable table(model, "sky");
            FAIL_CHECK("was accepted");
        } catch (const ModelError& error) {
            CHECK_THAT(error.what(), Catch::Contains("table \"sky\"") && Catch::Contains(change.expected));
        }
    }
    const Scratch scratch;
    const Model model = written(scratch, scatteringSpec(2), uneven);
    CHECK_THROWS_AS(ScatteringTable(model, "clouds"), ModelError);
}
