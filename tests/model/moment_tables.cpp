// The radiance moments in a model: what is written is read; what are no moments is refused with a sentence.
#include "model/moment_tables.hpp"
#include "base/error.hpp"
#include "physics/harmonics.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <functional>

using namespace sky;
using namespace sky::model;
using namespace sky::model::test;

namespace {

physics::Moments someMoments(int degree)
{
    physics::Moments m;
    m.grid = physics::MomentGrid({6.371e6, 1.2e5}, {0, 11.5, 3e3, 1.2e5}, -0.45, 6);
    m.degree = degree;
    m.wavelengths = 4;
    const int count = physics::harmonicCount(degree);
    for (int a = 0; a < 4; ++a)
        for (int j = 0; j < 6; ++j)
            for (int lm = 0; lm < count; ++lm)
                for (int w = 0; w < 4; ++w) // logarithms down to darkness, ratios of either sign
                    m.values.push_back(lm == 0 ? -69 * std::exp(-j) - 0.1 * w - a : std::sin(lm + 10. * j + 100. * a + w));
    for (int i = 0; i < 24; ++i)
        m.groundIrradiance.push_back(std::exp(-i));
    return m;
}

/// A model that holds `moments`; `change` may spoil its manifest.
Model written(const Scratch& scratch, const physics::Moments& moments, const std::function<void(Manifest&)>& change = {})
{
    ModelWriter writer(scratch.path / "m");
    writeMoments(writer, "moments", moments);
    Manifest manifest = smallManifest();
    if (change)
        change(manifest);
    writer.commit(manifest);
    return Model::open(scratch.path / "m");
}

std::string complaint(const Model& model)
{
    try {
        readMoments(model);
    } catch (const ModelError& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("moments in a model: written and read they are the same to within a float")
{
    for (const int degree : {0, 2, 5}) {
        const Scratch scratch;
        const auto before = someMoments(degree);
        const auto after = readMoments(written(scratch, before));
        CHECK(after.degree == degree);
        CHECK(after.wavelengths == 4);
        CHECK(after.grid.altitudes() == before.grid.altitudes());                                    // nodes stand in the manifest, in full
        CHECK(after.grid.lowestElevation() == Approx(before.grid.lowestElevation()).epsilon(1e-12)); // there and back through sinh
        REQUIRE(after.values.size() == before.values.size());
        for (std::size_t i = 0; i < before.values.size(); ++i)
            CHECK(after.values[i] == Approx(before.values[i]).margin(1.6e-5)); // half of the step that files keep
        REQUIRE(after.groundIrradiance.size() == before.groundIrradiance.size());
        for (std::size_t i = 0; i < before.groundIrradiance.size(); ++i)
            CHECK(after.groundIrradiance[i] == double(float(before.groundIrradiance[i])));
    }
}

TEST_CASE("moments in a model: tables that are none are refused with a sentence")
{
    {
        const Scratch scratch;
        CHECK_THAT(complaint(written(scratch, someMoments(2), [](Manifest& m) { m.topOfAtmosphere = 1e5; })),
                   Catch::Contains("table \"moments\"") && Catch::Contains("from 0 to the top of the atmosphere"));
    }
    {
        const Scratch scratch;
        auto fewer = someMoments(2);
        fewer.wavelengths = 2;
        fewer.values.resize(fewer.values.size() / 2);
        fewer.groundIrradiance.resize(12);
        CHECK_THAT(complaint(written(scratch, fewer)), Catch::Contains("a channel per wavelength"));
    }
    {
        const Scratch scratch;
        writeSmallModel(scratch.path / "m");
        CHECK_THAT(complaint(Model::open(scratch.path / "m")), Catch::Contains("moments"));
    }
    struct Change {
        const char* name;
        std::function<void(TableSpec&)> apply;
        const char* expected;
    };
    const std::vector<Change> changes{
        {"five harmonics", [](TableSpec& s) { s.axes[1].nodes.pop_back(); }, "has 5 harmonics; expected 1, 3, 6, 10"},
        {"not from the ground", [](TableSpec& s) { s.axes[0].nodes[0] = 1; }, "must reach from 0"},
        {"levels fall", [](TableSpec& s) { std::swap(s.axes[0].nodes[1], s.axes[0].nodes[2]); }, "must increase"},
        {"no night", [](TableSpec& s) { s.axes[2].nodes[0] = 0.1; }, "must stand between -90 degrees and the horizontal"},
        {"other Suns", [](TableSpec& s) { s.axes[2].nodes[3] += 1e-3; }, "don't follow the mapping"},
        {"one Sun", [](TableSpec& s) { s.axes[2].nodes.resize(1); }, "two Suns or more"},
        {"other rows", [](TableSpec& s) { s.rowAxes = 1; }, "expected the axes"},
    };
    for (const auto& change : changes) {
        const Scratch scratch, spoilt;
        const Model good = written(scratch, someMoments(2));
        ModelWriter writer(spoilt.path / "m");
        TableSpec spec = good.table("moments");
        change.apply(spec);
        writer.table(spec, std::vector<float>(std::size_t(spec.rows()) * spec.columns() * 4, 0.5F));
        writer.table(good.table("moments-ground-irradiance"), good.readAll("moments-ground-irradiance"));
        writer.commit(smallManifest());
        INFO(change.name);
        CHECK_THAT(complaint(Model::open(spoilt.path / "m")), Catch::Contains("table \"moments\"") && Catch::Contains(change.expected));
    }
}

TEST_CASE("moments in a model: the optics that go with them are rebuilt, or their absence named")
{
    physics::Medium medium;
    medium.wavelengthsNm = {500};
    medium.altitudes = {0, 1000};
    const auto optics = physics::makeOptics(medium, 7, true);
    for (const char* degree : {"", "-1", "65", "7.5", "1000000000000", "seven"}) {
        const Scratch scratch;
        const Model model = written(scratch, someMoments(0), [&](Manifest& m) {
            describeOptics(m, optics, true);
            m.settings["moments.degree"] = degree;
        });
        INFO(degree);
        CHECK_THROWS_AS(readOptics(model, medium), ModelError);
    }
    medium.species.push_back({"drops", {1, 1}, {1e-3}, {1}, {}, true, false});
    for (int i = 0; i <= 200; ++i) {
        const double g = 0.95, angle = i * 3.14159265358979323846 / 200;
        medium.scatteringAngles.push_back(angle);
        medium.species[0].phaseFunction.push_back((1 - g * g) /
                                                  (4 * 3.14159265358979323846 * std::pow(1 + g * g - 2 * g * std::cos(angle), 1.5)));
    }
    const auto sharp = physics::makeOptics(medium, 7, true);
    REQUIRE(physics::truncates(sharp));
    for (const char* shares : {"", "0", "0.1", "much"}) {
        const Scratch other;
        const Model model = written(other, someMoments(0), [&](Manifest& m) {
            describeOptics(m, sharp, true);
            m.settings["moments.truncated"] = shares;
        });
        INFO(shares);
        CHECK_THROWS_WITH(readOptics(model, medium), Catch::Contains("compute the model anew"));
    }
    const Scratch same;
    CHECK(readOptics(written(same, someMoments(0), [&](Manifest& m) { describeOptics(m, sharp, true); }), medium).truncation ==
          sharp.truncation);
    medium.species.clear();
    const Scratch bare, whole;
    CHECK_THROWS_AS(readOptics(written(bare, someMoments(0)), medium), ModelError);
    CHECK(readOptics(written(whole, someMoments(0), [&](Manifest& m) { describeOptics(m, optics, true); }), medium).degree == 7);
}
