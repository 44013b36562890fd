#include "media.hpp"
#include "physics/city.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

using namespace sky;
using namespace sky::physics;

TEST_CASE("city field: called off, each thread ends with the point that it is at")
{
    const Medium medium = test::exponentialAir(0.1, 0.3);
    const CityAir air(medium);
    std::atomic<int> asked = 0;
    const CityField whole(air, 1e-3, [&] {
        ++asked;
        return false;
    });
    const int all = asked, threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    CHECK(all > 200 * whole.events()); // of a point, a three-hundredth of an event
    for (const int calledOffAt : {1, 5, all / 2}) {
        CAPTURE(calledOffAt);
        asked = 0;
        CHECK_THROWS_AS(CityField(air, 1e-3, [&] { return ++asked >= calledOffAt; }), base::Stopped);
        CHECK(asked >= calledOffAt);
        CHECK(asked < calledOffAt + threads);
    }
}
