#include "physics/series.hpp"
#include <catch2/catch.hpp>
#include <cmath>

using namespace sky::physics;

namespace {

/// Terms of v_{k+1} = diag(modes) v_k from ones, and what they add up to: 1 / (1 - mode).
struct Modes {
    std::vector<double> modes;

    double error(int terms) const
    {
        std::vector<double> products(terms * terms, 0.);
        for (int i = 0; i < terms; ++i)
            for (int j = 0; j < terms; ++j)
                for (const double q : modes)
                    products[i * terms + j] += std::pow(q, i + j) * (1 - q) * (1 - q); // relative to the whole
        const auto factors = seriesFactors(products, terms);
        double largest = 0;
        for (const double q : modes) {
            double sum = 0;
            for (int k = 0; k < terms; ++k)
                sum += factors[k] * std::pow(q, k);
            largest = std::max(largest, std::abs(sum * (1 - q) - 1));
        }
        return largest;
    }
};

} // namespace

TEST_CASE("closing a series: exact with one term more than there are modes")
{
    CHECK(Modes{{0.9}}.error(2) < 1e-10);
    CHECK(Modes{{0.9, 0.3}}.error(3) < 1e-8);
    CHECK(Modes{{0.95, 0.5, 0.1}}.error(4) < 1e-6);
}

TEST_CASE("closing a series: many modes take a quarter of the terms that their sum would")
{
    Modes many;
    for (int i = 0; i <= 40; ++i)
        many.modes.push_back(0.9 * i / 40);
    // 0.9^k < 0.01 takes 44 terms.
    CHECK(many.error(12) < 0.01);
    CHECK(many.error(6) > many.error(9));
}

TEST_CASE("closing a series: one term, no terms, equal terms and zeros give numbers")
{
    CHECK(seriesFactors({1.}, 1) == std::vector<double>{1});
    CHECK(seriesFactors({0., 0., 0., 0.}, 2) == std::vector<double>{1, 0});
    for (const double c : seriesFactors({1, 1, 1, 1, 1, 1, 1, 1, 1}, 3)) // v_{k+1} = v_k: no sum
        CHECK(std::isfinite(c));
}
