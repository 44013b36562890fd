#include "physics/eclipse.hpp"
#include "base/error.hpp"
#include "media.hpp"
#include "physics/quadrature.hpp"
#include <catch2/catch.hpp>
#include <limits>

using namespace sky::physics;
using Catch::Matchers::Contains;
using sky::test::pi;

namespace {

/// The textbook's area of two circular segments in extended precision: good where the lune isn't thin.
long double textbookLune(long double a, long double b, long double d)
{
    const long double sun = std::acos((d * d + a * a - b * b) / (2 * d * a)), moon = std::acos((d * d + b * b - a * a) / (2 * d * b));
    const long double lens = a * a * (sun - std::sin(sun) * std::cos(sun)) + b * b * (moon - std::sin(moon) * std::cos(moon));
    return 1 - lens / (std::acos(-1.L) * a * a);
}

/// Share of the Sun left where the limbs cross, for d < b: the polar angle around the Sun's centre, away from the Moon,
/// over which its limb shows, and the depth of the lune at each; extended precision, no closed area.
long double integratedLune(long double a, long double b, long double d)
{
    const long double cosine = (b * b - a * a - d * d) / (2 * a * d);
    const long double end = std::acos(std::clamp(cosine, -1.L, 1.L));
    const auto rule = gaussLegendre(96);
    long double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const long double phi = end * (1 + static_cast<long double>(rule.nodes[i])) / 2;
        const long double root = std::sqrt(b * b - d * d * std::sin(phi) * std::sin(phi));
        // Distance of the Moon's limb, on its far side from the Moon's centre; none where the direction misses the
        // Moon.
        const long double limb = -d * std::cos(phi) + root;
        sum += static_cast<long double>(rule.weights[i]) * (a - limb) * (a + limb);
    }
    return sum * end / 2 / (std::acos(-1.L) * a * a);
}

/// 21 August 2017 at greatest eclipse, as published: Moon's horizontal parallax 58'55.7", the Sun's semi-diameter
/// 15'48.7", Earth's equatorial radius 6378.137 km. source: Espenak,
/// eclipse.gsfc.nasa.gov/SEbeselm/SEbeselm2001/SE2017Aug21Tbeselm.html
constexpr double equatorialRadius = 6378.137e3, astronomicalUnit = 149597870700.;
constexpr double sunRadius = 959.63 / 3600 * pi / 180 * astronomicalUnit;

EclipseBodies greatestEclipse2017(double moonRadiusOverEarths, double sunZenithAngle = (90 - 63.9) * pi / 180)
{
    EclipseBodies bodies;
    bodies.planet = {equatorialRadius, 120e3};
    bodies.sunDirection = {std::sin(sunZenithAngle), 0, std::cos(sunZenithAngle)};
    bodies.moonDirection = bodies.sunDirection;
    bodies.moonDistance = equatorialRadius / std::sin((58 * 60 + 55.7) / 3600 * pi / 180);
    bodies.sunDistance = 959.63 / 948.7 * astronomicalUnit;
    bodies.sunAngularRadius = std::asin(sunRadius / bodies.sunDistance);
    bodies.moonRadius = moonRadiusOverEarths * equatorialRadius;
    return bodies;
}

/// The eclipse of the sample descriptions: Moon and Sun at 40 degrees of elevation, `offset` rad between them.
EclipseBodies sampleEclipse(double offset, double moonDistance = 371925e3)
{
    EclipseBodies bodies;
    bodies.planet = {6371e3, 120e3};
    const double zenith = 50 * pi / 180;
    bodies.sunDirection = {std::sin(zenith), 0, std::cos(zenith)};
    bodies.moonDirection = {std::sin(zenith) * std::cos(offset), std::sin(offset), std::cos(zenith) * std::cos(offset)};
    bodies.moonDistance = moonDistance;
    bodies.sunDistance = 1.01208 * astronomicalUnit;
    bodies.sunAngularRadius = 695700e3 / bodies.sunDistance;
    return bodies;
}

template<class Real>
double relativeLuneError(Real a, Real b, Real d)
{
    const long double expected = d < b * Real(0.9) ? integratedLune(a, b, d) : textbookLune(a, b, d);
    return static_cast<double>(std::abs(visibleFraction(Discs<Real>{a, b, d}) / expected - 1));
}

} // namespace

TEST_CASE("eclipse: what is left of the Sun against integration in extended precision")
{
    for (const double b : {1.05, 1.3, 3.0})
        for (const double t : {0.001, 0.02, 0.2, 0.5, 0.7, 0.98}) {
            CAPTURE(b, t);
            CHECK(relativeLuneError(1., b, b - 1 + t * 2) < 1e-12);
            CHECK(relativeLuneError(1.f, static_cast<float>(b), static_cast<float>(b - 1 + t * 2)) < 2e-4);
        }
    SECTION("lunes of nearly equal discs, where two seconds of totality begin and end")
    {
        for (const double excess : {1e-3, 1e-5, 1e-7})
            for (const double t : {1.01, 1.5, 4., 30.}) {
                CAPTURE(excess, t);
                const double bound = 1e-14 / excess; // of the integration: digits of a + excess
                CHECK(relativeLuneError(1., 1 + excess, excess * t) < std::max(1e-11, bound));
            }
        const float a = 1, b = 1 + 64 * std::numeric_limits<float>::epsilon();
        for (const float t : {1.25f, 2.f, 16.f})
            CHECK(relativeLuneError(a, b, (b - a) * t) < 1e-5);
    }
    SECTION("a Moon smaller than the Sun")
    {
        // The lune becomes a ring: the same law from the other side of internal contact.
        CHECK(visibleFraction(Discs<double>{1, 0.9, 0.1}) == Approx(1 - 0.81).epsilon(1e-12));
        CHECK(visibleFraction(Discs<double>{1, 0.9, 0.1000001}) == Approx(1 - 0.81).epsilon(1e-9));
        CHECK(visibleFraction(Discs<double>{1, 0.5, 1}) == Approx(1 - 0.25 * 0.4598).epsilon(1e-2));
    }
}

TEST_CASE("eclipse: the middle of what is left of the Sun against strips of the disc")
{
    // Strips across the line through both centres; of each the Moon hides what is within its own chord.
    const auto middle = [](double a, double b, double d) {
        double left = 0, moment = 0;
        constexpr int strips = 200000;
        for (int i = 0; i < strips; ++i) {
            const double x = a * (2 * (i + 0.5) / strips - 1), fromMoon = x + d; // the Moon stands at -d
            const double sun = std::sqrt(a * a - x * x), moon = std::sqrt(std::max(0., b * b - fromMoon * fromMoon));
            left += std::max(0., sun - moon);
            moment += x * std::max(0., sun - moon);
        }
        return moment / left;
    };
    for (const double b : {0.3, 0.95, 1.0, 1.05, 2.})
        for (const double t : {0.02, 0.1, 0.5, 0.9, 0.99}) {
            const double nearest = std::max(0., b - 1), d = nearest + t * (1 + b - nearest);
            CAPTURE(b, d);
            CHECK(middleOfVisible(Discs<double>{1, b, d}) == Approx(middle(1, b, d)).epsilon(1e-4).margin(1e-9));
        }
    CHECK(middleOfVisible(Discs<double>{1, 1.05, 0.05 + 1e-6}) == Approx(1).epsilon(0.01)); // a thin lune is at the limb
    CHECK(middleOfVisible(Discs<double>{1, 1.05, 0.04}) == 0);
    CHECK(middleOfVisible(Discs<double>{1, 1.05, 2.05}) == 0);
    CHECK(middleOfVisible(Discs<double>{1, 0.9, 0}) == 0);
}

TEST_CASE("eclipse: hidden and left add up to one, both monotone between exact contacts")
{
    const auto sweep = [](auto a, auto b) {
        using Real = decltype(a);
        const Real rounding = 4 * std::numeric_limits<Real>::epsilon();
        Real before = -1;
        for (int i = 0; i <= 20000; ++i) {
            const Discs<Real> discs{a, b, Real(i) / 20000 * (a + b) * Real(1.02)};
            const Real left = visibleFraction(discs), hidden = coveredFraction(discs);
            REQUIRE(left >= before - rounding);
            REQUIRE(std::abs(left + hidden - 1) <= rounding);
            REQUIRE((left >= 0 && left <= 1 && hidden >= 0 && hidden <= 1));
            before = left;
        }
        CHECK(visibleFraction(Discs<Real>{a, b, a + b}) == Real(1));
        CHECK(coveredFraction(Discs<Real>{a, b, a + b}) == Real(0));
        if (b >= a)
            CHECK(visibleFraction(Discs<Real>{a, b, b - a}) == Real(0));
        else
            CHECK(visibleFraction(Discs<Real>{a, b, 0}) == Approx(double((a - b) * (a + b) / a / a)));
    };
    for (const double ratio : {0.94, 1 - 1e-6, 1., 1 + 1e-6, 1.03, 1.08, 12.}) {
        CAPTURE(ratio);
        sweep(4.65e-3, 4.65e-3 * ratio);
        sweep(4.65e-3f, 4.65e-3f * static_cast<float>(ratio));
    }
}

TEST_CASE("eclipse: first contact is no step")
{
    // Next to outside contact the hidden share grows with the power 3/2 of the overlap.
    const double a = 4.65e-3, b = 4.8e-3;
    const auto hidden = [&](double overlap) { return coveredFraction(Discs<double>{a, b, a + b - overlap}); };
    CHECK(hidden(1e-9) / hidden(1e-10) == Approx(std::pow(10, 1.5)).epsilon(1e-5));
    CHECK(hidden(1e-12) > 0);
    CHECK(hidden(1e-12) < 1e-13);
}

TEST_CASE("eclipse: places and angles of both discs from any point of the air")
{
    const auto bodies = sampleEclipse(0.003);
    const Shadow shadow = makeShadow(bodies);
    const auto sun = placeOfBody(bodies.planet, 0, bodies.sunDirection, bodies.sunDistance);
    const auto moon = placeOfBody(bodies.planet, 0, bodies.moonDirection, bodies.moonDistance);
    CHECK(std::hypot(moon[0], moon[1], moon[2] + 6371e3) == Approx(371925e3).epsilon(1e-14));
    const auto single = singlePrecision(shadow);
    for (const std::array<double, 3>& p : {std::array{0., 0., 0.}, {3e5, -2e5, 5e4}, {-1.1e6, 4e5, -3e4}, {0., 1.2e6, 1e5}}) {
        std::array<long double, 3> toSun{}, toMoon{};
        long double sunSquare = 0, moonSquare = 0, product = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            toSun[i] = static_cast<long double>(sun[i]) - static_cast<long double>(p[i]);
            toMoon[i] = static_cast<long double>(moon[i]) - static_cast<long double>(p[i]);
            sunSquare += toSun[i] * toSun[i];
            moonSquare += toMoon[i] * toMoon[i];
            product += toSun[i] * toMoon[i];
        }
        const auto cross = std::sqrt(std::max(0.L, sunSquare * moonSquare - product * product));
        const double separation = static_cast<double>(std::atan2(cross, product));
        const auto discs = shadow.discs(p);
        CAPTURE(p[0], p[1], p[2]);
        CHECK(discs.separation == Approx(separation).epsilon(1e-8));
        CHECK(discs.moonRadius == Approx(std::asin(1737.4e3 / static_cast<double>(std::sqrt(moonSquare)))).epsilon(1e-12));
        CHECK(discs.sunRadius == Approx(bodies.sunAngularRadius).epsilon(1e-5));
        const std::array<float, 3> q{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
        // A metre of the shadow's place is 3e-9 rad.
        CHECK(std::abs(double(single.discs(q).separation) - discs.separation) < 3e-9);
    }
    CHECK(shadow.discs({0, 0, 0}).separation == Approx(0.003).epsilon(1e-10));
    CHECK(shadow.discs({0, 0, 0}).sunRadius == Approx(bodies.sunAngularRadius).epsilon(1e-12));
}

TEST_CASE("eclipse: single precision keeps the light of every point of the air")
{
    // Distances that give the camera a totality of some hundred metres: a two-second one.
    for (const double moonDistance : {371925e3, 380160e3, 400000e3}) {
        const Shadow shadow = makeShadow(sampleEclipse(2e-6, moonDistance));
        const auto single = singlePrecision(shadow);
        double worst = 0;
        for (int i = 0; i < 4000; ++i) {
            // Along the Moon's path and up through the air, finest next to the camera.
            const double x = 4e6 * std::pow((i - 2000) / 2000., 5), z = (i % 13) * 8e3;
            const double exact = shadow.visible({0.3 * x, x, z});
            const float rounded = single.visible({static_cast<float>(0.3 * x), static_cast<float>(x), static_cast<float>(z)});
            worst = std::max(worst, std::abs(double(rounded) - exact));
        }
        CAPTURE(moonDistance);
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("eclipse: 21 August 2017, elements and sizes as published")
{
    const auto bodies = greatestEclipse2017(0.272281);
    const Shadow shadow = makeShadow(bodies);
    const double centre = shadow.depthOf({0, 0, -equatorialRadius});
    // Besselian elements l1, l2 at greatest eclipse, 0.4445 h after their epoch, in Earth radii; the sum of all
    // rounding in the published parallax and semi-diameter is 0.15 km.
    const double t = 0.4445, l1 = 0.542093 + 0.0001241 * t - 0.0000118 * t * t, l2 = -0.004025 + 0.0001234 * t - 0.0000117 * t * t;
    CHECK(shadow.umbraRadius(centre) == Approx(-l2 * equatorialRadius).margin(150));
    CHECK(makeShadow(greatestEclipse2017(0.272488)).penumbraRadius(centre) == Approx(l1 * equatorialRadius).margin(300));

    const GroundShadow ground = groundShadow(shadow, bodies);
    REQUIRE(ground.central);
    CHECK(ground.sunElevation * 180 / pi == Approx(63.9).margin(0.01));
    CHECK(std::hypot(ground.place[0], ground.place[1], ground.place[2]) < 1);
    // The path is 114.7 km wide; a shadow that moves aslant covers something between its own short and long diameter.
    CHECK(2 * ground.umbraRadius < 114.7e3);
    CHECK(2 * ground.umbraRadius / std::sin(ground.sunElevation) > 114.7e3);
    // Magnitude of a central eclipse: the ratio of the diameters.
    const auto discs = shadow.discs({0, 0, 0});
    CHECK(discs.moonRadius / discs.sunRadius == Approx(1.0306).margin(1e-4));
}

TEST_CASE("eclipse: umbra and penumbra on the ground are where the light ends and begins")
{
    // The sample descriptions' distances, 371925 km and 1.01208 AU. Both cones by hand: tangents of two spheres.
    const auto bodies = sampleEclipse(0);
    const Shadow shadow = makeShadow(bodies);
    const GroundShadow ground = groundShadow(shadow, bodies);
    REQUIRE(ground.central);
    const auto moon = placeOfBody(bodies.planet, 0, bodies.moonDirection, bodies.moonDistance);
    const auto sun = placeOfBody(bodies.planet, 0, bodies.sunDirection, bodies.sunDistance);
    const double toMoon = std::hypot(moon[0], moon[1], moon[2]), toSun = std::hypot(sun[0], sun[1], sun[2]);
    const double solar = toSun * std::sin(bodies.sunAngularRadius), lunar = bodies.moonRadius;
    const double inner = std::asin((solar - lunar) / (toSun - toMoon)), outer = std::asin((solar + lunar) / (toSun - toMoon));
    CHECK(ground.umbraRadius == Approx((lunar / std::sin(inner) - toMoon) * std::tan(inner)).epsilon(1e-9));
    CHECK(ground.penumbraRadius == Approx((lunar / std::sin(outer) + toMoon) * std::tan(outer)).epsilon(1e-9));
    CHECK(ground.umbraRadius == Approx(50e3).margin(5e3));
    CHECK(ground.penumbraRadius == Approx(3500e3).margin(100e3));

    const auto visible = [&](double far) {
        return shadow.visible({far * shadow.across[0][0], far * shadow.across[0][1], far * shadow.across[0][2]});
    };
    CHECK(visible(ground.umbraRadius - 1) == 0);
    CHECK(visible(ground.umbraRadius + 1) > 0);
    CHECK(visible(ground.penumbraRadius - 1) < 1);
    CHECK(visible(ground.penumbraRadius + 1) == 1);
}

TEST_CASE("eclipse: light at a place is continuous and symmetric in time, through every contact")
{
    for (const double moonDistance : {371925e3, 380160e3, 400000e3}) { // total, barely total, annular
        CAPTURE(moonDistance);
        const auto at = [&](double offset) { return makeShadow(sampleEclipse(offset, moonDistance)).visible({0, 0, 0}); };
        const int steps = 8000;
        double before = 1;
        for (int i = 0; i <= steps; ++i) {
            const double offset = 0.0105 * (2. * i / steps - 1), now = at(offset);
            CHECK(now == Approx(at(-offset)).margin(1e-12));
            // The Moon's limb sweeps at most its chord: 2 a per (pi a^2).
            REQUIRE(std::abs(now - before) < 0.0105 * 2 / steps * 2 / (pi * 4.5e-3) * 1.1);
            before = now;
        }
        CHECK(at(0.0105) == 1);
        CHECK((moonDistance > 390e6) == (at(0) > 0));
    }
}

TEST_CASE("eclipse: a Moon that can't be there is refused with a sentence")
{
    auto bodies = sampleEclipse(0);
    bodies.moonDistance = 6371e3 + 500e3;
    CHECK_THROWS_WITH(makeShadow(bodies), Contains("touches neither the air nor the camera"));
    bodies = sampleEclipse(0);
    bodies.moonDistance = 2 * bodies.sunDistance;
    CHECK_THROWS_WITH(makeShadow(bodies), Contains("less than the Sun's distance"));
    bodies = sampleEclipse(0);
    bodies.moonRadius = 0;
    CHECK_THROWS_WITH(makeShadow(bodies), Contains("radius of the Moon"));
    // A Sun as far as the language allows still has a finite shadow, in single precision too.
    bodies = sampleEclipse(0);
    bodies.sunDistance = 1e20 * astronomicalUnit;
    CHECK(singlePrecision(makeShadow(bodies)).visible({0, 0, 0}) == 0.f);
}

TEST_CASE("eclipse: a Moon behind the point hides nothing")
{
    auto bodies = sampleEclipse(0);
    bodies.moonDirection = {-bodies.sunDirection[0], 0, -bodies.sunDirection[2]};
    CHECK(makeShadow(bodies).visible({0, 0, 0}) == 1);
}
