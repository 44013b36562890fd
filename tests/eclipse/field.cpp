// Laws that the field of higher orders keeps on any grid, and what a finer grid changes.
#include "physics/source_iteration.hpp"
#include "scene.hpp"
#include <catch2/catch.hpp>

using namespace sky;
using namespace sky::eclipse;
using namespace sky::eclipse::test;

namespace {

/// Largest difference of two skies' ratios.
double largestDifference(const ViewLight& a, const ViewLight& b, const std::vector<ViewRay>& views)
{
    double largest = 0;
    for (std::size_t v = 0; v < views.size(); ++v)
        for (int k = 0; k < a.azimuths; ++k)
            for (int w = 0; w < a.wavelengths; ++w)
                largest = std::max(largest, double(std::abs(a.skyRatio(int(v), k, w) - b.skyRatio(int(v), k, w))));
    return largest;
}

} // namespace

TEST_CASE("eclipse field: without an eclipse the ratio is exactly one")
{
    const Earth earth;
    const auto views = earth.views(8e3);
    for (const double elevation : {0.6, -0.05}) {
        const auto light = earth.solved(earth.bodies(elevation, 0.1, 0, 8e3)).view(views, azimuths); // the Moon 6 degrees off
        int off = 0;
        for (std::size_t i = 0; i < light.eclipsed.size(); ++i)
            off += light.eclipsed[i] != light.uneclipsed[i] || light.groundEclipsed[i] != light.groundUneclipsed[i];
        CHECK(off == 0);
    }
}

TEST_CASE("eclipse field: a Sun dimmed everywhere alike dims all orders alike")
{
    const Earth earth;
    const auto light = earth.solved(earth.bodies(0.6), {},
                                    [](const auto&) {
                                        return physics::VisibleSun<float>{0.25f, {}};
                                    })
                           .view(earth.views(), azimuths);
    for (std::size_t i = 0; i < light.eclipsed.size(); ++i)
        REQUIRE(light.eclipsed[i] == 0.25f * light.uneclipsed[i]); // a power of two: no rounding
}

TEST_CASE("eclipse field: uneclipsed light is that of the ordinary solver")
{
    // Both are coarse: the ordinary solver's own error at such settings is 1 % (docs/accuracy.md), this grid's 2 %.
    FieldSettings settings = coarse();
    settings.altitudes = 14;
    settings.skyDirections = 6;
    settings.limbDirections = 3;
    settings.nodes = 10;
    settings.directNodes = 20;
    settings.viewNodes = 20;
    const Earth earth(settings, 3);
    physics::MomentSettings ordinary;
    ordinary.suns = 16;
    ordinary.degree = 3;
    ordinary.groundDirections = 3;
    std::vector<double> largest;
    for (int s = 0; s < earth.optics.species; ++s)
        largest.push_back(*std::max_element(earth.optics.extinction.begin() + s * earth.optics.wavelengths,
                                            earth.optics.extinction.begin() + (s + 1) * earth.optics.wavelengths));
    const physics::MomentGrid grid(earth.profile, largest, 12, ordinary.suns);
    const auto moments = physics::iterateSource(earth.medium, earth.profile, earth.optics, earth.sun, grid, ordinary, 3);
    const physics::SkyEvaluator sky(earth.medium, earth.profile, earth.optics, earth.sun);
    physics::RayTracer tracer(earth.profile, earth.optics);
    const double elevation = 40 * degrees;
    const auto views = earth.views();
    const auto light = earth.solved(earth.bodies(elevation)).view(views, azimuths);
    std::vector<double> expected(4);
    double squares = 0;
    for (std::size_t v = 0; v < views.size(); ++v)
        for (std::size_t k = 0; k < azimuths.size(); ++k) {
            const double mu = views[v].mu;
            const double nu = mu * std::sin(elevation) + std::sqrt(1 - mu * mu) * std::cos(elevation) * std::cos(azimuths[k]);
            physics::SkyEvaluator::Parts parts;
            parts.single = false;
            sky.radiance(tracer, &moments, 0, mu, std::sin(elevation), nu, parts, expected.data());
            for (std::size_t w = 0; w < 4; ++w) {
                const double off = double(light.uneclipsed[(v * azimuths.size() + k) * 4 + w]) / expected[w] - 1;
                CHECK(std::abs(off) < 0.06);
                squares += off * off;
            }
        }
    CHECK(std::sqrt(squares / double(views.size() * azimuths.size() * 4)) < 0.025);
}

TEST_CASE("eclipse field: never negative, never more than without the Moon, finite")
{
    const Earth earth;
    for (const double elevation : {1.2, 0.1, -0.06})
        for (const double higher : {0., 0.003}) {
            const auto light = earth.solved(earth.bodies(elevation, higher, 0.001, 3e3)).view(earth.views(3e3), azimuths);
            int bad = 0;
            for (std::size_t i = 0; i < light.eclipsed.size(); ++i)
                bad += !(light.eclipsed[i] >= 0) || !(light.eclipsed[i] <= 1.0001f * light.uneclipsed[i]) ||
                       !std::isfinite(light.uneclipsed[i]) || !(light.groundEclipsed[i] >= 0) ||
                       !(light.groundEclipsed[i] <= 1.0001f * light.groundUneclipsed[i]);
            CHECK(bad == 0);
        }
}

TEST_CASE("eclipse field: totality is dark overhead, and brighter towards the horizon than overhead")
{
    const Earth earth;
    const auto views = earth.views();
    const auto light = earth.solved(earth.bodies(0.8)).view(views, azimuths);
    for (int w = 0; w < 4; ++w) {
        CHECK(light.skyRatio(4, 1, w) > 1e-4f); // light of higher orders comes from beyond the umbra
        CHECK(light.skyRatio(4, 1, w) < 0.02f);
    }
    // Across the shadow its edge is nearest: more so where the air is clear.
    CHECK(light.skyRatio(1, 2, 3) > 1.3f * light.skyRatio(4, 2, 3));
}

TEST_CASE("eclipse field: mirror-symmetric with the Moon in the Sun's vertical plane; left and right are images")
{
    const Earth earth;
    const auto views = earth.views();
    const std::vector<double> left{0.7, 1.9, 3.}, right{-0.7, -1.9, -3.};
    const auto centred = earth.solved(earth.bodies(0.7, 0.0005));
    CHECK(largestDifference(centred.view(views, left), centred.view(views, right), views) < 1e-5);
    const auto moonLeft = earth.solved(earth.bodies(0.7, 0.0005, 0.001)).view(views, left);
    const auto moonRight = earth.solved(earth.bodies(0.7, 0.0005, -0.001)).view(views, right);
    CHECK(largestDifference(moonLeft, moonRight, views) < 1e-5);
    // And the side where the Moon is makes a difference.
    CHECK(largestDifference(moonLeft, earth.solved(earth.bodies(0.7, 0.0005, 0.001)).view(views, right), views) > 1e-3);
}

TEST_CASE("eclipse field: turning the whole scene turns the sky")
{
    const Earth earth;
    const auto views = earth.views();
    auto turned = azimuths;
    for (double& azimuth : turned)
        azimuth += 2.2;
    CHECK(largestDifference(earth.solved(earth.bodies(0.7, 0.0005, 0.001)).view(views, azimuths),
                            earth.solved(earth.bodies(0.7, 0.0005, 0.001, 0, 2.2)).view(views, turned), views) < 1e-5);
}

TEST_CASE("eclipse field: orders add up, and all of them end")
{
    const Earth earth;
    const auto views = earth.views();
    const auto bodies = earth.bodies(0.7);
    std::vector<float> last(views.size() * azimuths.size() * 4, 0.f);
    for (const int orders : {2, 3, 5}) {
        const auto field = earth.solved(bodies, {orders});
        CHECK(field.events() == orders - 1);
        const auto light = field.view(views, azimuths);
        for (std::size_t i = 0; i < last.size(); ++i)
            REQUIRE(light.eclipsed[i] > last[i]);
        last = light.eclipsed;
    }
    const auto all = earth.solved(bodies, {0, true}).view(views, azimuths), many = earth.solved(bodies, {14}).view(views, azimuths);
    for (std::size_t i = 0; i < last.size(); ++i)
        REQUIRE(double(all.eclipsed[i]) == Approx(double(many.eclipsed[i])).epsilon(0.01)); // the closed series, within its tolerance
    // They end once quotients are known, and fewer events do for a quotient than for the light.
    const auto quick = earth.solved(bodies, {0, true}), slow = earth.solved(bodies, {0, true, 1e-5});
    const auto known = quick.view(views, azimuths), truth = slow.view(views, azimuths);
    double squares = 0;
    for (int v = 0; v < int(views.size()); ++v)
        for (int k = 0; k < truth.azimuths; ++k)
            for (int w = 0; w < truth.wavelengths; ++w)
                squares += std::pow(double(known.skyRatio(v, k, w) / truth.skyRatio(v, k, w) - 1), 2);
    CHECK(std::sqrt(squares / double(truth.eclipsed.size())) < Orders().tolerance);
    CHECK(quick.events() < slow.events());
    CHECK(earth.solved(earth.bodies(0.7, 0.1), {0, true}).events() == 3); // without an eclipse there is nothing to wait for
    const auto single = earth.solved(bodies, {1}).view(views, azimuths);
    CHECK(*std::max_element(single.eclipsed.begin(), single.eclipsed.end()) == 0);
    CHECK(single.skyRatio(0, 0, 0) == 1);
}

TEST_CASE("eclipse field: goes on without a jump as the Moon crosses the Sun")
{
    // From outside of first contact (0.53 degrees) to the centre: steps of a tenth of a radius change the sky a little, monotonically.
    const Earth earth;
    const std::vector<ViewRay> zenith{{0, 1, false, 0}};
    double last = 1;
    for (double apart = 0.6; apart > -0.01; apart -= 0.025) {
        const auto light = earth.solved(earth.bodies(0.7, 0.6 * apart * degrees, 0.8 * apart * degrees), {3}).view(zenith, {0.});
        const double now = light.skyRatio(0, 0, 1);
        CAPTURE(apart, last, now);
        CHECK(now <= last + 1e-6);
        CHECK(last - now < 0.07); // 1 / 24 on average; the discs' overlap grows fastest, 0.06 a step, in the middle
        last = now;
    }
    CHECK(last < 0.01);
    // Contacts themselves: 0.2 arc seconds on both sides of second contact, by which the shadow moves 650 m of the 50 km that change it all.
    const auto at = [&](double apart) -> double {
        return earth.solved(earth.bodies(0.7, apart * degrees), {3}).view(zenith, {0.}).skyRatio(0, 0, 1);
    };
    const double second = 0.0155;
    CHECK(std::abs(at(second + 5e-5) / at(second - 5e-5) - 1) < 0.025);
}

TEST_CASE("eclipse field: a finer grid changes little", "[slow]")
{
    const FieldSettings usual;
    FieldSettings fine = usual;
    fine.along = 2 * usual.along - 1;
    fine.across = 2 * usual.across - 1;
    const Earth coarseEarth(usual), fineEarth(fine);
    const auto views = coarseEarth.views();
    for (const auto& [elevation, higher] : {std::pair{0.7, 0.}, {0.2, 0.}, {0.7, 0.003}}) {
        const auto bodies = coarseEarth.bodies(elevation, higher, 0, 0);
        const auto a = coarseEarth.solved(bodies, {3}).view(views, azimuths), b = fineEarth.solved(bodies, {3}).view(views, azimuths);
        double difference = 0, sum = 0;
        for (std::size_t i = 0; i < a.eclipsed.size(); ++i) {
            difference += std::pow(double(a.eclipsed[i] - b.eclipsed[i]), 2);
            sum += std::pow(double(b.eclipsed[i]), 2);
        }
        CAPTURE(elevation, higher);
        CHECK(std::sqrt(difference / sum) < 0.02);
    }
}
