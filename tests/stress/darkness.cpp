// Tables where the sky is dark, as an exposure a hundred thousand times longer would show them. docs/stress.md

#include "base/angles.hpp"
#include "model/precision.hpp"
#include "model/scattering_table.hpp"
#include "physics/colour.hpp"
#include "showmysky/photometry.hpp"
#include <catch2/catch.hpp>
#include <random>

using namespace sky;

namespace {

using sky::base::degree;
using sky::base::pi;

const model::Model& earth()
{
    static const model::Model opened = model::Model::open(SHOWMYSKY_TEST_MODEL);
    return opened;
}

} // namespace

TEST_CASE("eleven bits flash nowhere between texels, and are not the values of twenty-four")
{
    const model::ScatteringTable table(earth(), "multiple-scattering");
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit;
    double largest = 0;
    int different = 0, looked = 0;
    for (int sun = 0; sun < 40; ++sun) {
        const double elevation = (90 - 2.65 * sun) * degree;
        const auto exact = table.slice(0, elevation);
        auto rounded = exact;
        for (float& value : rounded)
            value = model::roundedToBits(value, 11);
        double a[4], b[4];
        for (int i = 0; i < 2500; ++i) {
            const double view = pi * (unit(random) - 0.5), azimuth = 2 * pi * unit(random);
            table.sample(exact, 0, view, azimuth, a);
            table.sample(rounded, 0, view, azimuth, b);
            for (int c = 0; c < 4; ++c) {
                REQUIRE((std::isfinite(b[c]) && b[c] >= 0));
                if (a[c] > 1e-30) {
                    largest = std::max(largest, std::abs(b[c] / a[c] - 1));
                    different += b[c] != a[c];
                    ++looked;
                }
            }
        }
    }
    CHECK(looked > 150000);
    CHECK(different > looked / 2);
    CHECK(largest < 2e-3); // half a unit of eleven bits, 2.4e-4, times what cubics overshoot
}

TEST_CASE("deep twilight from small tables, brightened a hundred thousand times: the colours of the direct integration, without blocks")
{
    const model::ScatteringTable table(earth(), "multiple-scattering");
    const showmysky::Photometer direct(SHOWMYSKY_TEST_MODEL, showmysky::Photometer::Method::reference);
    double deviation = 0, brightness = 0;
    for (int step = 0; step <= 24; ++step) {
        const double zenith = (96 + 0.25 * step) * degree; // between the table's Suns and at them
        const auto slice = table.slice(0, pi / 2 - zenith);
        for (const double view : {2., 11., 40., 85.})
            for (const double azimuth : {0., 1.3, pi}) {
                double value[4];
                table.sample(slice, 0, view * degree, azimuth, value);
                const auto truth =
                    direct.luminance({0, zenith, 0, (90 - view) * degree, azimuth}, showmysky::Photometer::multipleScattering);
                const auto found = physics::chromaticity({value[0], value[1], value[2]}),
                           wanted = physics::chromaticity({truth.X, truth.Y, truth.Z});
                REQUIRE((found && wanted));
                REQUIRE(std::min({value[0], value[1], value[2], value[3]}) >= 0);
                for (int c = 0; c < 2; ++c)
                    deviation = std::max(deviation, std::abs((*found)[c] - (*wanted)[c]));
                brightness = std::max(brightness, std::abs(value[1] / truth.Y - 1));
            }
    }
    INFO("xy " << deviation << ", luminance " << brightness);
    CHECK(deviation < 0.02);
    CHECK(brightness < 0.12); // of the light of the faintest twilight; 0.109 with ten nodes a ray
}
