// Sizes and depths at which other programs lose digits or energy. docs/stress.md

#include "../physics/media.hpp"
#include "physics/eclipse.hpp"
#include "physics/harmonics.hpp"
#include "physics/source_iteration.hpp"
#include "scaled_media.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

namespace {

MomentSettings coarse(int degree)
{
    MomentSettings s;
    s.altitudes = 9;
    s.suns = 8;
    s.degree = degree;
    s.azimuths = degree + 1;
    s.groundDirections = 6;
    s.limbDirections = 1;
    s.skyDirections = 6;
    s.directNodes = 24;
    s.nodes = 12;
    return s;
}

Moments solved(const Medium& medium, const MomentSettings& settings, int events)
{
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, settings.degree, true);
    const SunTable sun(profile, optics, medium.sunAngularRadius, 20, 40);
    const MomentGrid grid(profile, {optics.extinction[0]}, settings.altitudes, settings.suns);
    return iterateSource(medium, profile, optics, sun, grid, settings, events);
}

} // namespace

TEST_CASE("discs without size, and one as large as the sky: shares are 0 or 1, and whose disc is named first doesn't matter")
{
    for (const double moon : {0., 1e-9, 4.6e-3, 1., 1.5})
        for (const double separation : {0., 1e-12, 4.6e-3, 1., 3.1}) {
            const Discs<double> point{0, moon, separation};
            INFO("moon " << moon << " separation " << separation);
            CHECK(coveredFraction(point) == (separation < moon ? 1 : 0)); // a point-like Sun is behind the Moon or not
            CHECK(visibleFraction(point) == (separation < moon ? 0 : 1));
            CHECK(coveredFraction(Discs<double>{4.6e-3, 0, separation}) == 0);
        }
    // The area that two discs share, in whichever order: covered share times the square of the radius it is a share of.
    for (const double ratio : {1., 1 + 1e-7, 1 + 1e-5, 1.001, 1.01, 1.5, 300.})
        for (const double part : {0., 1e-9, 0.1, 0.5, 0.9, 1 - 1e-9, 1.}) {
            const double a = 4.6e-3, b = a * ratio, separation = (b - a) + part * 2 * a;
            INFO("ratio " << ratio << " part " << part);
            CHECK(a * a * coveredFraction(Discs<double>{a, b, separation}) ==
                  Approx(b * b * coveredFraction(Discs<double>{b, a, separation})).epsilon(1e-9).margin(1e-18 * b * b));
        }
}

TEST_CASE("a planet of 400 metres has the sky of the Earth, and so has one of 70 000 kilometres")
{
    const auto settings = coarse(2);
    auto air = sky::test::exponentialAir(0.3, 0.4, sky::test::rayleighPhase);
    air.sunAngularRadius = 0.00465;                        // the shadow of a point would fall on either side of a node by rounding,
    air.species[0].numberDensity.back() = std::exp(-14.7); // as would the number of cells that divide 15 scale heights
    const Moments earth = solved(air, settings, 3);
    for (const double factor : {400 / 6.371e6, 1e-3, 1e3 / 1024, 11.}) {
        const Moments other = solved(sky::test::scaled(air, factor), settings, 3);
        REQUIRE(other.values.size() == earth.values.size());
        double largest = 0;
        for (std::size_t i = 0; i < earth.values.size(); ++i)
            largest = std::max(largest, std::abs(other.values[i] - earth.values[i]));
        INFO("factor " << factor);
        CHECK(largest < 1e-5); // of ln I_00 and of ratios
    }
}

TEST_CASE("twilight of a planet of 10 Gm, which ends within a tenth of a degree, has the light that more Suns find")
{
    auto air = sky::test::scaled(sky::test::exponentialAir(0.1, 0.3, sky::test::rayleighPhase), 0.085);
    air.planetRadius = 1e10;
    auto settings = coarse(2);
    settings.suns = 28;
    const Profile profile(air);
    const Optics optics = makeOptics(air, settings.degree, true);
    const SunTable sun(profile, optics, air.sunAngularRadius);
    const MomentGrid usual(profile, {optics.extinction[0]}, settings.altitudes, settings.suns);
    const MomentGrid more(profile.planet(), usual.altitudes(), usual.lowestElevation(), 6 * usual.sunCount() - 5, usual.sunScale());
    const Moments field = iterateSource(air, profile, optics, sun, usual, settings, 1),
                  truth = iterateSource(air, profile, optics, sun, more, settings, 1);
    const auto lightAt = [&](const Moments& moments, double elevation) {
        std::vector<double> values(harmonicCount(settings.degree));
        moments.interpolate(0, std::sin(elevation), values.data());
        return values[0];
    };
    const double noon = lightAt(truth, pi / 2);
    double squares = 0;
    int count = 0;
    for (double elevation = 0; elevation > -0.002; elevation -= 1e-5) {
        const double light = lightAt(truth, elevation);
        if (light < 1e-6 * noon)
            break;
        squares += std::pow(lightAt(field, elevation) / light - 1, 2);
        ++count;
    }
    CHECK(count > 40);
    CHECK(std::sqrt(squares / count) < 0.1); // most of it where a millionth of the light is left
}

TEST_CASE("after sunset, twice as many samples along a ray change little, and twice as many again less")
{
    const auto medium = sky::test::sampleEarth(sky::test::Aerosol::No);
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 2, false);
    const SunTable sun(profile, optics, medium.sunAngularRadius);
    const SkyEvaluator evaluator(medium, profile, optics, sun);
    RayTracer tracer(profile, optics);
    const auto light = [&](int nodes, double mu, double zenith) {
        SkyEvaluator::Parts parts;
        parts.multiple = false;
        parts.singleNodes = nodes;
        std::vector<double> result(optics.wavelengths);
        const double muSun = std::cos(zenith);
        evaluator.radiance(tracer, nullptr, 0, mu, muSun, mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)), parts,
                           result.data());
        return result[1];
    };
    double coarse = 0, fine = 0;
    for (int i = 0; i <= 20; ++i)
        for (const double mu : {0.05, 0.3, 1.}) {
            const double zenith = (90 + 0.4 * i) * pi / 180, truth = light(768, mu, zenith);
            coarse = std::max(coarse, std::abs(light(48, mu, zenith) / truth - 1));
            fine = std::max(fine, std::abs(light(96, mu, zenith) / truth - 1));
        }
    CHECK(coarse < 0.05);
    CHECK(fine < 0.02);
    CHECK(fine < 0.6 * coarse);
}

TEST_CASE("a Sun without size through the gap between two layers with edges: nodes and table find what comes through")
{
    // Scene 25 of seed 11: layers from the ground to a fifth of the air and from 0.3 to 0.6 of it, and some exponential air everywhere.
    const double top = 2.15e5;
    auto medium = sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase, 6.55e7),
                                         {0, 0.2 * top, 0.2000001 * top, 0.3 * top, 0.3000001 * top, 0.6 * top, 0.6000001 * top, top},
                                         {1, 1, 0, 0, 1 / 3., 1 / 3., 0, 0});
    medium.species[0].extinctionCrossSection = {1.55e-5};
    medium.species.push_back(medium.species[0]);
    for (std::size_t i = 0; i < medium.altitudes.size(); ++i)
        medium.species[1].numberDensity[i] = std::exp(-medium.altitudes[i] / 2.56e4);
    medium.species[1].extinctionCrossSection = {6e-6};
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 2, false);
    RayTracer tracer(profile, optics);
    const auto light = [&](const SunTable& sun, int nodes, double view, double zenith) {
        SkyEvaluator::Parts parts;
        parts.multiple = false;
        parts.singleNodes = nodes;
        double result;
        SkyEvaluator(medium, profile, optics, sun)
            .radiance(tracer, nullptr, 0, std::cos(view), std::cos(zenith), std::cos(view - zenith), parts, &result);
        return result;
    };
    const SunTable usual(profile, optics, 0), fine(profile, optics, 0, 4 * SunTable::usualAltitudes, 4 * SunTable::usualElevations);
    double squares = 0;
    int count = 0;
    for (double view = 0.3; view < 1.35; view += 0.1)
        for (const double zenith : {1.605, 1.613, 1.62}) {
            squares += std::pow(light(usual, 96, view, zenith) / light(fine, 1000, view, zenith) - 1, 2);
            ++count;
        }
    CHECK(std::sqrt(squares / count) < 0.05); // with a third of the nodes, altitudes and elevations 0.116
}

TEST_CASE("a cloud's surface is seen where it is, however slanted the ray that enters it")
{
    // Optical depth 1 a metre, and a field that falls by e a metre below the surface: from outside, flat, 1 / (1 + mu) is seen.
    const auto medium = sky::test::withDensity(sky::test::layer(1000, 1, 0, sky::test::isotropicPhase, 6.4e6),
                                               {0, 1000, 1000.001, 2000, 2000.001, 12e3}, {0, 0, 1, 1, 0, 0});
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, 2, false);
    const Planet& p = profile.planet();
    RayTracer tracer(profile, optics);
    for (const double slope : {1., 0.3, 0.05, 0.01, 0.003}) {
        // The ray that meets the surface with this cosine, from 12 km: r sin is the same all along.
        const double sine = (p.radius + 2000) / (p.radius + 12e3) * std::sqrt(1 - slope * slope), mu = -std::sqrt(1 - sine * sine);
        const RayNodes ray = tracer.trace(12e3, mu, 24, hitsGround(p, 12e3, mu));
        double seen = 0;
        for (std::size_t k = 0; k < ray.nodes.size(); ++k)
            seen += ray.weights[k] * std::exp(std::min(0., ray.nodes[k].altitude - 2000));
        INFO("slope " << slope);
        CHECK(seen == Approx(1 / (1 + slope)).epsilon(0.03)); // few nodes inside the first optical depth
    }
}
