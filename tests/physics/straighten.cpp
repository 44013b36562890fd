#include "physics/straighten.hpp"
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

using namespace sky::physics;

namespace {

/// Of a straightened table of f at these positions, the mean over its lines of their error, [segment], and the values.
struct Straight {
    Straight(const std::function<double(double)>& f, const std::vector<double>& positions) : values(positions.size())
    {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = f(positions[i]);
        straighten(positions, values.data(), 1, 1);
        for (std::size_t i = 0; i + 1 < values.size(); ++i) {
            double sum = 0;
            for (int k = 0; k < 1000; ++k) {
                const double x = (k + 0.5) / 1000;
                sum += (1 - x) * values[i] + x * values[i + 1] - f((1 - x) * positions[i] + x * positions[i + 1]);
            }
            means.push_back(sum / 1000);
        }
    }
    std::vector<double> values, means;
};

} // namespace

TEST_CASE("straightened tables: lines along a parabola are right in the mean, where its nodes are even")
{
    const Straight even([](double x) { return 1 + x * x; }, {0, 1, 2, 3, 4, 5});
    for (std::size_t i = 1; i + 2 < even.values.size(); ++i) // chords are 1/6 too high; the ends are not shifted
        CHECK(even.means[i] == Approx(0).margin(1e-6));
    CHECK(even.values.front() == 1);
    CHECK(even.values.back() == 26);
}

TEST_CASE("straightened tables: an exponential on nodes that grow by a factor has its integral, five times better than by chords")
{
    std::vector<double> positions;
    for (double x = 0.1; x < 4; x *= 1.1)
        positions.push_back(x);
    const auto f = [](double x) { return std::exp(-x); };
    const Straight grown(f, positions);
    double straightened = 0, chords = 0;
    for (std::size_t i = 1; i + 2 < positions.size(); ++i) {
        const double a = positions[i], b = positions[i + 1];
        straightened += (b - a) * grown.means[i];
        chords += (b - a) * (f(a) + f(b)) / 2 - (f(a) - f(b));
    }
    CHECK(chords > 5e-4);
    CHECK(std::abs(straightened) < 0.2 * chords);
}

TEST_CASE("straightened tables: lines stay, so does what is beside a corner, and nothing falls below zero")
{
    const std::vector<double> positions{0, 1, 2, 3, 4, 5, 6};
    const auto line = [](double x) { return 3 + 0.5 * x; };
    const Straight straight(line, positions);
    for (std::size_t i = 0; i < positions.size(); ++i)
        CHECK(straight.values[i] == Approx(line(positions[i])));
    const auto corner = [](double x) { return std::abs(x - 3); };
    const Straight bent(corner, positions);
    for (std::size_t i = 0; i < positions.size(); ++i)
        CHECK(bent.values[i] == Approx(corner(positions[i])).margin(1e-12));
    const Straight low([](double x) { return x * x * 1e-3; }, {-3, -2, -1, 0, 1, 2, 3});
    CHECK(low.values[3] == 0);
    std::vector<double> same{1, 1, 1, 5}; // two altitudes can round to one measure
    straighten({0, 1, 1, 2}, same.data(), 1, 1);
    for (const double value : same)
        CHECK(std::isfinite(value));
}

TEST_CASE("straightened tables: lines between known points, also where two have one position")
{
    std::vector<double> values{1, 10, 0, 0, 3, 30, 0, 0, 5, 50}; // two numbers a point
    drawLines({0, 2, 4}, {0, 1, 4, 4, 4}, values.data(), 2, 2);
    CHECK(values == std::vector<double>{1, 10, 1.5, 15, 3, 30, 4, 40, 5, 50});
}
