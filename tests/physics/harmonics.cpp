#include "physics/harmonics.hpp"
#include "media.hpp"
#include "physics/quadrature.hpp"
#include <catch2/catch.hpp>
#include <cmath>

using namespace sky::physics;
using sky::test::pi;

TEST_CASE("Gauss-Legendre: exact for polynomials up to degree 2 n - 1, and no further")
{
    for (const int n : {1, 2, 3, 5, 8, 17, 32, 64}) {
        const auto rule = gaussLegendre(n);
        REQUIRE(rule.nodes.size() == std::size_t(n));
        const auto monomial = [&](int degree) {
            double sum = 0;
            for (int i = 0; i < n; ++i)
                sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
            return sum;
        };
        for (int degree = 0; degree < 2 * n; ++degree)
            CHECK(monomial(degree) == Approx(degree % 2 ? 0. : 2. / (degree + 1)).epsilon(1e-13).margin(1e-14)); // rounding of n terms
        if (n <= 8) // the first error is -(2n+1)(n!)^4 2^(2n+1) / ((2n+1)^2 (2n)!^2): seen while above rounding
            CHECK(std::abs(monomial(2 * n) - 2. / (2 * n + 1)) > 1e-6);
        for (int i = 0; i < n; ++i) {
            CHECK(rule.weights[i] > 0);
            CHECK(std::abs(rule.nodes[i]) < 1);
            CHECK((i == 0 || rule.nodes[i] > rule.nodes[i - 1]));
        }
    }
}

TEST_CASE("Gauss-Legendre: moves to any interval")
{
    const auto rule = gaussLegendre(12, -3, 5);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        sum += rule.weights[i] * std::exp(rule.nodes[i]);
    CHECK(sum == Approx(std::exp(5.) - std::exp(-3.)).epsilon(1e-12)); // f^(24) 8^25 (12!)^4 / (25 (24!)^3) ~ 1e-13
}

TEST_CASE("harmonics: orthonormal over the sphere")
{
    const int degree = 12, count = harmonicCount(degree), azimuths = 32;
    const auto rule = gaussLegendre(16); // products have degree 24 < 31
    std::vector<double> gram(count * count, 0.), factors(count), y(count);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        harmonicFactors(degree, rule.nodes[i], factors.data());
        for (int k = 0; k < azimuths; ++k) {
            const double phi = 2 * pi * (k + 0.5) / azimuths, area = rule.weights[i] * 2 * pi / azimuths;
            for (int l = 0; l <= degree; ++l)
                for (int m = 0; m <= l; ++m)
                    y[harmonicIndex(l, m)] = factors[harmonicIndex(l, m)] * std::cos(m * phi);
            for (int a = 0; a < count; ++a)
                for (int b = 0; b < count; ++b)
                    gram[a * count + b] += area * y[a] * y[b];
        }
    }
    double worst = 0;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b)
            worst = std::max(worst, std::abs(gram[a * count + b] - (a == b)));
    CHECK(worst < 1e-13); // exact quadrature: rounding of 512 terms
}

TEST_CASE("harmonics: addition theorem, at the poles as well")
{
    const int degree = 16;
    std::vector<double> a(harmonicCount(degree)), b(harmonicCount(degree)), p(degree + 1);
    for (const double mu1 : {-1., -0.73, -1e-8, 0., 0.31, 1 - 1e-12, 1.})
        for (const double mu2 : {-1., -0.2, 0., 0.999, 1.})
            for (const double phi : {0., 0.4, 1.9, pi}) {
                harmonicFactors(degree, mu1, a.data());
                harmonicFactors(degree, mu2, b.data());
                legendre(degree, mu1 * mu2 + std::sqrt((1 - mu1 * mu1) * (1 - mu2 * mu2)) * std::cos(phi), p.data());
                for (int l = 0; l <= degree; ++l) {
                    double sum = 0;
                    for (int m = 0; m <= l; ++m)
                        sum += a[harmonicIndex(l, m)] * b[harmonicIndex(l, m)] * std::cos(m * phi);
                    CHECK(sum == Approx((2 * l + 1) / (4 * pi) * p[l]).margin(1e-12)); // recurrences of 16 steps
                }
            }
}

TEST_CASE("Legendre polynomials: values at 1, -1, 0 and a closed form")
{
    double p[9];
    legendre(8, 1, p);
    for (int l = 0; l <= 8; ++l)
        CHECK(p[l] == Approx(1));
    legendre(8, -1, p);
    for (int l = 0; l <= 8; ++l)
        CHECK(p[l] == Approx(l % 2 ? -1 : 1));
    legendre(8, 0, p);
    CHECK(p[8] == Approx(35. / 128));
    legendre(4, 0.3, p);
    CHECK(p[4] == Approx((35 * std::pow(0.3, 4) - 30 * 0.09 + 3) / 8));
}

TEST_CASE("phase moments: Henyey-Greenstein gives powers of g, Rayleigh gives 1, 0, 1/10")
{
    for (const double g : {-0.5, 0., 0.3, 0.76, 0.9}) {
        const auto medium = sky::test::layer(1, 1, 0, [&](double t) { return sky::test::henyeyGreenstein(g, t); });
        const auto moments = phaseMoments(medium, medium.species[0], 0, 12);
        for (int l = 0; l <= 12; ++l)
            CHECK(moments[l] == Approx(std::pow(g, l)).epsilon(1e-5).margin(1e-5)); // log-linear over steps of 1e-3 rad
    }
    const auto medium = sky::test::layer(1, 1, 0, sky::test::rayleighPhase);
    const auto moments = phaseMoments(medium, medium.species[0], 0, 6);
    for (int l = 0; l <= 6; ++l)
        CHECK(moments[l] == Approx(l == 0 ? 1 : l == 2 ? 0.1 : 0).margin(1e-6));
}

TEST_CASE("phase function: log-linear between angles, linear to a zero, held at the ends")
{
    auto medium = sky::test::layer(1, 1, 0, sky::test::isotropicPhase);
    medium.scatteringAngles = {0, 1, 2, pi};
    medium.species[0].phaseFunction = {4, 1, 0, 0.5};
    const auto at = [&](double theta) {
        double p = -1;
        phaseFunctionAt(medium, medium.species[0], theta, &p);
        return p;
    };
    CHECK(at(0) == 4);
    CHECK(at(0.5) == Approx(2));
    CHECK(at(1) == Approx(1));
    CHECK(at(1.25) == Approx(0.75));
    CHECK(at(2) == Approx(0).margin(1e-15));
    CHECK(at(0.5 * (2 + pi)) == Approx(0.25));
    CHECK(at(pi) == Approx(0.5));
    CHECK(at(4) == Approx(0.5)); // acos of a rounded cosine may pass pi
    CHECK(at(-1) == 4);
}
