#include "../gl/context_for_tests.hpp"
#include "../montecarlo/sample_air.hpp"
#include "../physics/media.hpp"
#include "physics/harmonics.hpp"
#include "small_world.hpp"
#include <cmath>

using namespace sky;
using test::smallSettings;
using test::SmallWorld;

namespace {

/// Largest difference of ln I_00, of ratios, and of ln of the ground's irradiance, for Suns above an elevation.
struct Difference {
    double logarithm = 0, ratio = 0, ground = 0;
};

Difference difference(const physics::Moments& a, const physics::Moments& b, double lowestSunDeg)
{
    Difference d;
    REQUIRE(a.values.size() == b.values.size());
    for (int h = 0; h < a.grid.altitudeCount(); ++h)
        for (int j = 0; j < a.grid.sunCount(); ++j) {
            if (a.grid.sunElevation(j) * 180 / 3.14159265358979323846 < lowestSunDeg)
                continue;
            for (int i = 0; i < physics::harmonicCount(a.degree) * a.wavelengths; ++i)
                (i < a.wavelengths ? d.logarithm : d.ratio) =
                    std::max(i < a.wavelengths ? d.logarithm : d.ratio, std::abs(a.at(h, j)[i] - b.at(h, j)[i]));
            for (int w = 0; w < a.wavelengths; ++w)
                d.ground = std::max(
                    d.ground, std::abs(std::log(a.groundIrradiance[j * a.wavelengths + w] / b.groundIrradiance[j * a.wavelengths + w])));
        }
    return d;
}

} // namespace

TEST_CASE("iteration on the GPU agrees with its twin in double precision, event by event", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    for (const auto aerosol : {test::Aerosol::No, test::Aerosol::Yes}) {
        const SmallWorld world(test::sampleEarth(aerosol), smallSettings(aerosol == test::Aerosol::No ? 2 : 4));
        double progress = 0;
        const auto field =
            solver::iterate(context->api(), world.scene(), world.grid, world.settings, {4, false, 0}, true, [&](double fraction) {
                CHECK(fraction >= progress - 1e-12);
                progress = fraction;
            });
        CHECK(progress == 1);
        CHECK(field.eventCount == 3);
        REQUIRE(field.perEvent.size() == 3);
        const Difference first = difference(field.perEvent[0], world.twin(1), -8), total = difference(field.total, world.twin(3), -8);
        // The same sums in the same steps: what is left are the roundings of float32.
        CHECK(first.logarithm < 2e-6);
        CHECK(first.ratio < 2e-6);
        CHECK(first.ground < 2e-6);
        CHECK(total.logarithm < 5e-6);
        CHECK(total.ratio < 5e-6);
        CHECK(total.ground < 5e-6);
    }
}

TEST_CASE("iteration: all orders are more than four and no more than the remainder says", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    const SmallWorld world(test::sampleEarth(test::Aerosol::No), smallSettings(2));
    const auto quiet = [](double) {};
    const auto all = solver::iterate(context->api(), world.scene(), world.grid, world.settings, {0, true, 1e-3}, false, quiet);
    CHECK(all.eventCount > 4);
    CHECK(all.ended);
    CHECK(all.remainder < 1e-3);
    CHECK(all.perEvent.empty());
    CHECK_FALSE(solver::iterate(context->api(), world.scene(), world.grid, world.settings, {0, true, 1e-9, 3}, false, quiet).ended);
    const auto many =
        solver::iterate(context->api(), world.scene(), world.grid, world.settings, {all.eventCount + 6, false, 0}, false, quiet);
    // The series was closed: what five more events add differs from the estimate by less than the remainder.
    const Difference d = difference(all.total, many.total, 0);
    CHECK(d.logarithm < 1e-3);
    CHECK(all.total.at(0, world.grid.sunCount() - 1)[0] > many.total.at(0, world.grid.sunCount() - 1)[0] - 1e-4);
}

TEST_CASE("iteration: above air that lets nothing through, no event is brighter than the one before", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    // A scatterer 16 deep on black air, and levels at the edge between them as uneven as fieldLevels leaves them: light comes down to where there
    // was none from event to event, and falls by decades from each level to the next.
    physics::Medium medium =
        test::withDensity(test::layer(1, 0.999, 0, test::isotropicPhase, 13.8e6), {0, 20e3, 20.001e3, 28e3}, {0, 0, 1, 1});
    medium.species[0].extinctionCrossSection = {0.002};
    physics::Species black = medium.species[0];
    black.name = "black";
    black.singleScatteringAlbedo = {0};
    black.extinctionCrossSection = {10};
    black.numberDensity = {1, 1, 0, 0};
    medium.species.push_back(black);
    const SmallWorld world(medium, smallSettings(0));
    const physics::MomentGrid grid(world.profile.planet(),
                                   {0, 19e3, 19.8e3, 20.3e3, 21.8e3, 23.2e3, 24.4e3, 25.4e3, 26.2e3, 26.8e3, 27.2e3, 27.6e3, 27.9e3, 28e3},
                                   world.grid.lowestElevation(), 28);
    const auto field = solver::iterate(context->api(), world.scene(), grid, world.settings, {30, false, 0}, true, [](double) {});
    const auto brightest = [](const physics::Moments& event) {
        double most = 0;
        for (int a = 0; a < event.grid.altitudeCount(); ++a)
            for (int j = 0; j < event.grid.sunCount(); ++j)
                most = std::max(most, std::exp(event.at(a, j)[0]));
        return most;
    };
    for (std::size_t n = 1; n < field.perEvent.size(); ++n) {
        INFO("event " << n + 1);
        CHECK(brightest(field.perEvent[n]) < 1.01 * brightest(field.perEvent[n - 1]));
    }
}

TEST_CASE("iteration: late events of deep air, told at once, are what they add up to one by one", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    physics::MomentSettings settings = smallSettings(2);
    settings.altitudes = 10;
    const SmallWorld world(test::layer(12, 0.98, 0.3, test::rayleighPhase), settings);
    const auto quiet = [](double) {};
    const auto all = solver::iterate(context->api(), world.scene(), world.grid, world.settings, {0, true, 1e-3}, false, quiet);
    CHECK(all.irradiance.size() == 16); // what is computed by itself
    CHECK(all.eventCount < 24);
    CHECK(all.ended);
    // The shape of light that lasts longest keeps 0.98 (1 - (pi / (12 + 2 q))^2 / 3) = 0.96 from one event to the next, with q = 0.71.
    const auto many = solver::iterate(context->api(), world.scene(), world.grid, world.settings, {300, false, 0}, false, quiet);
    const Difference d = difference(all.total, many.total, 0.01); // below, all is dark
    CHECK(d.logarithm < 1e-3);                                    // the tolerance
    CHECK(d.ratio < 1e-3);
    CHECK(d.ground < 1e-3);
}

TEST_CASE("iteration: through air 100 and 1000 deep that absorbs nothing comes what the asymptotic theory says, without hundreds of events",
          "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    physics::MomentSettings settings = smallSettings(0);
    settings.altitudes = 14;
    settings.groundDirections = 7;
    settings.limbDirections = 4;
    settings.skyDirections = 8;
    settings.directNodes = 64;
    settings.nodes = 15;
    for (const double depth : {100., 1000.}) {
        const SmallWorld world(test::layer(depth, 1, 0, test::isotropicPhase), settings);
        const auto all =
            solver::iterate(context->api(), world.scene(), world.grid, world.settings, {0, true, 2.5e-3}, false, [](double) {});
        INFO("depth " << depth << ", " << all.eventCount << " events");
        CHECK(all.eventCount <= (depth < 1000 ? 24 : 50));
        // Twilight under air 1000 deep comes from beside, which layers don't tell.
        CHECK(all.remainder < (depth < 1000 ? 2.5e-3 : 2e-2));
        // Plane transmission of a deep conservative layer over black ground, 4/3 K(mu) / (depth + 2 q): the escape function K(1) is sqrt(3)/4
        // H(1) = 1.2591, the extrapolation length q = 0.71045. source: van de Hulst 1980, Multiple Light Scattering, 1
        // Levels and directions as few as these lose 4 % where it is 5 deep and events end by themselves, 15 % here. Two hundred events, one
        // by one, leave 8e-8 of it.
        const double transmitted = 4. / 3 * 1.2591 / (depth + 2 * 0.71045);
        CHECK(all.total.groundIrradiance[world.grid.sunCount() - 1] == Approx(transmitted).epsilon(0.2));
    }
}

TEST_CASE("iteration: a gap of clear air between white ground and a cloud 1000 deep is lit without cliffs, up into the cloud, about sunset",
          "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    // Scene 18 of seed 2 of docs/stress.md at one wavelength. Nothing is scattered in the gap, so light there is what its two sides send, again and again.
    physics::MomentSettings settings = smallSettings(0);
    settings.altitudes = 10;
    settings.groundDirections = settings.limbDirections = 4;
    settings.skyDirections = 7;
    settings.directNodes = 32;
    settings.nodes = 10;
    settings.azimuths = 4;
    const double middle = 330e3, half = 34e3, top = 1e6;
    std::vector<double> altitudes{0}, densities{0};
    for (int i = -100; i <= 100; ++i) {
        altitudes.push_back(middle + half * i / 100);
        densities.push_back(1 - std::pow(i / 100., 2));
    }
    altitudes.push_back(top);
    densities.push_back(0);
    auto medium = test::withDensity(test::layer(1, 1, 1, test::isotropicPhase, 2.56e8), altitudes, densities);
    medium.species[0].extinctionCrossSection = {1000 / (4. / 3 * half)};
    medium.sunAngularRadius = 0.00465;
    const SmallWorld world(medium, settings);
    const auto all = solver::iterate(context->api(), world.scene(), world.grid, world.settings, {0, true, 2.5e-3}, false, [](double) {});
    // What is told at once of late light was once cut off at a share of the brightest, and fell by up to e^8 between two levels.
    const auto& levels = world.grid.altitudes();
    for (int sun = 0; sun < world.grid.sunCount(); ++sun) {
        const double elevation = world.grid.sunElevation(sun) / base::pi * 180;
        if (std::abs(elevation) > 1.5)
            continue;
        for (std::size_t level = 0; levels[level + 1] < middle; ++level) {
            if (levels[level] < middle - half) // in the gap light comes from far beside
                continue;
            INFO("Sun at " << elevation << " degrees, from " << levels[level] << " to " << levels[level + 1] << " m");
            CHECK(all.total.at(level + 1, sun)[0] == Approx(all.total.at(level, sun)[0]).margin(0.5).epsilon(0));
        }
    }
}
