#include "base/parallel.hpp"
#include <catch2/catch.hpp>

#include <atomic>
#include <stdexcept>

using namespace sky;

TEST_CASE("parallel work: every thread runs once, and all have ended on return")
{
    std::vector<std::atomic<int>> runs(1024);
    std::atomic<int> count = 0;
    base::parallel([&](int thread, int threads) {
        count = threads;
        if (thread < 1024) // Catch2 asserts in one thread alone
            ++runs[thread];
    });
    REQUIRE((count >= 1 && count <= 1024));
    for (int t = 0; t < 1024; ++t)
        CHECK(runs[t] == (t < count ? 1 : 0));
}

TEST_CASE("parallel work: an exception of any thread arrives at the caller, after the others have ended")
{
    std::atomic<int> ended = 0, threadsSeen = 0;
    const auto work = [&](int thread, int threads) {
        threadsSeen = threads;
        if (thread == threads - 1)
            throw std::runtime_error("the last one");
        ++ended;
    };
    CHECK_THROWS_WITH(base::parallel(work), "the last one");
    CHECK(ended == threadsSeen - 1);
}
