// Prints the figures of docs/format.md:  test_model "[compression]"
#include "support.hpp"
#include <catch2/catch.hpp>
#include <chrono>
#include <iostream>
#include <numbers>

using namespace sky::model;
using namespace sky::model::test;

namespace {

constexpr int suns = 128, views = 128, azimuths = 16;

// One altitude of something like a sky: a day of 1e4 cd m^-2 that fades by nine decades after sunset, a bright horizon, an
// aureole, and computed noise of 1e-6 so that no compressor profits from a formula.
std::vector<float> skyLike(double altitudeKm, std::mt19937& random)
{
    std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
    std::vector<float> values;
    values.reserve(std::size_t(suns) * views * azimuths * 4);
    for (int i = 0; i < suns; ++i) {
        const double sun = i * 1.9 / suns;
        const double day = 1e4 / (1 + std::exp((sun - 1.6) * 25)) + 1e-5;
        for (int j = 0; j < views; ++j) {
            const double view = (j + 0.5) * std::numbers::pi / views, mu = std::cos(view);
            const double airmass = 1 / std::max(0.02, std::abs(mu));
            const double air = (1 - std::exp(-0.1 * std::exp(-altitudeKm / 8) * airmass)) * day;
            const double red = std::exp(-0.03 * airmass);
            for (int k = 0; k < azimuths; ++k) {
                const double phi = (k + 0.5) * std::numbers::pi / azimuths;
                const double nu = mu * std::cos(sun) + std::sin(view) * std::sin(sun) * std::cos(phi);
                double luminance = air * (0.75 * (1 + nu * nu) + 0.3 / std::pow(1.58 - 1.5 * nu, 1.5));
                luminance = (mu < -0.05 ? luminance / 2 + 0.05 * day : luminance) * (1 + noise(random));
                for (const double factor : {0.9 + 0.1 * red, 1., 1.3 - 0.3 * red, 2 - 0.5 * red})
                    values.push_back(static_cast<float>(luminance * factor));
            }
        }
    }
    return values;
}

} // namespace

TEST_CASE("size and time of a large luminance table", "[.][slow][compression]")
{
    constexpr int altitudes = 4, altitudesOfFullModel = 64, tables = 3;
    const Scratch scratch;
    for (const int bits : {8, 11, 13, 24}) {
        TableSpec spec = skySpec("sky", Channels::Luminance, bits);
        spec.axes = {axis("altitude", "m", altitudes, 1e3), axis("sunZenithAngle", "rad", suns, 0.01),
                     axis("viewZenithAngle", "rad", views, 0.01), axis("relativeAzimuth", "rad", azimuths, 0.01)};
        std::mt19937 random(1);
        std::chrono::duration<double> writing{};
        ModelWriter writer(scratch.path / "m");
        TableWriter table = writer.table(spec);
        for (int a = 0; a < altitudes; ++a) {
            const auto values = skyLike(30. * a, random);
            const auto start = std::chrono::steady_clock::now();
            table.writeRows(a * suns, suns, values.data());
            writing += std::chrono::steady_clock::now() - start;
        }
        writer.commit(smallManifest());
        const Model model = Model::open(scratch.path / "m");
        const auto start = std::chrono::steady_clock::now();
        CHECK(model.readRows("sky", suns, suns).size() == std::size_t(suns) * views * azimuths * 4);
        const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
        constexpr double factor = double(altitudesOfFullModel) / altitudes * tables;
        const double megabytes = static_cast<double>(model.manifest().files.at("sky.exr").bytes) / 1e6 * factor;
        std::cout << bits << " bits: full model " << megabytes << " MB, written in " << writing.count() * factor
                  << " s; one altitude of one table read in " << reading.count() << " s\n";
        if (bits <= 11)
            CHECK(megabytes < 250); // the goal for a full model
    }
}
