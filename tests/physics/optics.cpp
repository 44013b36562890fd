#include "physics/optics.hpp"
#include "base/angles.hpp"
#include "media.hpp"
#include "physics/harmonics.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;
using sky::test::henyeyGreenstein;
using sky::test::layer;

static constexpr double pi = sky::base::pi;

TEST_CASE(
    "delta-M scaling: the truncated share is a mean of the moments left out, with more weight for the large ones, or what lets the rest fade")
{
    for (const double g : {0.5, 0.76, 0.8}) // sharper ones are blurred too
        for (const int degree : {2, 4, 8}) {
            const auto medium = layer(100, 0.8, 0, [&](double t) { return henyeyGreenstein(g, t); });
            const Optics optics = makeOptics(medium, degree, true);
            const double f = optics.truncation[0];
            double sum = 0, weights = 0;
            for (int l = degree + 1; l <= 5 * (degree + 1); ++l) {
                sum += (2 * l + 1) * std::pow(g, 4 * l);
                weights += (2 * l + 1) * std::pow(g, 3 * l);
            }
            const double fading = std::min((std::pow(g, degree) - 0.1) / 0.9, std::pow(g, degree + 1));
            CHECK(f == Approx(std::max(sum / weights, fading)).margin(1e-5)); // table of the phase function
            CHECK(f < std::pow(g, degree + 1) + 1e-5);
            for (int l = 0; l <= degree; ++l)
                CHECK(optics.moment(0, l, 0) == Approx((std::pow(g, l) - f) / (1 - f)).margin(2e-5));
        }
}

TEST_CASE("delta-M scaling: what is left of a sharp peak has faded where the series is cut")
{
    const auto medium = layer(100, 1, 0, [](double t) { return henyeyGreenstein(0.99, t); });
    for (const int degree : {14, 18, 24})
        CHECK(makeOptics(medium, degree, true).moment(0, degree, 0) < 0.1 + 1e-3);
}

TEST_CASE("delta-M scaling: absorption and transport scattering stay, the moments add up to the true ones")
{
    const double g = 0.8, albedo = 0.9, sigma = 100. / 1000; // sharper ones are blurred too
    const auto medium = layer(100, albedo, 0, [&](double t) { return henyeyGreenstein(g, t); });
    const auto truth = phaseMoments(medium, medium.species[0], 0, 7);
    const Optics optics = makeOptics(medium, 6, true);
    const double f = optics.truncation[0];
    // What is truncated goes straight on: it is neither absorbed nor scattered.
    CHECK(optics.extinction[0] - optics.scattering[0] == Approx(sigma * (1 - albedo)).epsilon(1e-12));
    CHECK(optics.scattering[0] == Approx((1 - f) * sigma * albedo).epsilon(1e-12));
    // sigma (1 - g) governs diffusion (similarity).
    CHECK(optics.scattering[0] * (optics.moment(0, 0, 0) - optics.moment(0, 1, 0)) ==
          Approx(sigma * albedo * (truth[0] - truth[1])).epsilon(1e-12));
    for (int l = 0; l <= 6; ++l)
        CHECK((1 - f) * optics.moment(0, l, 0) + f == Approx(truth[l]).epsilon(1e-12));
}

TEST_CASE("delta-M scaling: leaves gentle phase functions alone, and everything if told so")
{
    const auto rayleigh = layer(100, 1, 0, sky::test::rayleighPhase);
    for (const int degree : {2, 4, 8}) {
        const Optics optics = makeOptics(rayleigh, degree, true);
        CHECK(optics.truncation[0] == 0);
        CHECK(optics.extinction[0] == 0.1);
        CHECK(optics.moment(0, 2, 0) == Approx(0.1).margin(1e-6));
    }
    const auto haze = layer(100, 1, 0, [](double t) { return henyeyGreenstein(0.9, t); });
    CHECK(makeOptics(haze, 4, true).truncation[0] > 0);
    const Optics plain = makeOptics(haze, 4, false);
    CHECK(plain.truncation[0] == 0);
    CHECK(plain.moment(0, 4, 0) == Approx(std::pow(0.9, 4)).epsilon(1e-4));
}

TEST_CASE("delta-M scaling: of sharp peaks in thin air too, unless horizontal rays are deep or others do nearly all of the scattering")
{
    const auto truncated = [](double opticalDepth, double g, double radius, double others = 0) {
        auto medium = layer(
            opticalDepth, 1, 0.3, [&](double t) { return henyeyGreenstein(g, t); }, radius);
        medium.species.push_back(layer(others, 1, 0, sky::test::rayleighPhase, radius).species[0]);
        return makeOptics(medium, 14, true).truncation[0] > 0;
    };
    CHECK(truncated(1e-4, 0.99, 6.4e6)); // 0.01 along the horizontal
    CHECK_FALSE(truncated(1e-4, 0.8, 6.4e6));
    CHECK(truncated(2e-3, 0.99, 6.4e6));       // 0.2
    CHECK_FALSE(truncated(2e-3, 0.99, 6.4e9)); // 7
    CHECK(truncated(2e-2, 0.99, 6.4e9));       // 70, but no longer thin
    CHECK(truncated(1e-4, 0.99, 6.4e6, 0.01));
    CHECK_FALSE(truncated(1e-4, 0.99, 6.4e6, 0.05));
}

/// Sum of the series of a phase function, by that of isotropic scattering: the lowest value, and the highest.
static std::pair<double, double> extremes(const Optics& optics)
{
    double lowest = 0, highest = 0;
    std::vector<double> polynomials(optics.degree + 1);
    for (int i = 0; i <= 180; ++i) {
        legendre(optics.degree, std::cos(i * 3.14159265358979 / 180), polynomials.data());
        double sum = 0;
        for (int l = 0; l <= optics.degree; ++l)
            sum += (2 * l + 1) * optics.moment(0, l, 0) * polynomials[l];
        lowest = std::min(lowest, sum);
        highest = std::max(highest, sum);
    }
    return {lowest, highest};
}

TEST_CASE("sharp peaks: their series fade to its end, ripple little below zero, and keep the flux")
{
    for (const double opticalDepth : {1e-3, 1.})
        for (const double g : {0.9, 0.97, 0.99})
            for (const int degree : {8, 14, 20}) {
                CAPTURE(opticalDepth, g, degree);
                const auto air = layer(opticalDepth, 0.9, 0, [&](double t) { return henyeyGreenstein(g, t); });
                const Optics optics = makeOptics(air, degree, true);
                CHECK((optics.truncation[0] == 0) == (opticalDepth < 1)); // thin air is not, where horizontal rays are deep
                CHECK(optics.moment(0, 0, 0) == Approx(1).margin(1e-4));  // table of the phase function
                CHECK(optics.moment(0, degree, 0) < 0.03);
                const auto [lowest, highest] = extremes(optics);
                CHECK(lowest > -0.02 * highest); // of a cut one: -0.11 at best
            }
}

TEST_CASE("sharp peaks: beyond what the degree resolves their series are the phase function, faint as it is")
{
    for (const double g : {0.9, 0.95, 0.99})
        for (const int degree : {14, 18, 24}) {
            CAPTURE(g, degree);
            const auto phase = [&](double t) { return henyeyGreenstein(g, t); };
            const Optics optics = makeOptics(layer(1, 1, 0, phase), degree, true);
            const double kept = 1 - optics.truncation[0];
            std::vector<double> polynomials(degree + 1);
            double squares = 0;
            int angles = 0;
            for (double theta = 40 * pi / 180; theta < pi; theta += pi / 90, ++angles) {
                legendre(degree, std::cos(theta), polynomials.data());
                double sum = 0;
                for (int l = 0; l <= degree; ++l)
                    sum += (2 * l + 1) / (4 * pi) * optics.moment(0, l, 0) * polynomials[l];
                squares += std::pow(kept * sum / phase(theta) - 1, 2);
            }
            CHECK(std::sqrt(squares / angles) < 0.35); // faded, not fitted: 0.6 to 6
        }
}

TEST_CASE("sharp peaks: gentle ones are left alone, and all if told so")
{
    const auto gentle = layer(1e-4, 1, 0, [](double t) { return henyeyGreenstein(0.76, t); });
    for (int l = 0; l <= 4; ++l)
        CHECK(makeOptics(gentle, 4, true).moment(0, l, 0) == Approx(std::pow(0.76, l)).epsilon(1e-4));
    const auto sharp = layer(1e-3, 1, 0, [](double t) { return henyeyGreenstein(0.99, t); });
    CHECK(makeOptics(sharp, 0, true).moment(0, 0, 0) == Approx(1));
    CHECK(makeOptics(sharp, 8, false).moment(0, 8, 0) == Approx(std::pow(0.99, 8)).epsilon(1e-3));
}

TEST_CASE("sharp peaks: one backward fades as its mirror image would forward")
{
    for (const double opticalDepth : {1e-3, 10.})
        for (const double g : {0.8, 0.9, 0.99})
            for (const int degree : {8, 9, 14, 20}) {
                CAPTURE(opticalDepth, g, degree);
                const auto back = layer(opticalDepth, 1, 0, [&](double t) { return henyeyGreenstein(-g, t); });
                const Optics optics = makeOptics(back, degree, true);
                CHECK(optics.truncation[0] == 0);
                CHECK(optics.moment(0, 0, 0) == Approx(1).margin(3e-4)); // table of the phase function
                CHECK(std::abs(optics.moment(0, degree, 0)) < 0.02);
                const auto [lowest, highest] = extremes(optics);
                CHECK(lowest > -0.02 * highest);
                if (g > 0.85 && opticalDepth < 1) { // as thin as that, one forward is not truncated either
                    const auto ahead = layer(opticalDepth, 1, 0, [&](double t) { return henyeyGreenstein(g, t); });
                    const Optics mirrored = makeOptics(ahead, degree, true);
                    for (int l = 0; l <= degree; ++l)
                        CHECK(optics.moment(0, l, 0) == Approx((l % 2 ? -1 : 1) * mirrored.moment(0, l, 0)).margin(1e-3));
                }
            }
}

TEST_CASE("optics: absorbers extinguish and do not scatter")
{
    const auto medium = sky::test::sampleEarth(sky::test::Aerosol::Yes);
    const Optics optics = makeOptics(medium, 4, true);
    CHECK(optics.scatterers == std::vector<int>{0, 1});
    for (int w = 0; w < 4; ++w) {
        CHECK(optics.extinction[2 * 4 + w] == medium.species[2].extinctionCrossSection[w]);
        CHECK(optics.scattering[2 * 4 + w] == 0);
    }
    // A species that scatters at some wavelengths only counts as a scatterer, and is not one at the others.
    auto partial = medium;
    partial.species[1].singleScatteringAlbedo = {0, 1, 0, 1};
    const Optics mixed = makeOptics(partial, 4, true);
    CHECK(mixed.scatterers == std::vector<int>{0, 1});
    for (int w = 0; w < 4; ++w)
        CHECK(mixed.scattering[4 + w] == (w % 2 ? Approx(optics.scattering[4 + w]) : Approx(0)));
    CHECK(mixed.moment(1, 1, 3) == Approx(optics.moment(1, 1, 3)));
    auto dark = medium;
    dark.species[1].singleScatteringAlbedo = {0, 0, 0, 0};
    CHECK(makeOptics(dark, 4, true).scatterers == std::vector<int>{0});
}

TEST_CASE("optics: later events keep fewer azimuthal orders, never fewer than asked for nor more than the degree")
{
    const auto haze = makeOptics(layer(100, 0.8, 0, [](double t) { return henyeyGreenstein(0.85, t); }), 12, false);
    int before = 12;
    for (int event = 2; event <= 30; ++event) {
        const int m = azimuthalDegree(haze, event, 0.05, 4);
        CHECK(m <= before);
        CHECK(m >= 4);
        if (m < 12)
            CHECK((2 * m + 3) * std::pow(0.85, (m + 1) * (event + 1)) < 0.0505);
        if (m > 4)
            CHECK((2 * m + 1) * std::pow(0.85, m * (event + 1)) > 0.0495);
        before = m;
    }
    CHECK(before == 4);
    const auto gentle = makeOptics(layer(1, 1, 0, [](double t) { return henyeyGreenstein(0.1, t); }), 3, false);
    CHECK(azimuthalDegree(gentle, 2, 0.05, 4) == 3);
}
