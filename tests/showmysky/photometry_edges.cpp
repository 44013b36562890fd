// Photometry at the edges: sharp upper ones of the air, where a low Sun lights only a skin of it, and air that scatters nothing.

#include "../physics/media.hpp"
#include "photometry_gather.hpp"
#include "physics/sky.hpp"
#include <catch2/catch.hpp>

namespace physics = sky::physics;
using sky::test::pi;

TEST_CASE("photometry: a low Sun lights only a skin of thick air, in closed form")
{
    // Seen from above: p mu0/(mu0 + mu), from a part mu0 / tau of the layer. Under the top, and under an edge in a vacuum.
    const double tau = 300;
    const physics::Medium upToTop = sky::test::layer(tau, 1, 0, sky::test::isotropicPhase);
    for (const auto& medium : {upToTop, sky::test::withDensity(upToTop, {0, 400, 400.0001, 500, 500.0001, 1000}, {0, 0, 10, 10, 0, 0})}) {
        const physics::Profile profile(medium);
        const physics::Optics optics = physics::makeOptics(medium, 4, false);
        const physics::SunTable sun(profile, optics, medium.sunAngularRadius);
        const showmysky::FastGather gather(medium, optics, sun, nullptr);
        showmysky::FastScratch scratch;
        for (const double muSun : {0.5, 0.05, 0.005, 0.001})
            for (const double mu : {1., 0.5, 0.1}) {
                double light = -1;
                gather.radiance(scratch, 1000, -mu, muSun, -mu * muSun, {true, false, true}, &light);
                INFO("shells " << profile.shells().size() << ", muSun " << muSun << " mu " << mu);
                CHECK(light == Approx(muSun / (muSun + mu) / (4 * pi)).epsilon(0.05));
            }
    }
}

TEST_CASE("photometry: the lit skin of thick air, seen through all of it, in closed form")
{
    // p mu0 / (mu - mu0) (exp(-tau / mu) - exp(-tau / mu0)): a skin of mu0, behind an optical depth of tau / mu.
    const double tau = 10;
    const physics::Medium medium = sky::test::layer(tau, 1, 0, sky::test::isotropicPhase);
    const physics::Profile profile(medium);
    const physics::Optics optics = physics::makeOptics(medium, 4, false);
    const physics::SunTable sun(profile, optics, medium.sunAngularRadius);
    const showmysky::FastGather gather(medium, optics, sun, nullptr);
    const physics::SkyEvaluator evaluator(medium, profile, optics, sun);
    physics::RayTracer tracer(profile, optics);
    showmysky::FastScratch scratch;
    for (const double muSun : {0.05, 0.005, 0.001})
        for (const double mu : {1., 0.8}) {
            double fast = -1, precise = -1;
            gather.radiance(scratch, 0, mu, muSun, mu * muSun, {true, false, true}, &fast);
            evaluator.radiance(tracer, nullptr, 0, mu, muSun, mu * muSun, {}, &precise);
            const double light = muSun / (mu - muSun) * (std::exp(-tau / mu) - std::exp(-tau / muSun)) / (4 * pi);
            INFO("muSun " << muSun << " mu " << mu);
            CHECK(fast == Approx(light).epsilon(0.1)); // two nodes for each halving of the way to the edge
            CHECK(precise == Approx(light).epsilon(0.1));
        }
}

TEST_CASE("photometry: smoke that scatters nothing has no phase functions, and sends no light")
{
    physics::Medium medium = sky::test::layer(1, 0, 0, sky::test::isotropicPhase);
    medium.scatteringAngles.clear(); // as a model of it is read
    medium.species[0].phaseFunction.clear();
    const physics::Profile profile(medium);
    const physics::Optics optics = physics::makeOptics(medium, 4, true);
    REQUIRE(optics.scatterers.empty());
    const physics::SunTable sun(profile, optics, medium.sunAngularRadius);
    const showmysky::FastGather gather(medium, optics, sun, nullptr);
    const physics::SkyEvaluator evaluator(medium, profile, optics, sun);
    physics::RayTracer tracer(profile, optics);
    showmysky::FastScratch scratch;
    for (const double mu : {-1., 0.001, 1.}) {
        double fast = -1, precise = -1;
        gather.radiance(scratch, 500, mu, 0.5, 0.5 * mu, {true, true, true}, &fast);
        evaluator.radiance(tracer, nullptr, 500, mu, 0.5, 0.5 * mu, {}, &precise);
        CHECK(fast == 0);
        CHECK(precise == 0);
    }
}
