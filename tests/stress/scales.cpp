// Planets of any size, air of next to no depth and thick haze, computed on the GPU: single precision knows neither metres nor a smallest scattering. docs/stress.md

#include "../physics/media.hpp"
#include "../solver/small_world.hpp"
#include "../solver/support.hpp"
#include "physics/harmonics.hpp"
#include "scaled_media.hpp"
#include "showmysky/photometry.hpp"
#include <algorithm>
#include <map>

using namespace sky;
using test::smallSettings;
using test::SmallWorld;

TEST_CASE("in single precision too, a planet of 637 metres has the sky of the Earth, and so has one of 70 000 kilometres", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    auto air = test::exponentialAir(0.3, 0.4, test::rayleighPhase);
    air.sunAngularRadius = 0.00465;
    air.species[0].numberDensity.back() = std::exp(-14.7); // as where double precision is asked: limits.cpp
    const auto solved = [&](double factor) {
        const SmallWorld world(test::scaled(air, factor), smallSettings(2));
        return solver::iterate(context->api(), world.scene(), world.grid, world.settings, {4, false, 0}, false, [](double) {}).total;
    };
    const physics::Moments earth = solved(1);
    for (const double factor : {1e-4, 1e3 / 1024, 11.}) {
        const physics::Moments other = solved(factor);
        REQUIRE(other.values.size() == earth.values.size());
        double largest = 0;
        for (std::size_t i = 0; i < earth.values.size(); ++i)
            largest = std::max(largest, std::abs(other.values[i] - earth.values[i]));
        INFO("factor " << factor << " largest " << largest);
        CHECK(largest < 2e-5); // of ln I_00 and of ratios: roundings of float32, as between the GPU and its twin, twice
    }
}

TEST_CASE("air of next to no depth: light scattered once in closed form, and what is scattered again goes with the square", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    using showmysky::Photometer;
    std::map<Photometer::Method, double> squares;
    for (const double depth : {1e-6, 1e-9, 1e-12}) {
        solver::test::SceneText scene;
        scene.albedo = "0";
        scene.sun = "1e20 AU";      // a point
        std::ostringstream density; // 8 km of it, 10 fm^2 each
        density << depth / (8e3 * 1e-29) << "*exp(-altitude/(8.0*km))";
        scene.species = solver::test::SceneText::rayleigh(density.str());
        const solver::test::Run run(*context, scene.parse());
        solver::test::checkValues(run.model);
        for (const auto method : {Photometer::Method::fast, Photometer::Method::reference}) {
            double perSquare = 0;
            const Photometer light(run.model.directory().string(), method);
            const auto radiance = [&](double altitude, double sun, double view, unsigned layers) {
                std::vector<double> spectrum(light.wavelengthsNm().size());
                light.radiance({altitude, sun, 0, view, 0.5}, layers, spectrum.data());
                return spectrum[0];
            };
            for (const double sun : {0., 0.7, 1.3})
                for (const bool fromSpace : {false, true}) {
                    INFO("depth " << depth << " Sun " << sun << " from space " << fromSpace);
                    // All sunlight reaches all of the column: the phase function times the depth, vertically.
                    const double nu = fromSpace ? -std::cos(sun) : std::cos(sun), phase = 3 / (16 * test::pi) * (1 + nu * nu);
                    const double once = radiance(fromSpace ? 4e5 : 0, sun, fromSpace ? test::pi : 0, Photometer::singleScattering);
                    CHECK(once == Approx(1.5 * depth * phase).epsilon(1e-3)); // what is above 100 km: 4e-6; nodes of the tables
                    const double more = radiance(fromSpace ? 4e5 : 0, sun, fromSpace ? test::pi : 0, Photometer::multipleScattering);
                    REQUIRE(std::isfinite(more));
                    CHECK(more >= 0);
                    CHECK(more < 20 * depth * once); // as the way along the horizon: 40 depths
                    if (sun == 0.7 && !fromSpace)
                        perSquare = more / (depth * depth);
                }
            INFO("depth " << depth);
            CHECK(perSquare > 0);
            CHECK(perSquare == Approx(squares.try_emplace(method, perSquare).first->second).epsilon(1e-4)); // 1e-6 deep it is 40e-6 less
            for (const double altitude : {0., 3e4, 1e5, 4e5})
                for (const double sun : {0., 1.57, 1.7, 3.})
                    for (const double view : {0., 1.3, 1.57, 1.9, 3.1}) {
                        const double all = radiance(altitude, sun, view, Photometer::wholeSky);
                        REQUIRE(std::isfinite(all));
                        REQUIRE(all >= 0);
                    }
        }
    }
}

TEST_CASE("haze from thin to thick that does not absorb, over white ground: all light comes back", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    auto settings = smallSettings(2);
    settings.altitudes = 97; // 33 of them lose 1.5 % of a high Sun's light three deep, and 65 1 % of a low one's
    settings.suns = 10;
    settings.groundDirections = settings.skyDirections = 6;
    settings.directNodes = 64;
    settings.nodes = 24;
    for (const double depth : {0.05, 0.3, 1., 3.}) {
        const SmallWorld world(test::layer(depth, 1, 1, [](double angle) { return test::henyeyGreenstein(0.5, angle); }), settings);
        const auto field = solver::iterate(context->api(), world.scene(), world.grid, settings, {4, true, 1e-4}, false, [](double) {});
        std::vector<double> moments(physics::harmonicCount(settings.degree));
        int suns = 0;
        for (int j = 0; j < world.grid.sunCount(); ++j) {
            const double muSun = std::sin(world.grid.sunElevation(j));
            if (muSun < 0.02) // grazing light is spent within a part of the first level
                continue;
            field.total.interpolate(1000, muSun, moments.data());
            const double escape = -moments[physics::harmonicIndex(1, 0)] / std::sqrt(3 / (4 * test::pi)); // of an area, upwards
            INFO("depth " << depth << " muSun " << muSun << " escape / muSun " << escape / muSun);
            CHECK(escape == Approx(muSun).epsilon(0.01));
            ++suns;
        }
        CHECK(suns > 5);
    }
}
