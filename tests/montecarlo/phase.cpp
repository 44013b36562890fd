// Tabulated phase functions: values and sampling.

#include "montecarlo/phase.hpp"
#include "montecarlo/random.hpp"
#include "sample_air.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace sky;
using namespace sky::montecarlo;

namespace {

PhaseTable sampleAerosol()
{
    const auto medium = test::sampleEarth(test::Aerosol::Yes);
    std::vector<double> values;
    for (std::size_t i = 0; i < medium.scatteringAngles.size(); ++i)
        values.push_back(medium.species[1].phaseFunction[4 * i]);
    return {medium.scatteringAngles, values};
}

} // namespace

TEST_CASE("phase function: log-linear in the angle, linear where an end is zero")
{
    const PhaseTable table({0, 1, 2, std::numbers::pi}, {4, 1, 0, 2});
    CHECK(table.value(0.5) == Approx(2));
    CHECK(table.value(1.5) == Approx(0.5));
    CHECK(table.value(2 + (std::numbers::pi - 2) / 4) == Approx(0.5));
    CHECK(table.value(0) == Approx(4));
    CHECK(table.value(std::numbers::pi) == Approx(2));
}

TEST_CASE("phase function: integral is that of the table, not forced to one")
{
    CHECK(sampleAerosol().integral() == Approx(0.99948).margin(1e-5)); // published with 5 digits
}

TEST_CASE("phase function: sampled angles have the density of the table")
{
    const PhaseTable aerosol = sampleAerosol(), coarse({0, 1, 2, std::numbers::pi}, {4, 1, 0, 2});
    for (const PhaseTable* table : {&aerosol, &coarse}) {
        // Moments of the samples against a fine midpoint rule.
        double norm = 0, cosine = 0, forward = 0;
        constexpr int steps = 400000;
        for (int i = 0; i < steps; ++i) {
            const double a = std::numbers::pi * (i + 0.5) / steps;
            const double ring = 2 * std::numbers::pi * std::sin(a) * table->value(a) * std::numbers::pi / steps;
            norm += ring;
            cosine += ring * std::cos(a);
            forward += a < 0.05 ? ring : 0;
        }
        CHECK(table->integral() == Approx(norm).epsilon(1e-6));
        double weights = 0, meanCosine = 0, meanForward = 0;
        constexpr int samples = 200000;
        for (int i = 0; i < samples; ++i) {
            const auto sample = table->sample((i + 0.5) / samples);
            weights += sample.weight;
            meanCosine += sample.weight * std::cos(sample.angle);
            meanForward += sample.angle < 0.05 ? sample.weight : 0;
        }
        // Even sampling: the error is that of a midpoint rule, a few 1e-5 where the weight jumps between nodes.
        CHECK(weights / samples == Approx(1).margin(5e-5));
        CHECK(meanCosine / samples == Approx(cosine / norm).margin(5e-5));
        CHECK(meanForward / samples == Approx(forward / norm).margin(5e-5));
    }
}
