#include <csignal>

#include <catch2/catch.hpp>

#include "base/interrupt.hpp"

using namespace sky;

TEST_CASE("under a guard, Ctrl-C sets a flag and nothing else; a new guard starts afresh")
{
    {
        const InterruptGuard guard;
        CHECK_FALSE(interrupted());
        std::raise(SIGINT);
        CHECK(interrupted());
    }
    const InterruptGuard guard;
    CHECK_FALSE(interrupted());
    std::raise(SIGTERM);
    CHECK(interrupted());
}

TEST_CASE("a signal that was ignored before the guard stays ignored")
{
    std::signal(SIGINT, SIG_IGN);
    {
        const InterruptGuard guard;
        std::raise(SIGINT);
        CHECK_FALSE(interrupted());
    }
    CHECK(std::signal(SIGINT, SIG_DFL) == SIG_IGN);
}
