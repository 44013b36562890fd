#include "physics/geometry.hpp"
#include <catch2/catch.hpp>
#include <cfloat>
#include <limits>
#include <vector>

// The formulas as they stand in a textbook, with digits enough for them: 113 bits.
#if LDBL_MANT_DIG >= 113
using Quad = long double;
#elif defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;
#else
#error "The truth of these tests needs a type of 113 bits."
#endif

using namespace sky::physics;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Two Newton steps from 64 (or 53) bits: all of 113.
Quad squareRoot(Quad x)
{
    if (!(x > 0))
        return 0;
    Quad y = static_cast<Quad>(std::sqrt(static_cast<long double>(x)));
    for (int i = 0; i < 2; ++i)
        y = (y + x / y) / 2;
    return y;
}

struct Start {
    Planet planet;
    double altitude, mu;
    Quad r() const { return Quad(planet.radius) + Quad(altitude); }
    Quad b() const { return r() * Quad(mu); }
    /// b^2 + shell^2 - r^2: positive where the ray's line meets the shell.
    Quad discriminant(double shell) const
    {
        const Quad s = Quad(planet.radius) + Quad(shell);
        return b() * b() + (Quad(shell) - Quad(altitude)) * (s + r());
    }
    bool hits() const { return mu < 0 && discriminant(0) > 0; }
};

std::vector<Planet> planets()
{
    std::vector<Planet> all;
    for (const double radius : {1e5, 6.371e6, 7e7, 1e10})
        for (const double top : {1., 1e3, 1.2e5, 1e6})
            all.push_back({radius, top});
    return all;
}

std::vector<double> altitudes(const Planet& p)
{
    std::vector<double> all;
    for (const double h : {0., std::numeric_limits<double>::min(), 1e-4, 1e-2, 1.7, 100., 0.5 * p.topOfAtmosphere,
                           std::nextafter(p.topOfAtmosphere, 0.), p.topOfAtmosphere})
        if (h <= p.topOfAtmosphere)
            all.push_back(h);
    return all;
}

/// Zenith, nadir, horizontal, and both sides of the horizon down to neighbouring doubles.
std::vector<Start> starts()
{
    std::vector<Start> all;
    for (const Planet& p : planets())
        for (const double h : altitudes(p)) {
            const double horizon = horizonMu(p, h);
            for (const double mu : {-1., std::nextafter(-1., 0.), -0.5, -1e-3, -1e-9, 0., 1e-300, 1e-9, 1e-3, 0.5, std::nextafter(1., 0.),
                                    1., horizon, std::nextafter(horizon, -2.), std::nextafter(horizon, 1.), horizon * (1 + 1e-12),
                                    horizon * (1 - 1e-12), horizon - 1e-6, horizon + 1e-6})
                if (mu >= -1)
                    all.push_back({p, h, mu});
        }
    return all;
}

double relative(double value, Quad truth)
{
    const Quad difference = Quad(value) - truth, whole = truth != 0 ? truth : Quad(1);
    return std::abs(static_cast<double>(difference / whole));
}

} // namespace

TEST_CASE("geometry: distance to the top keeps all digits, from the ground to one ulp below the top")
{
    double worst = 0;
    for (const Start& s : starts()) {
        const Quad root = squareRoot(s.discriminant(s.planet.topOfAtmosphere)), truth = root - s.b();
        const double value = distanceToTop(s.planet, s.altitude, s.mu);
        INFO("R " << s.planet.radius << " H " << s.planet.topOfAtmosphere << " h " << s.altitude << " mu " << s.mu);
        if (truth < Quad(1e-290)) { // the start is the end
            CHECK(value <= 1e-280);
            continue;
        }
        worst = std::max(worst, relative(value, truth));
        // A dozen operations, none of which cancels; r = R + h itself is rounded.
        REQUIRE(relative(value, truth) < 8 * epsilon);
    }
    CAPTURE(worst);
    CHECK(worst > 0); // the truth is no copy of the formula
}

TEST_CASE("geometry: distance to the ground, grazing rays included")
{
    int tested = 0;
    for (const Start& s : starts()) {
        if (!hitsGround(s.planet, s.altitude, s.mu) || !s.hits())
            continue;
        const Quad root = squareRoot(s.discriminant(0)), truth = -s.b() - root;
        // The square of the root is a difference: its rounding is that of b^2, and the root of that where the ray grazes.
        const double b = static_cast<double>(s.b()), exactRoot = static_cast<double>(root), rounding = 4 * epsilon * b * b;
        const double rootError = std::min(exactRoot > 0 ? rounding / exactRoot : 1e300, std::sqrt(rounding));
        INFO("R " << s.planet.radius << " h " << s.altitude << " mu " << s.mu);
        REQUIRE(relative(distanceToGround(s.planet, s.altitude, s.mu), truth) < 8 * epsilon + rootError / (exactRoot + std::abs(b)));
        ++tested;
    }
    CHECK(tested > 500);
}

TEST_CASE("geometry: the distance to the horizon and back, to all digits")
{
    for (const Planet& p : planets())
        for (const double h : altitudes(p)) {
            INFO("R " << p.radius << " h " << h);
            const double distance = horizonDistance(p, h);
            if (h > 0 && h < 1e-290)
                continue;
            CHECK(relative(distance, squareRoot(Quad(h) * (2 * Quad(p.radius) + Quad(h)))) < 2 * epsilon);
            const Quad square = Quad(distance) * Quad(distance), root = squareRoot(Quad(p.radius) * Quad(p.radius) + square);
            CHECK(relative(altitudeOfHorizon(p, distance), square / (root + Quad(p.radius))) < 4 * epsilon);
            CHECK(altitudeOfHorizon(p, distance) == Approx(h).epsilon(8 * epsilon));
        }
    CHECK(horizonDistance({6.4e6, 1e5}, -1) == 0);
}

TEST_CASE("geometry: altitude along a ray")
{
    for (const Start& s : starts()) {
        const bool ground = hitsGround(s.planet, s.altitude, s.mu);
        const double length = ground ? distanceToGround(s.planet, s.altitude, s.mu) : distanceToTop(s.planet, s.altitude, s.mu);
        for (const double x : {0., 1e-12, 1e-4, 0.3, 0.5, 0.999, 1.}) {
            const double d = x * length, r = s.planet.radius + s.altitude;
            const Quad R = s.planet.radius, along = squareRoot(s.r() * s.r() + Quad(d) * (Quad(d) + 2 * s.b()));
            const double truth = std::max(0., static_cast<double>(along - R));
            // Terms that may cancel, over the sum of the radii: metres, far below the size of an atom in most cases.
            const double terms = s.altitude * (s.altitude + 2 * s.planet.radius) + d * (d + 2 * r * std::abs(s.mu));
            INFO("R " << s.planet.radius << " H " << s.planet.topOfAtmosphere << " h " << s.altitude << " mu " << s.mu << " s " << d);
            REQUIRE(std::abs(altitudeAlong(s.planet, s.altitude, s.mu, d) - truth) <=
                    4 * epsilon * (terms / (2 * s.planet.radius) + truth) + 1e-33 * s.planet.radius); // the truth's
        }
    }
}

TEST_CASE("geometry: rays end on the shell they were asked about")
{
    for (const Start& s : starts()) {
        const double top = s.planet.topOfAtmosphere;
        for (const double shell : {0., 0.3 * top, s.altitude, top}) {
            const Quad discriminant = s.discriminant(shell);
            for (const bool first : {true, false}) {
                const double d = distanceToShell(s.planet, s.altitude, s.mu, shell, first);
                const double b = std::abs(static_cast<double>(s.b())), size = b * b + std::abs(static_cast<double>(discriminant));
                INFO("R " << s.planet.radius << " h " << s.altitude << " mu " << s.mu << " shell " << shell << " first " << first);
                if (std::abs(static_cast<double>(discriminant)) <= 16 * epsilon * size)
                    continue; // grazing: either answer is right
                if (discriminant < 0) {
                    REQUIRE(d < 0);
                    continue;
                }
                const Quad root = squareRoot(discriminant), truth = first ? -s.b() - root : root - s.b();
                // Both terms of the discriminant, and the difference of b and the root where no conjugate helps.
                const double error = 8 * epsilon * size / static_cast<double>(root) + 4 * epsilon * b;
                REQUIRE(std::abs(static_cast<double>(Quad(d) - truth)) <= error);
            }
        }
    }
}

TEST_CASE("geometry: the horizon parts the rays that hit the ground from those that miss")
{
    for (const Planet& p : planets())
        for (const double h : altitudes(p)) {
            INFO("R " << p.radius << " h " << h);
            const double horizon = horizonMu(p, h);
            CHECK_FALSE(hitsGround(p, h, horizon));
            CHECK(hitsGround(p, h, std::nextafter(horizon, -2.)));
            CHECK(hitsGround(p, h, -1) == (horizon > -1));
            CHECK_FALSE(hitsGround(p, h, 1));
            // A few roundings away from it on either side the exact line meets the ground, or misses it.
            if (h > 1e-300) {
                CHECK(Start{p, h, horizon * (1 + 8 * epsilon)}.discriminant(0) > 0);
                CHECK(Start{p, h, horizon * (1 - 8 * epsilon)}.discriminant(0) < 0);
            } else {
                CHECK(horizon <= 0);
                CHECK(horizon > -1e-140);
            }
            CHECK(std::sin(horizonElevation(p, h)) == Approx(horizon).epsilon(4 * epsilon).margin(1e-300));
        }
    // Closed form: from twice the radius the planet covers 30 degrees about the nadir.
    CHECK(horizonElevation({1e6, 1e6}, 1e6) == Approx(-std::acos(0.5)).epsilon(1e-15));
    CHECK(horizonMu({1e6, 1e6}, 1e6) == Approx(-std::sqrt(0.75)).epsilon(1e-15));
}

TEST_CASE("geometry: the sphere forgets units: all lengths scale together")
{
    const Planet p{6.371e6, 1.2e5};
    for (const double scale : {1e-3, 0.37, 1e3})
        for (const double h : {0., 1e-4, 1.7, 1.2e4, 1.2e5})
            for (const double mu : {-1., -0.6, -0.3, 0., 0.2, 1.}) {
                const Planet q{p.radius * scale, p.topOfAtmosphere * scale};
                INFO("scale " << scale << " h " << h << " mu " << mu);
                // Rounding of the scaled inputs, enlarged up to b^2 / root^2 < 10 at these angles.
                const double bound = 100 * epsilon;
                CHECK(hitsGround(p, h, mu) == hitsGround(q, h * scale, mu));
                if (hitsGround(p, h, mu))
                    CHECK(distanceToGround(q, h * scale, mu) == Approx(scale * distanceToGround(p, h, mu)).epsilon(bound));
                else if (h < p.topOfAtmosphere)
                    CHECK(distanceToTop(q, h * scale, mu) == Approx(scale * distanceToTop(p, h, mu)).epsilon(bound));
                CHECK(horizonMu(q, h * scale) == Approx(horizonMu(p, h)).epsilon(bound));
                CHECK(altitudeAlong(q, h * scale, 0.2, 5e4 * scale) == Approx(scale * altitudeAlong(p, h, 0.2, 5e4)).epsilon(bound));
            }
}

TEST_CASE("visible part of the disc: half at the edge, whole and none a radius away, segments in closed form")
{
    const double pi = 3.14159265358979323846;
    for (const double radius : {1e-9, 0.00465, 0.1, 1.}) {
        CHECK(visibleDiscFraction(0, radius) == 0.5);
        CHECK(visibleDiscFraction(radius, radius) == 1);
        CHECK(visibleDiscFraction(-radius, radius) == 0);
        // Half a radius: a sector of 240 degrees and a triangle.
        CHECK(visibleDiscFraction(0.5 * radius, radius) == Approx(2. / 3 + std::sqrt(3.) / (4 * pi)).epsilon(1e-14));
        double before = 0;
        for (int i = -1000; i <= 1000; ++i) {
            const double x = radius * i / 1000, share = visibleDiscFraction(x, radius);
            CHECK(share >= before);
            CHECK(share + visibleDiscFraction(-x, radius) == Approx(1).epsilon(1e-15));
            before = share;
        }
        // A thin lune: area (4/3) sqrt(2) eps^1.5 of the unit circle.
        const double lune = 1e-6;
        CHECK(visibleDiscFraction((-1 + lune) * radius, radius) == Approx(4. / 3 * std::sqrt(2.) * std::pow(lune, 1.5) / pi).epsilon(1e-5));
    }
    CHECK(visibleDiscFraction(-1e-300, 0) == 0);
    CHECK(visibleDiscFraction(1e-300, 0) == 1);
}
