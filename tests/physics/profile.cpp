#include "physics/profile.hpp"
#include "media.hpp"
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

using namespace sky::physics;
using sky::test::withDensity;

namespace {

Medium base() { return sky::test::layer(1, 1, 0, sky::test::isotropicPhase); }

double density(const Profile& profile, double altitude)
{
    double n = -1;
    profile.densities(profile.intervalAt(altitude), altitude, &n);
    return n;
}

} // namespace

TEST_CASE("profile: exponential air needs two shells, however finely it is tabulated")
{
    std::vector<double> h, n;
    for (int i = 0; i <= 3000; ++i) {
        h.push_back(40. * i);
        n.push_back(3e25 * std::exp(-h.back() / 8e3));
    }
    const Profile profile(withDensity(base(), h, n));
    CHECK(profile.shells() == std::vector<double>{0, 120e3});
    for (const double altitude : {0., 1., 7777., 60e3, 119999., 120e3})
        CHECK(density(profile, altitude) == Approx(3e25 * std::exp(-altitude / 8e3)).epsilon(1e-12)); // rounding of ln n
    CHECK(profile.steepness(0) == Approx(1 / 8e3));
}

TEST_CASE("profile: a layer that fades to nothing needs few shells")
{
    // A parabola, tabulated as finely as the medium's tables are near its feet: steps in proportion to what is left.
    std::vector<double> h{0}, n{0};
    const double centre = 50e3, width = 20e3;
    for (double left = 1e-8; left < 1; left *= 1.01) {
        h.push_back(centre - width * (1 - left));
        n.push_back(left * (2 - left));
    }
    for (std::size_t i = h.size() - 1; i > 0; --i) {
        h.push_back(2 * centre - h[i]);
        n.push_back(n[i]);
    }
    h.insert(h.end(), 120e3);
    n.push_back(0);
    h.insert(h.begin() + 1, centre - width);
    n.insert(n.begin() + 1, 0);
    h.insert(h.end() - 1, centre + width);
    n.insert(n.end() - 1, 0);
    const Profile profile(withDensity(base(), h, n));
    CHECK(profile.shells().size() < 150); // chords of the logarithm alone: 502
    double column = 0;
    for (std::size_t k = 0; k + 1 < h.size(); ++k) {
        const double middle = 0.5 * (h[k] + h[k + 1]), truth = std::max(0., 1 - std::pow((middle - centre) / width, 2));
        CHECK(std::abs(density(profile, middle) - truth) < 4e-4 * truth + 3e-8); // 3e-4, the table's own steps, and a share of 1e-7
        column += density(profile, middle) * (h[k + 1] - h[k]);
    }
    CHECK(column == Approx(width * 4 / 3).epsilon(1e-3));
}

TEST_CASE("profile: a smooth curve is followed within the tolerance by few shells")
{
    std::vector<double> h, n;
    for (int i = 0; i <= 4000; ++i) {
        h.push_back(25. * i);
        n.push_back(std::exp(-std::pow((h.back() - 25e3) / 15e3, 2)));
    }
    const double tolerance = 1e-3;
    const Profile profile(withDensity(base(), h, n), tolerance);
    // Chords of ln n, a parabola of curvature 2 / 15 km^2: 1e-3 allows chords of 1.3 km.
    CHECK(profile.shells().size() < 120);
    // Nodes fit to the tolerance, what lies between them a little less; below 1e-7 of the mean density nothing matters.
    for (double altitude = 3; altitude < 80e3; altitude += 123.4)
        CHECK(density(profile, altitude) == Approx(std::exp(-std::pow((altitude - 25e3) / 15e3, 2))).epsilon(1.5 * tolerance).margin(1e-7));
    CHECK(profile.shells().front() == 0);
    CHECK(profile.shells().back() == h.back());
}

TEST_CASE("profile: step edges of a cloud stay where they are")
{
    const double edge = 1e-3;
    const Profile profile(withDensity(base(), {0, 1000, 1000 + edge, 2000, 2000 + edge, 9000}, {0, 0, 5, 5, 0, 0}));
    CHECK(density(profile, 999.999) == 0);
    CHECK(density(profile, 1000 + 2 * edge) == Approx(5));
    CHECK(density(profile, 1999.99) == Approx(5));
    CHECK(density(profile, 2000 + 2 * edge) == Approx(0).margin(1e-12));
    CHECK(density(profile, 1000 + 0.5 * edge) == Approx(2.5).epsilon(1e-4)); // linear to a zero; 1e3 / 1e-3 digits lost
    for (const double shell : {1000., 1000 + edge, 2000., 2000 + edge})
        CHECK(std::find(profile.shells().begin(), profile.shells().end(), shell) != profile.shells().end());
}

TEST_CASE("profile: thin ozone-like pieces, linear down to zero, and emptiness")
{
    const Profile profile(withDensity(base(), {0, 10e3, 20e3, 30e3, 80e3}, {0, 0, 1, 0, 0}));
    CHECK(density(profile, 5e3) == 0);
    CHECK(density(profile, 12e3) == Approx(0.2));
    CHECK(density(profile, 27e3) == Approx(0.3));
    CHECK(density(profile, 50e3) == 0);

    const Profile empty(withDensity(base(), {0, 10e3, 80e3}, {0, 0, 0}));
    for (const double altitude : {0., 10e3, 80e3})
        CHECK(density(empty, altitude) == 0);
    CHECK(empty.steepness(0) == 0);
}

TEST_CASE("profile: every altitude has its interval, the ends included")
{
    const Profile profile(withDensity(base(), {0, 10, 30, 60}, {1, 5, 2, 7}));
    REQUIRE(profile.shells() == std::vector<double>{0, 10, 30, 60});
    CHECK(profile.intervalAt(0) == 0);
    CHECK(profile.intervalAt(9.999) == 0);
    CHECK(profile.intervalAt(10) == 1);
    CHECK(profile.intervalAt(59) == 2);
    CHECK(profile.intervalAt(60) == 2);
    CHECK(profile.intervalAt(-1) == 0);  // rounding below the ground
    CHECK(profile.intervalAt(100) == 2); // and above the top
}

TEST_CASE("profile: under an upper edge shells halve the way to it, as far as a low Sun shines")
{
    // Extinction of one per metre: a disc of 0.01 rad shines through 0.3 of it along a way of 3 mm, nine halvings below a metre.
    Medium medium = withDensity(base(), {0, 400, 400.0001, 500, 500.0001, 1000}, {0, 0, 1, 1, 0, 0});
    medium.species[0].extinctionCrossSection = {1};
    medium.sunAngularRadius = 0.01;
    const Profile profile(medium), finer = profile.withShellsUnderEdges();
    CHECK(finer.shells().size() == profile.shells().size() + 10);
    double halvings = 0;
    for (int k = 0; k + 1 < static_cast<int>(finer.shells().size()); ++k) {
        halvings += finer.halvings(k);
        CHECK((finer.halvings(k) > 0) == (finer.shells()[k] > 499 && finer.shells()[k] < 500)); // what is left counts as one
    }
    for (const double altitude : {200., 400.00005, 450., 499.9, 499.9999, 500.00005, 700.})
        CHECK(density(finer, altitude) == Approx(density(profile, altitude)).epsilon(1e-9).margin(1e-12));
    CHECK(halvings == Approx(10));
    // A point shines along the horizontal: so thin is the skin that it lights.
    medium.sunAngularRadius = 0;
    CHECK(Profile(medium).withShellsUnderEdges().shells().size() > finer.shells().size());
}

TEST_CASE("profile: shells under two edges that fall together are one")
{
    // 750 m is a quarter of the way below the top, and a sixteenth below 800 m.
    Medium medium = withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), {0, 799.9999, 800, 1000}, {1, 1, 0.4, 0.4});
    medium.species[0].extinctionCrossSection = {1e-3};
    const Profile finer = Profile(medium).withShellsUnderEdges();
    const auto& shells = finer.shells();
    CHECK(shells.size() > 30);
    CHECK(std::count(shells.begin(), shells.end(), 750.) == 1);
    CHECK(std::adjacent_find(shells.begin(), shells.end(), std::greater_equal<>()) == shells.end());
}

TEST_CASE("profile: air that thins out has no edge, nor has a layer in other air")
{
    for (const auto& medium : {sky::test::exponentialAir(0.5), sky::test::haze(1.25), sky::test::sampleEarth(sky::test::Aerosol::Yes)}) {
        const Profile profile(medium);
        CHECK(profile.withShellsUnderEdges().shells() == profile.shells());
    }
}

TEST_CASE("profile: the optical depth of a shell of many scale heights is that of its parts together")
{
    // One shell of 14 scale heights; and one in which the density itself is straight.
    const Profile exponential(sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), {0, 28e3}, {1, std::exp(-14.)}));
    const Profile linear(sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase), {0, 28e3}, {1, 0}));
    REQUIRE(exponential.shells().size() == 2);
    for (const double h : {1., 500., 4e3, 17e3, 28e3}) {
        CHECK(depthInShell(exponential, {3}, 0, 0, h) == Approx(3 * 2e3 * -std::expm1(-h / 2e3)).epsilon(1e-9));
        CHECK(depthInShell(linear, {3}, 0, 0, h) == Approx(3 * h * (1 - 0.5 * h / 28e3)).epsilon(1e-9));
    }
}

TEST_CASE("profile: sunlight needs more nodes only where air has edges inside that no Sun blurs")
{
    const double small = 0.00465;
    const auto edge = [](double top) {
        return withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase, 6.4e6), {0, top, top * 1.000001, 120e3},
                           {1, 1, 0, 0});
    };
    CHECK(Profile(edge(2e3)).forShadows(100, 0) == 300);
    CHECK(Profile(edge(2e3)).forShadows(100, small) == 100);
    CHECK(Profile(edge(60e3)).forShadows(100, 0.5 * small) == Approx(100 * std::sqrt(2 * 60e3 / 6.4e6) / (20 * small)).epsilon(0.02));
    CHECK(Profile(withDensity(base(), {0, 1000}, {1, 1})).forShadows(100, 0) == 100); // the top is no shadow's edge
    CHECK(Profile(sky::test::exponentialAir(0.3)).forShadows(100, 0) == 100);
}
