// Deep twilight, where rare paths carry much of the light: error bars must know of them.

#include "montecarlo/reference.hpp"
#include "sample_air.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>

using namespace sky;
using namespace sky::montecarlo;
using std::numbers::pi;

namespace {

/// Air that thins out within metres, on a planet of a thousand kilometres: all of sunset happens within a tenth of a degree, and light comes
/// from kilometres away through air as high as a house.
physics::Medium shellOfMetres()
{
    physics::Medium medium = test::flatLayer(1, 1, 0, [](double angle) { return 0.75 / std::pow(1.25 - std::cos(angle), 1.5) / (4 * pi); });
    medium.planetRadius = 1.58e6;
    medium.topOfAtmosphere = 4.3;
    medium.altitudes.clear();
    physics::Species& species = medium.species.front();
    species.numberDensity.clear();
    const double scaleHeight = 0.3;
    for (int i = 0; i <= 64; ++i) {
        medium.altitudes.push_back(medium.topOfAtmosphere * i / 64);
        species.numberDensity.push_back(std::exp(-medium.altitudes.back() / scaleHeight) / scaleHeight);
    }
    species.extinctionCrossSection = {2.5};
    return medium;
}

} // namespace

TEST_CASE("twilight in a shell of metres: short runs know how far off they are")
{
    const Reference reference(shellOfMetres());
    const auto run = [&](double sunDeg, double viewDeg, double azimuthDeg, std::int64_t paths, std::uint64_t seed) {
        const Query query{
            .sunZenithAngle = sunDeg * pi / 180, .viewZenithAngle = viewDeg * pi / 180, .relativeAzimuth = azimuthDeg * pi / 180};
        return reference.radiance(query, {.orders = 4, .relativeError = 0, .maxPaths = paths, .seed = seed});
    };
    for (const auto [sun, view, azimuth] : {std::array{90.0535, 14.6, 89.1}, {90.0631, 52.0, 22.2}, {90.0598, 89.63, 154.3}}) {
        CAPTURE(sun, view, azimuth);
        const Result truth = run(sun, view, azimuth, 1 << 18, 99);
        CHECK(truth.multipleStderr < 0.03 * truth.multiple);
        double squares = 0;
        const int runs = 8;
        for (int seed = 1; seed <= runs; ++seed) {
            const Result result = run(sun, view, azimuth, 1 << 14, static_cast<std::uint64_t>(seed));
            const double deviation = (result.multiple - truth.multiple) / std::hypot(result.multipleStderr, truth.multipleStderr);
            CHECK(std::abs(deviation) < 4);
            squares += deviation * deviation;
        }
        CHECK(squares / runs < 3); // chi square of 8: beyond that in one of a thousand
    }
}
