#include "physics/moments.hpp"
#include "media.hpp"
#include "physics/directions.hpp"
#include "physics/optics.hpp"
#include <algorithm>
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::pi;

namespace {

const Planet earth{6.371e6, 120e3};
const std::vector<double> unevenLevels{0, 1, 30, 800, 801, 5e3, 30e3, 120e3};

/// Neighbouring intervals differ by less than a factor of four in sqrt(r^2 - R^2): none counts as an edge.
const std::vector<double> gentleLevels{0, 20, 120, 500, 1200, 4e3, 20e3, 120e3};

double measure(double altitude) { return horizonDistance(earth, altitude); }

template<typename Function>
double through(const Stencil& stencil, Function f)
{
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        if (stencil.weight[i] != 0)
            sum += stencil.weight[i] * f(stencil.index[i]);
    return sum;
}

} // namespace

TEST_CASE("stencils over altitude: partition of unity, straight lines kept, levels met")
{
    const MomentGrid grid(earth, unevenLevels, -0.3, 16);
    const auto line = [&](int k) { return 3 - 2e-5 * measure(grid.altitudes()[k]); };
    for (const double h : {0., 1e-6, 0.5, 1., 17., 800., 800.5, 801., 4e3, 77e3, 119.99e3, 120e3}) {
        const Stencil s = grid.altitudeStencil(h);
        INFO("h " << h);
        CHECK(through(s, [](int) { return 1.; }) == Approx(1).epsilon(1e-13));
        CHECK(through(s, line) == Approx(3 - 2e-5 * measure(h)).epsilon(1e-12));
    }
    for (int k = 0; k < grid.altitudeCount(); ++k) {
        const Stencil s = grid.altitudeStencil(grid.altitudes()[k]);
        CHECK(through(s, [&](int i) { return i == k ? 1. : 0.; }) == Approx(1).epsilon(1e-9)); // measure rounds
    }
    // Beyond the ends the end holds.
    CHECK(through(grid.altitudeStencil(130e3), line) == Approx(line(7)));
}

TEST_CASE("stencils over altitude: a parabola is kept between levels that have two neighbours")
{
    const MomentGrid grid(earth, gentleLevels, -0.3, 16);
    const auto parabola = [&](int k) { return std::pow(measure(grid.altitudes()[k]) / 1e5 - 3, 2); };
    for (const double h : {50., 400., 800.2, 3e3, 15e3})
        CHECK(through(grid.altitudeStencil(h), parabola) == Approx(std::pow(measure(h) / 1e5 - 3, 2)).epsilon(1e-11));
}

TEST_CASE("stencils over altitude: a jump between two close levels does not throw the next interval far")
{
    // At a layer's edge two levels stand close together and the field bends; a slope taken across them would be enormous.
    const MomentGrid grid(earth, {0, 1000, 1001, 2000, 2001, 120e3}, -0.3, 16);
    const double values[6] = {0, 0, 1, 1, 0, 0};
    for (double h = 0; h <= 120e3; h += 37) {
        const double value = through(grid.altitudeStencil(h), [&](int k) { return values[k]; });
        INFO("h " << h);
        CHECK(value >= -1e-9);
        CHECK(value <= 1 + 1e-9);
    }
}

TEST_CASE("light between levels: a cubic of its logarithm, but of a level in darkness beside it nothing comes back brighter")
{
    const MomentGrid grid(earth, {0, 2e3, 2.5e3, 4e3, 6e3, 9e3}, -0.3, 16); // next to a level as uneven as it may be
    const auto at = [&](const Stencil& s, const std::vector<double>& logs) {
        return logarithmBetween(s)(logs[s.index[0]], logs[s.index[1]], logs[s.index[2]], logs[s.index[3]]);
    };
    const std::vector<double> gentle{-1, -1.5, -1.6, -2.5, -2.2, -1.4};
    for (double h = 0; h <= 9e3; h += 123) {
        const Stencil s = grid.altitudeStencil(h);
        CHECK(at(s, gentle) == Approx(through(s, [&](int k) { return gentle[k]; })).epsilon(1e-12));
    }
    // e^0.3: what two levels two e-foldings deeper lift the middle of two that are even. A cubic has up to e^15 times their light.
    for (const std::vector<double>& logs :
         {std::vector<double>{-69, -69, -10, -10, -10, -10}, {-10, -10, -10, -69, -69, -69}, {-69, -10, -10.1, -69, -5, -5}})
        for (double h = 0; h <= 9e3; h += 50) {
            const Stencil s = grid.altitudeStencil(h);
            INFO("h " << h << " logarithms from " << logs[0]);
            CHECK(at(s, logs) <= std::max(logs[s.index[1]], logs[s.index[2]]) + 0.3);
        }
}

TEST_CASE("stencils over the Sun: partition of unity, straight lines kept, slopes continuous, over the zenith too")
{
    const MomentGrid grid(earth, unevenLevels, -0.3, 9);
    const double values[10] = {4, 1, -2, 5, 5, 3, 8, 0, 1, 0}; // the last beyond the zenith
    const auto f = [&](double position) { return through(grid.sunStencil(position), [&](int i) { return values[i]; }); };
    for (double x = 0; x <= 8; x += 0.0625) {
        CHECK(through(grid.sunStencil(x), [](int) { return 1.; }) == Approx(1).epsilon(1e-14));
        CHECK(through(grid.sunStencil(x), [](int i) { return 2. * i - 7; }) == Approx(2 * x - 7).margin(1e-13));
    }
    const double d = 1e-5;
    for (int k = 0; k <= 8; ++k) {
        CHECK(f(k) == Approx(values[k]).margin(1e-13));
        if (k > 0 && k < 8) {
            const double left = (f(k) - f(k - d)) / d, right = (f(k + d) - f(k)) / d;
            CHECK(left == Approx(right).margin(1e-3)); // second derivatives of some 30 times d
        }
    }
    CHECK((f(8) - f(8 - d)) / d == Approx(0).margin(1e-3)); // even
    CHECK(grid.sunAsHigh(9) == 7);
    CHECK(grid.sunAsHigh(8) == 8);
}

TEST_CASE("moments of a Sun beyond the zenith are those before it, turned round")
{
    Moments m;
    m.grid = MomentGrid(earth, {0, 120e3}, -0.3, 4);
    m.degree = 2;
    m.wavelengths = 2;
    for (int i = 0; i < 2 * 4 * 6 * 2; ++i)
        m.values.push_back(0.01 * i);
    const auto wider = m.withSunBeyondZenith();
    REQUIRE(wider.size() == 2 * 5 * 6 * 2);
    const int signs[6] = {1, 1, -1, 1, -1, 1}; // (l, m) = 00 10 11 20 21 22
    for (int a = 0; a < 2; ++a)
        for (int sun = 0; sun < 5; ++sun)
            for (int lm = 0; lm < 6; ++lm)
                for (int w = 0; w < 2; ++w)
                    CHECK(wider[static_cast<std::size_t>(((a * 5 + sun) * 6 + lm) * 2 + w)] ==
                          (sun == 4 ? signs[lm] * m.at(a, 2)[lm * 2 + w] : m.at(a, sun)[lm * 2 + w]));
    // Even orders turn at the zenith, odd ones go through it.
    for (int lm = 0; lm < 6; ++lm)
        for (int a = 0; a < 2; ++a)
            for (int w = 0; w < 2 && signs[lm] < 0; ++w)
                m.at(a, 3)[lm * 2 + w] = 0;
    const auto at = [&](double fromZenith) {
        std::vector<double> result(12);
        m.interpolate(0, std::cos(fromZenith), result.data());
        for (int lm = 1; lm < 6; ++lm)
            for (std::size_t w = 0; w < 2; ++w)
                result[static_cast<std::size_t>(lm) * 2 + w] /= result[w];
        return result;
    };
    const auto here = at(0), near = at(1e-3), twice = at(2e-3);
    for (std::size_t i = 0; i < 12; ++i) {
        INFO("value " << i);
        const double once = near[i] - here[i], more = twice[i] - here[i];
        CHECK(more == Approx((signs[i / 2] < 0 ? 2 : 4) * once).epsilon(0.01).margin(1e-9)); // squares, or a straight line
        CHECK(std::abs(once) > 1e-8);
    }
}

TEST_CASE("stencils over altitude: value and slope continuous at every level")
{
    const MomentGrid grid(earth, gentleLevels, -0.3, 9);
    const double values[8] = {4, 1, -2, 5, 5, 3, 8, 0};
    const auto f = [&](double m) {
        const double q = m * m, h = q / (std::sqrt(earth.radius * earth.radius + q) + earth.radius);
        return through(grid.altitudeStencil(h), [&](int i) { return values[i]; });
    };
    for (int k = 1; k < 7; ++k) {
        const double m = measure(gentleLevels[k]), gap = std::min(m - measure(gentleLevels[k - 1]), measure(gentleLevels[k + 1]) - m);
        const double d = 1e-4 * gap;
        const double left = (f(m) - f(m - d)) / d, right = (f(m + d) - f(m)) / d, scale = 20 / gap;
        INFO("level " << gentleLevels[k]);
        CHECK(f(m) == Approx(values[k]).margin(1e-5));
        CHECK(left == Approx(right).margin(2e-3 * scale)); // second derivatives up to 40 / gap^2
    }
}

TEST_CASE("axis of the Sun: elevation and position are inverse, the ends are the ends")
{
    for (const double lowest : {-pi / 2, -0.6, -0.05}) {
        const MomentGrid grid(earth, unevenLevels, lowest, 24);
        CHECK(grid.sunElevation(0) == Approx(lowest).epsilon(1e-12));
        CHECK(grid.sunElevation(23) == Approx(pi / 2).epsilon(1e-12));
        for (double x = 0; x <= 23; x += 0.25)
            CHECK(grid.sunPosition(grid.sunElevation(x)) == Approx(x).margin(1e-10));
        CHECK(grid.sunPosition(-2) == 0);
        CHECK(grid.sunPosition(2) == 23);
    }
}

TEST_CASE("grid of the moments: levels at the edges of a cloud and inside it, in order from ground to top")
{
    const auto medium = sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase, 6.371e6),
                                               {0, 1000, 1000.01, 2000, 2000.01, 20e3}, {0, 0, 1, 1, 0, 0});
    const Profile profile(medium);
    const MomentGrid grid(profile, {10. / 1000}, 12, 16);
    const auto& h = grid.altitudes();
    CHECK(h.front() == 0);
    CHECK(h.back() == 20e3);
    CHECK(std::is_sorted(h.begin(), h.end()));
    CHECK(std::adjacent_find(h.begin(), h.end()) == h.end());
    const auto near = [&](double altitude) {
        return std::any_of(h.begin(), h.end(), [&](double level) { return std::abs(level - altitude) < 1; });
    };
    CHECK(near(1000));
    CHECK(near(2000));
    for (std::size_t k = 0; k + 1 < h.size(); ++k)
        if (h[k] >= 999 && h[k + 1] <= 2001) { // optical depth between levels: the bound of the grid, at the edges and inside
            const double within = std::max(2., 10 * std::min(h[k + 1] - 1000, 2000 - h[k]) / 1000);
            CHECK((h[k + 1] - h[k]) * 10 / 1000 <= 0.25 * within + 1e-3);
        }
}

TEST_CASE("grid of the moments: a sunset meets as many Suns on any planet, however small the Sun is, and noon its share")
{
    for (const double radius : {1e5, 6.371e6, 1e8, 1e10})
        for (const double disc : {0.0047, 0.}) {
            const double top = std::min(20e3, radius / 20);
            const Profile profile(sky::test::withDensity(sky::test::layer(1, 1, 0, sky::test::isotropicPhase, radius), {0, top}, {1, 1}));
            const MomentGrid grid(profile, {0.1 / top}, 12, 28, disc);
            const double dip = -horizonElevation({radius, top}, top), sunset = 2 * disc + dip;
            INFO("radius " << radius << " disc " << disc << " scale " << grid.sunScale() << " Suns " << grid.sunCount());
            CHECK(grid.sunPosition(0.5 * sunset) - grid.sunPosition(-0.5 * sunset) > 4);
            CHECK(grid.sunElevation(grid.sunCount() - 2) > 0.7 * pi / 2);
            CHECK(grid.sunElevation(0) < -2 * dip - 1.5 * disc); // no air is lit
            CHECK(grid.sunPosition(grid.sunElevation(7)) == Approx(7));
            CHECK(grid.sunCount() < 28 * 2);
            CHECK((sunsetShare(profile, {0.1 / top}, disc) < 1 || grid.sunCount() == 28));
        }
}

TEST_CASE("grid of the moments: opaque air has the sunset of what is above an optical depth of 1")
{
    const double radius = 1.6e7, top = 16e3, depth = 500;
    const Profile profile(sky::test::layer(depth, 1, 0, sky::test::isotropicPhase, radius, top));
    const MomentGrid grid(profile, {depth / top}, 12, 28);
    const double dip = -horizonElevation({radius, top}, top / depth);
    CHECK(grid.sunPosition(0.5 * dip) - grid.sunPosition(-0.5 * dip) > 4);
    CHECK(grid.sunElevation(0) < 2 * horizonElevation({radius, top}, top)); // other wavelengths may be clearer
    CHECK(grid.sunCount() < 28 * 2);
}

TEST_CASE("grid of the moments: levels follow haze whose profile has no nodes of its own")
{
    const Profile profile(sky::test::haze(1.25));
    const MomentGrid grid(profile, {1.25e-3}, 8, 16);
    const auto& h = grid.altitudes();
    const auto depthBetween = [&](std::size_t k) { return 1.25 * (std::exp(-h[k] / 1e3) - std::exp(-h[k + 1] / 1e3)); };
    for (std::size_t k = 0; k + 1 < h.size(); ++k)
        CHECK(depthBetween(k) < 0.5);
    CHECK(depthBetween(0) < 0.25);
}

TEST_CASE("grid of the moments: a thin layer high up has levels of its own, as far as a setting Sun sees it")
{
    const auto levelsWith = [](double depth) {
        Medium medium = sky::test::flatLayer(1, 1, 0.3, [](double) { return 1 / (4 * pi); });
        medium.planetRadius = 6.371e6;
        medium.topOfAtmosphere = 100e3;
        medium.altitudes.clear();
        auto& species = medium.species.front();
        species.numberDensity.clear();
        species.extinctionCrossSection = {1};
        for (int i = 0; i <= 1000; ++i) {
            const double h = 100. * i, z = (h - 25e3) / 5e3;
            medium.altitudes.push_back(h);
            species.numberDensity.push_back(0.1 / 8e3 * std::exp(-h / 8e3) + depth / (5e3 * std::sqrt(pi)) * std::exp(-z * z));
        }
        const MomentGrid grid(Profile(medium), {1}, 14, 28, 0.0046);
        return std::count_if(grid.altitudes().begin(), grid.altitudes().end(), [](double h) { return h > 10e3 && h < 40e3; });
    };
    const auto without = levelsWith(0);
    CHECK(levelsWith(1e-3) == without);
    CHECK(levelsWith(0.3) > without);
    CHECK(levelsWith(1) >= without + 4);
}

TEST_CASE("stencils over altitude: at the ground a field even in the measure has no slope")
{
    const Profile profile(sky::test::haze(1.25));
    const MomentGrid grid(profile, {1.25e-3}, 8, 16);
    const auto& h = grid.altitudes();
    // Linear in altitude, to R: a parabola of the measure.
    const Stencil s = grid.altitudeStencil(0.1 * h[1]);
    double value = 0;
    for (int i = 0; i < 4; ++i)
        value += s.weight[i] * (h[s.index[i]] + h[s.index[i]] * h[s.index[i]] / (2 * 6.371e6));
    CHECK(value == Approx(0.1 * h[1]).margin(0.08 * h[1]));
}

TEST_CASE("grid of the moments: the lowest Sun leaves all air in the dark")
{
    const auto medium = sky::test::exponentialAir(1);
    const MomentGrid grid(Profile(medium), {1.}, 12, 16);
    // The Earth's shadow covers air to the height h beyond twice the dip of h.
    CHECK(grid.lowestElevation() < 2 * horizonElevation(earth, 60e3));
    CHECK(grid.lowestElevation() >= -pi / 2);
}

TEST_CASE("moments: interpolation gives back what stands at the nodes, and exponentials in between")
{
    Moments m{MomentGrid(earth, unevenLevels, -0.3, 9), 1, 2, {}, {}};
    for (int a = 0; a < 8; ++a)
        for (int j = 0; j < 9; ++j)
            for (int lm = 0; lm < 3; ++lm)
                for (int w = 0; w < 2; ++w)
                    m.values.push_back(lm == 0 ? -1e-6 * measure(unevenLevels[a]) + 0.7 * j + w : 0.1 * lm + 0.02 * w);
    for (int j = 0; j < 9; ++j)
        for (int w = 0; w < 2; ++w)
            m.groundIrradiance.push_back(std::exp(0.5 * j - w));
    std::vector<double> field(6), ground(2);
    for (const double position : {0., 3., 3.3, 8.}) {
        const double muSun = std::sin(m.grid.sunElevation(position));
        for (const double h : {0., 800., 12e3, 120e3}) {
            m.interpolate(h, muSun, field.data());
            const double whole = std::exp(-1e-6 * measure(h) + 0.7 * position + 1);
            CHECK(field[1] == Approx(whole).epsilon(1e-7)); // asin near the zenith
            CHECK(field[1 * 2 + 1] == Approx(0.12 * whole).epsilon(1e-7));
            CHECK(field[2 * 2 + 1] == Approx(0.22 * whole).epsilon(1e-7));
        }
        m.interpolateGround(muSun, ground.data());
        CHECK(ground[0] == Approx(std::exp(0.5 * position)).epsilon(1e-7));
    }
}

TEST_CASE("directions of a level: weights cover the sphere, panels part at horizon and horizontal")
{
    MomentSettings settings;
    for (const double h : {0., 1e-4, 100., 12e3, 120e3}) {
        const Directions set = directionsAt(earth, h, settings);
        double whole = 0, flux = 0;
        for (std::size_t d = 0; d < set.mu.size(); ++d) {
            whole += set.weight[d];
            flux += set.weight[d] * std::abs(set.mu[d]);
            CHECK(set.hitsGround[d] == hitsGround(earth, h, set.mu[d]));
        }
        CHECK(whole == Approx(2).epsilon(1e-13));
        CHECK(flux == Approx(1).epsilon(1e-13)); // |mu| is linear on every panel
        CHECK(set.mu.size() == std::size_t(settings.groundDirections + settings.skyDirections + (h > 0 ? settings.limbDirections : 0)));
    }
}
