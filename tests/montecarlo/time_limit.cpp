// A limit of time ends short paths and long ones, and what was begun counts.

#include "montecarlo/estimate.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

using namespace sky::montecarlo;

namespace {

/// Batches whose mean is their number, 0 for the first that is begun, and whose paths take so long each.
class NumberedBatches
{
public:
    explicit NumberedBatches(std::chrono::microseconds pathTime) : pathTime_(pathTime) {}

    Result run(double maxSeconds)
    {
        Result result;
        const auto make = [this]() -> BatchMean {
            return [this](Random&, int paths) {
                const int number = begun_++;
                paths_ += paths;
                std::this_thread::sleep_for(paths * pathTime_);
                return static_cast<double>(number);
            };
        };
        runPaths(make, {}, {.relativeError = 1e-9, .maxPaths = 1 << 15, .maxSeconds = maxSeconds, .threads = 2}, result);
        return result;
    }
    int begun() const { return begun_; }
    int paths() const { return paths_; }

private:
    std::chrono::microseconds pathTime_;
    std::atomic<int> begun_ = 0, paths_ = 0;
};

} // namespace

TEST_CASE("limited time: long paths end soon, in small batches, and every batch begun counts but the trial")
{
    NumberedBatches batches(std::chrono::milliseconds(1)); // the first 16384 would take two threads 8 s
    const Result result = batches.run(0.1);
    CHECK(result.paths >= 8);
    CHECK(result.paths < 2000);
    CHECK(result.paths + 4 == batches.paths());
    const int n = batches.begun() - 1;
    REQUIRE(n == result.paths / 4);
    CHECK(result.multiple == Approx(0.5 * (n + 1)));
    CHECK(result.multipleStderr == Approx(std::sqrt((n + 1) / 12.))); // of the numbers 1..n: variance n (n + 1) / 12
}

TEST_CASE("limited time: short paths are as many as tell their own noise, in large batches, however short the time")
{
    NumberedBatches batches(std::chrono::microseconds(0));
    const Result result = batches.run(1e-9);
    CHECK(result.paths == 16384);
    CHECK(batches.begun() == 65);
}
