#include "base/background.hpp"
#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <vector>

using namespace sky;

TEST_CASE("background: jobs run one after another, in order")
{
    std::vector<int> order;
    std::atomic<int> running = 0;
    base::Background background;
    for (int i = 0; i < 50; ++i)
        background.start([&, i] {
            CHECK(running++ == 0);
            order.push_back(i);
            --running;
        });
    background.finish();
    REQUIRE(order.size() == 50);
    for (int i = 0; i < 50; ++i)
        CHECK(order[i] == i);
}

TEST_CASE("background: what a job throws comes out once, at the next start or finish")
{
    base::Background background;
    background.start([] { throw std::runtime_error("full"); });
    CHECK_THROWS_WITH(background.start([] {}), "full");
    background.start([] { throw std::runtime_error("full"); });
    CHECK_THROWS_WITH(background.finish(), "full");
    background.finish();
}
