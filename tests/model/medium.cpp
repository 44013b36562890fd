#include "base/error.hpp"
#include "model/medium_tables.hpp"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <numbers>

using namespace sky;
using namespace sky::model;
using namespace sky::model::test;
using physics::Medium;
using physics::Species;

namespace {

Medium hazyAir()
{
    Medium m;
    m.planetRadius = 6371e3;
    m.topOfAtmosphere = 120e3;
    m.sunAngularRadius = 0.00465;
    m.wavelengthsNm = {380.5, 500, 700 + 1. / 3};
    m.solarIrradiance = {1, 2, 1.5};
    m.groundAlbedo = {0, 0.5, 1};
    // A jump is two nodes so close that float could not tell them apart.
    m.altitudes = {0, 1 / 3., 1000, 1000 + 1e-6, 80e3 + 1e-7, 120e3};
    m.scatteringAngles = {0, 1e-4, 0.1, 2, std::numbers::pi};
    m.species = {{"molecules", {2.5e25, 1e25, 1e24, 1e24, 1e10, 0}, {2e-30, 6e-31, 2e-31}, {1, 1, 1}, {}, true, false},
                 {"ozone", {0, 0, 1e18, 3e18, 0, 0}, {1e-27, 2e-25, 3e-25}, {0, 0, 0}, {}, false, false},
                 {"haze", {1e9, 1e8, 0, 5e7, 0, 0}, {1e-14, 2e-14, 3e-14}, {0.9, 0.95, 1}, {}, false, true}};
    for (const int i : {0, 2})
        for (std::size_t k = 0; k < 5 * 3; ++k)
            m.species[static_cast<std::size_t>(i)].phaseFunction.push_back(1 / (1.3 + i + static_cast<double>(k)));
    return m;
}

Medium throughAModel(const Medium& medium)
{
    const Scratch scratch;
    Manifest manifest = smallManifest();
    describeMedium(manifest, medium);
    ModelWriter writer(scratch.path / "m");
    writeMedium(writer, medium);
    writer.commit(manifest);
    return readMedium(Model::open(scratch.path / "m"));
}

} // namespace

TEST_CASE("a medium comes back: nodes and spectra exactly, tables to float")
{
    const Medium before = hazyAir(), after = throughAModel(before);
    CHECK(after.planetRadius == before.planetRadius);
    CHECK(after.topOfAtmosphere == before.topOfAtmosphere);
    CHECK(after.sunAngularRadius == before.sunAngularRadius);
    CHECK(after.wavelengthsNm == before.wavelengthsNm);
    CHECK(after.solarIrradiance == before.solarIrradiance);
    CHECK(after.groundAlbedo == before.groundAlbedo);
    CHECK(after.altitudes == before.altitudes);
    CHECK(after.scatteringAngles == before.scatteringAngles);
    REQUIRE(after.species.size() == before.species.size());
    for (std::size_t i = 0; i < after.species.size(); ++i) {
        const Species &a = after.species[i], &b = before.species[i];
        CHECK(a.name == b.name);
        CHECK(a.extinctionCrossSection == b.extinctionCrossSection);
        CHECK(a.singleScatteringAlbedo == b.singleScatteringAlbedo);
        CHECK(a.achromatic == b.achromatic);
        CHECK(a.smooth == b.smooth);
        CHECK(a.scatters() == b.scatters());
        REQUIRE(a.numberDensity.size() == b.numberDensity.size());
        for (std::size_t k = 0; k < a.numberDensity.size(); ++k)
            CHECK(std::abs(a.numberDensity[k] - b.numberDensity[k]) <= std::ldexp(b.numberDensity[k], -24));
        REQUIRE(a.phaseFunction.size() == b.phaseFunction.size());
        for (std::size_t k = 0; k < a.phaseFunction.size(); ++k)
            CHECK(std::abs(a.phaseFunction[k] - b.phaseFunction[k]) <= std::ldexp(b.phaseFunction[k], -24));
    }
}

TEST_CASE("a vacuum is a medium, air that only absorbs as well")
{
    Medium medium = hazyAir();
    medium.species = {medium.species[1]};
    medium.scatteringAngles.clear();
    CHECK(throughAModel(medium).species.size() == 1);
    medium.species.clear();
    CHECK(throughAModel(medium).altitudes == std::vector<double>{0, 120e3});
}

TEST_CASE("a model without its medium says so")
{
    const Scratch scratch;
    writeSmallModel(scratch.path / "m");
    CHECK_THROWS_WITH(readMedium(Model::open(scratch.path / "m")), Catch::Contains("has no table 'medium'"));
}
