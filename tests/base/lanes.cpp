#include "base/lanes.hpp"
#include <algorithm>
#include <catch2/catch.hpp>

using namespace sky;

TEST_CASE("lanes: powers of two are good to 3e-7, and stop at the ends of floats")
{
    float worst = 0;
    for (int i = -125999; i <= 125999; i += 7) {
        const auto x = static_cast<float>(i) * 1e-3F;
        worst = std::max(worst, static_cast<float>(std::abs(double(base::exp2Lane(x)) / std::exp2(double(x)) - 1)));
    }
    CHECK(worst < 3e-7F);
    CHECK(base::exp2Lane(-1e30F) == base::exp2Lane(-126.F));
    CHECK(base::exp2Lane(1e30F) == base::exp2Lane(126.F));
    CHECK(base::exp2Lane(0.F) == 1.F);
}

TEST_CASE("lanes: exponentials in double are good to 1e-15, less one too, and stop at the ends")
{
    double worst = 0, worstLessOne = 0;
    for (double x = -699.9; x < 700; x += 0.00973) {
        const double truth = std::exp(x);
        worst = std::max(worst, std::abs(base::expLane(x) - truth) / truth);
    }
    for (double size = 1e-300; size < 700; size *= 1.0117)
        for (const double x : {size, -size})
            worstLessOne = std::max(worstLessOne, std::abs(base::expm1Lane(x) / std::expm1(x) - 1));
    CHECK(worst < 1e-15);
    CHECK(worstLessOne < 1e-15);
    CHECK(base::expLane(-1e30) == base::expLane(-700.));
    CHECK(base::expLane(1e30) == base::expLane(700.));
    CHECK(base::expLane(0.) == 1);
    CHECK(base::expm1Lane(0.) == 0);
}

TEST_CASE("lanes: logarithms are good to 2e-7 of 1 or of themselves")
{
    double worst = 0;
    for (double x = 1e-37; x < 1e37; x *= 1.00037) {
        const double truth = std::log2(double(static_cast<float>(x)));
        worst = std::max(worst, std::abs(double(base::log2Lane(static_cast<float>(x))) - truth) / std::max(1., std::abs(truth)));
    }
    CHECK(worst < 2e-7);
    CHECK(base::log2Lane(1.F) == 0.F);
    CHECK(base::log2Lane(8.F) == 3.F);
}

TEST_CASE("lanes: arcsines are good to 2e-7, and where they are small to 3e-7 of themselves")
{
    double worst = 0, worstRelative = 0;
    for (int i = 1; i <= 100000; ++i)
        for (const double x : {i * 1e-5, -i * 1e-5, i * 1e-9}) {
            const double truth = std::asin(double(static_cast<float>(x))), error = double(base::arcsineLane(static_cast<float>(x))) - truth;
            worst = std::max(worst, std::abs(error));
            worstRelative = std::max(worstRelative, std::abs(error / truth));
        }
    CHECK(worst < 2e-7);
    CHECK(worstRelative < 3e-7);
    CHECK(base::arcsineLane(0.F) == 0.F);
    CHECK(base::arcsineLane(1.5F) == base::arcsineLane(1.F));
}
