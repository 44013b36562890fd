// Light of late events, told at once: LayeredLight by closed forms and against events one by one, EventTail by operators that are known.
#include "../gl/context_for_tests.hpp"
#include "../physics/media.hpp"
#include "physics/harmonics.hpp"
#include "small_world.hpp"
#include "solver/event_tail.hpp"
#include <cmath>
#include <limits>

using namespace sky;
using test::SmallWorld;

namespace {

/// Of one wavelength, from all rays of a world.
solver::LayeredLight layersOf(const gl::Api& api, const SmallWorld& world, std::vector<double> shape, bool straight)
{
    std::vector<physics::Directions> directions;
    std::vector<solver::RayStart> starts;
    for (const double h : world.grid.altitudes()) {
        directions.push_back(physics::directionsAt(world.profile.planet(), h, world.settings));
        for (std::size_t d = 0; d < directions.back().mu.size(); ++d)
            starts.push_back({h, directions.back().mu[d], directions.back().hitsGround[d]});
    }
    solver::LayeredLight layers(std::move(shape), 1, world.settings.degree, straight);
    const solver::ScatteredRays rays(api, world.scene(), world.grid, starts, {world.settings.nodes, 0, true});
    layers.add(rays, directions, 0, world.grid.altitudeCount());
    layers.factorise();
    return layers;
}

/// I_l0 of every level under the Sun at the zenith, and the irradiance of the ground, as LayeredLight takes them.
std::vector<double> atZenith(const physics::Moments& field, int terms)
{
    const int sun = field.grid.sunCount() - 1;
    std::vector<double> values;
    for (int a = 0; a < field.grid.altitudeCount(); ++a) {
        const double* moments = field.at(a, sun);
        for (int l = 0; l < terms; ++l)
            values.push_back(std::exp(moments[0]) * (l == 0 ? 1 : moments[physics::harmonicIndex(l, 0)]));
    }
    values.push_back(field.groundIrradiance[sun]);
    return values;
}

/// Fine enough for what light does within one optical depth.
physics::MomentSettings fineSettings(int degree)
{
    physics::MomentSettings settings = test::smallSettings(degree);
    settings.altitudes = 14;
    settings.groundDirections = settings.skyDirections = 8;
    settings.limbDirections = 4;
    settings.directNodes = 64;
    settings.nodes = 15;
    return settings;
}

/// Layers that let nothing follow.
solver::LayeredLight noLayers(int levels)
{
    solver::LayeredLight layers(std::vector<double>(levels, 1.), 1, 0, true);
    layers.factorise();
    return layers;
}

/// Light of one harmonic and wavelength under one Sun, level by level.
solver::Sums lightOf(const std::vector<double>& levels) { return {levels, levels}; }

solver::Sums times(const solver::Sums& light, double factor)
{
    solver::Sums result;
    addTo(result, light, factor);
    return result;
}

} // namespace

TEST_CASE("layered light: deep inside air that absorbs a part of it, an event and all that follow are that event over this part", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    for (const double absorbed : {0.5, 0.1, 0.05}) {
        const SmallWorld world(test::layer(100, 1 - absorbed, 0, test::isotropicPhase), fineSettings(0));
        const int levels = world.grid.altitudeCount();
        const auto layers = layersOf(context->api(), world, std::vector<double>(levels, 1.), true);
        std::vector<double> values(layers.valueCount(), 1.); // as bright everywhere
        layers.addFollowing(0, values.data());
        int middle = 0;
        while (world.grid.altitudes()[middle] < 500)
            ++middle;
        // A share of exp(-sqrt(3 absorbed) 50) has come from an edge, 4e-9 at most. The rest is single precision.
        CHECK(values[middle] == Approx(1 / absorbed).epsilon(2e-5));
        CHECK(values[0] < 0.9 / absorbed);
        CHECK(values[levels - 1] < 0.9 / absorbed);
    }
}

TEST_CASE("layered light: what follows an event under a Sun at the zenith is what events add up to one by one", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    for (const double albedo : {0., 0.8}) {
        const SmallWorld world(test::layer(3, 0.98, albedo, test::rayleighPhase), fineSettings(2));
        const auto field = solver::iterate(context->api(), world.scene(), world.grid, world.settings, {60, false, 0}, true, [](double) {});
        const int terms = 3, levels = world.grid.altitudeCount();
        const auto all = atZenith(field.total, terms);
        std::vector<double> shape;
        for (int a = 0; a < levels; ++a)
            shape.push_back(all[a * terms]);
        for (const bool straight : {false, true}) {
            const auto layers = layersOf(context->api(), world, shape, straight);
            REQUIRE(layers.valueCount() == int(all.size()));
            auto told = atZenith(field.perEvent[0], terms);
            layers.addFollowing(0, told.data());
            double worst = 0;
            for (std::size_t i = 0; i < all.size(); ++i)
                worst = std::max(worst, std::abs(told[i] - all[i]) / (i + 1 < all.size() ? all[i / terms * terms] : all[i]));
            INFO("albedo " << albedo << " straight " << straight);
            CHECK(worst < (straight ? 0.035 : 0.008)); // chords of what is curved between levels; else each event's own curves
        }
    }
}

TEST_CASE("event tail: where nothing is known of what follows, it is the series of events, and tells what is left")
{
    const auto layers = noLayers(3);
    for (const double part : {0.3, 0.6}) {
        const solver::Sums event = lightOf({0.1, 0.2, 0.05}), earlier = lightOf({0.3, 0.1, 0.1}); // per unit solar irradiance
        solver::EventTail tail(event, layers, 1);
        for (int n = 1; n <= 8; ++n) {
            tail.improve(times(tail.light(), part), earlier, layers);
            const double seen = (1 - std::pow(part, n + 1)) / (1 - part), all = 1 / (1 - part);
            double squares = 0;
            for (int i = 0; i < 3; ++i) {
                CHECK(tail.light().moments[i] == Approx(seen * event.moments[i]));
                CHECK(tail.light().irradiance[i] == Approx(seen * event.irradiance[i]));
                squares += std::pow((all - seen) * event.moments[i] / (earlier.moments[i] + all * event.moments[i]), 2) / 3;
            }
            // Changes are parts of what is there, which grows: so they seem to fall somewhat faster than events.
            if (n > 2)
                CHECK(tail.remainder() > 0.9 * std::sqrt(squares));
            CHECK_FALSE(tail.stalls());
        }
        CHECK(tail.remainder() < 0.02);
    }
}

TEST_CASE("event tail: after a leap the next change is small, and what is told as left is not")
{
    const auto layers = noLayers(3);
    const double part = 0.93;
    const solver::Sums event = lightOf({0.1, 0.2, 0.05}), earlier = lightOf({0, 0, 0});
    solver::EventTail tail(event, layers, 1);
    for (int n = 1; n <= 20; ++n) {
        tail.improve(times(tail.light(), n % 6 == 0 ? 1.1 * part : part), earlier,
                     layers); // as where a column is trusted less from then on
        CHECK(tail.settled() == (n >= 8));
        const double all = event.moments[0] / (1 - part), left = (all - tail.light().moments[0]) / all;
        INFO("sweep " << n << " left " << left);
        if (tail.settled())
            CHECK(tail.remainder() > 0.5 * left);
    }
}

TEST_CASE("event tail: changes that hardly fall are no way to an end")
{
    const auto layers = noLayers(3);
    for (const double part : {0.98, 1., 1.05}) {
        const solver::Sums event = lightOf({1e-3, 2e-3, 5e-4}), earlier = lightOf({0, 0, 0});
        solver::EventTail tail(event, layers, 1);
        int sweeps = 0;
        while (!tail.stalls() && sweeps < 40) {
            tail.improve(times(tail.light(), part), earlier, layers);
            ++sweeps;
        }
        INFO("part " << part << " sweeps " << sweeps);
        CHECK(sweeps < 30);
        CHECK(tail.remainder() > 0.8 * std::min(1., std::pow(part, sweeps + 1))); // of all light, the part after so many
    }
}

TEST_CASE("event tail: more light than deep air under the zenith holds is none, and of such light nothing is told")
{
    const auto layers = noLayers(3);
    const solver::Sums event = lightOf({0.1, 0.2, 0.05}), earlier = lightOf({0.3, 0.1, 0.1});
    for (const double growth : {30., 1e300, std::numeric_limits<double>::infinity()}) {
        solver::EventTail tail(event, layers, 1);
        for (int sweep = 0; sweep < 5; ++sweep)
            tail.improve(times(tail.light(), growth), earlier, layers);
        INFO("growth " << growth);
        for (int i = 0; i < 3; ++i) {
            CHECK(tail.light().moments[i] > 0);
            CHECK(earlier.moments[i] + tail.light().moments[i] < 0.6 * std::sqrt(4 * test::pi)); // mean radiance by the Sun's irradiance
            CHECK(std::isfinite(tail.light().irradiance[i]));
        }
        CHECK_FALSE(tail.remainder() < 1e9);
    }
    // Cut at every sweep it is the same after each, which is no gain.
    solver::EventTail tail(event, layers, 1);
    int sweeps = 0;
    while (!tail.stalls() && sweeps < 60) {
        tail.improve(times(tail.light(), 1.5), earlier, layers);
        ++sweeps;
    }
    CHECK(sweeps < 30);
}

TEST_CASE("event tail: a matrix that is singular makes no light that is no number", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    // Air that absorbs nothing, so deep that none of its light comes out between white ground and the top.
    const SmallWorld world(test::layer(1e5, 1, 1, test::isotropicPhase), fineSettings(0));
    const std::size_t levels = world.grid.altitudeCount();
    for (const double brightness : {1., 1e300, 1e307}) {
        const solver::Sums event = lightOf(std::vector<double>(levels, brightness));
        solver::EventTail tail(event, layersOf(context->api(), world, std::vector<double>(levels, 1.), true), 1);
        for (std::size_t a = 0; a < levels; ++a) {
            CHECK(std::isfinite(tail.light().moments[a]));
            CHECK(tail.light().moments[a] >= 0);
            CHECK(std::isfinite(tail.light().irradiance[a]));
            CHECK(tail.light().irradiance[a] >= 0);
        }
    }
}

TEST_CASE("late events: what those that are not allowed would change, from how changes fell")
{
    // Changes as powers of the number of events, against their sum.
    for (const double power : {1.5, 2., 4.}) {
        double left = 0;
        for (int event = 201; event < 2000000; ++event)
            left += std::pow(event, -power);
        left += std::pow(2e6, 1 - power) / (power - 1);
        CHECK(solver::leftAfter(std::pow(16, -power), std::pow(32, -power), 32, 200) == Approx(left).epsilon(0.02));
        CHECK(solver::leftAfter(std::pow(64, -power), std::pow(128, -power), 128, 200) == Approx(left).epsilon(0.02));
    }
    // Where they fall as the inverse of it or less, all that follow have no sum; nor where they rise, or stand still.
    for (const double change : {0.5, 0.6, 1., 3.})
        CHECK(std::isinf(solver::leftAfter(1, change, 32, 200)));
    // In proportion to the one before, they end long before the last that is allowed.
    for (const double ratio : {0.5, 0.8})
        CHECK(solver::leftAfter(std::pow(ratio, 16), std::pow(ratio, 32), 32, 200) < 0.01 * std::pow(ratio, 32));
    CHECK(solver::leftAfter(0.1, 0, 32, 200) == 0);
    CHECK(solver::leftAfter(100, 0.1, 32, 200) == solver::leftAfter(1, 0.1, 32, 200)); // no way to fall
}
