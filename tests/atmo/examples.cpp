// The example descriptions run as they are, and their canonical text means the same.
#include <catch2/catch.hpp>

#include "atmo/parse.hpp"
#include "atmo/write.hpp"

#include <cmath>
#include <filesystem>
#include <numeric>

using namespace sky::atmo;

namespace {

const std::filesystem::path examples = std::filesystem::path(SKY_SOURCE_DIR) / "examples";

Description example(const std::string& name) { return parseFile(examples / (name + ".atmo")); }

double sum(const Spectrum& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

} // namespace

TEST_CASE("examples: all parse, and their canonical text reads back to the same")
{
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(examples)) {
        if (entry.path().extension() != ".atmo")
            continue;
        ++count;
        INFO(entry.path());
        const Description description = parseFile(entry.path());
        const std::string text = write(description);
        const Description again = parse(text, "canonical.atmo", {});
        CHECK(again == description);
        CHECK(write(again) == text);
    }
    CHECK(count >= 8);
}

TEST_CASE("examples: earth.atmo has the figures of the sample Earth")
{
    const Description earth = example("earth");
    CHECK(earth.planetRadius == 6371e3);
    CHECK(earth.atmosphereHeight == 120e3);
    CHECK(earth.sunDistance == Approx(1.01208 * 149597870700.0));
    CHECK(earth.moonDistance == 371925e3);
    CHECK(earth.moonRadius == 1737.4e3);
    CHECK(earth.scatteringOrders == 4);
    CHECK_FALSE(earth.allScatteringOrders);
    CHECK(earth.scatteringSize == SizeScattering{128, 16, 128, 64});
    CHECK(earth.wavelengths == Wavelengths{360, 830, 16});
    CHECK(earth.wavelengths.at(4) == Approx(485.333333));
    CHECK(earth.solarIrradiance.at(3) == 1.975);
    CHECK(earth.groundAlbedo.at(15) == 0.491);
    REQUIRE(earth.scatterers.size() == 2);
    CHECK(earth.scatterers[0].crossSectionAt1um == Approx(0.04022e-30));
    CHECK(earth.scatterers[0].angstromExponent == 4);
    CHECK(earth.scatterers[1].crossSectionAt1um == Approx(0.042968e-12));
    CHECK(earth.scatterers[1].singleScatteringAlbedo == Spectrum(16, 1.0));
    CHECK(earth.scatterers[1].phaseFunctionType == PhaseFunctionType::Achromatic);
    REQUIRE(earth.absorbers.size() == 1);
    CHECK(earth.absorbers[0].crossSection.at(7) == 4.514e-25);
}

TEST_CASE("examples: earth-clear.atmo and earth-small.atmo are the same Earth")
{
    const Description earth = example("earth"), clear = example("earth-clear"), small = example("earth-small");
    CHECK(clear.allScatteringOrders);
    CHECK(clear.scatterers == std::vector{earth.scatterers[0]});
    CHECK(clear.absorbers == earth.absorbers);
    CHECK(small.scatterers == earth.scatterers);
    CHECK(small.absorbers == earth.absorbers);
    CHECK(small.solarIrradiance == earth.solarIrradiance);
    CHECK(small.scatteringSize == SizeScattering{128, 8, 32, 32});
}

TEST_CASE("examples: band averages of the files agree with independently averaged lists")
{
    // The lists of earth.atmo were made from finer tables by other code; the files hold means over 5 or 10 nm.
    const Description lists = example("earth"), files = example("earth-weighted-spectra");
    for (std::size_t i = 1; i + 1 < 16; ++i) {
        INFO("wavelength " << i);
        CHECK(files.solarIrradiance[i] == Approx(lists.solarIrradiance[i]).epsilon(0.01));
    }
    CHECK(sum(files.solarIrradiance) == Approx(sum(lists.solarIrradiance)).epsilon(0.001));
    // 0.8 grass + 0.2 snow; snow is nearly 0.98 in the visible.
    CHECK(files.groundAlbedo[5] == Approx(0.8 * lists.groundAlbedo[5] + 0.2 * 0.983).margin(0.01));
}
