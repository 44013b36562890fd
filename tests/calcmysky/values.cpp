#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "values.hpp"

using namespace sky;
using namespace sky::cli;

TEST_CASE("sizes of memory are read with binary and decimal units")
{
    CHECK(readSize("--max-memory", "1500000") == 1500000);
    CHECK(readSize("--max-memory", "512M") == std::size_t{512} << 20);
    CHECK(readSize("--max-memory", "512MiB") == std::size_t{512} << 20);
    CHECK(readSize("--max-memory", "512 MB") == 512000000);
    CHECK(readSize("--max-memory", "1.5g") == std::size_t{3} << 29);
    for (const char* bad : {"", "M", "12", "1e9", "-1G", "5Q", "1.2.3G", "99999999T", "nan"})
        CHECK_THROWS_AS(readSize("--max-memory", bad), UsageError);
}

TEST_CASE("altitude layers are one number or a range that does not fall")
{
    CHECK(readLayers("--altitudes", "3..7") == std::pair{3, 7});
    CHECK(readLayers("--altitudes", "0") == std::pair{0, 0});
    for (const char* bad : {"", "..", "7..3", "-1..2", "1..", "..2", "1.5", "1...3", "a..b", "1..99999999999"})
        CHECK_THROWS_AS(readLayers("--altitudes", bad), UsageError);
}

TEST_CASE("parts are read by name, and a misspelt one is met with a suggestion")
{
    using solver::Part;
    CHECK(readParts("--only", "moments") == std::set{Part::Moments});
    CHECK(readParts("--only", "single, light-pollution") == std::set{Part::Single, Part::LightPollution});
    CHECK_THROWS_WITH(readParts("--only", "moments,singel"), Catch::Contains("Did you mean `single`?"));
    CHECK_THROWS_AS(readParts("--only", "moments,"), UsageError);
    for (const Part part : solver::allParts())
        CHECK(readParts("--only", nameOf(part)) == std::set{part});
}

TEST_CASE("a fraction lies strictly between zero and one")
{
    CHECK(readFraction("--tolerance", "0.001") == 0.001);
    CHECK(readFraction("--tolerance", "1e-3") == 0.001);
    for (const char* bad : {"0", "1", "-0.1", "nan", "inf", "1%", "", "0.1x"})
        CHECK_THROWS_AS(readFraction("--tolerance", bad), UsageError);
}

TEST_CASE("sizes and durations are written with two or three digits")
{
    CHECK(formatSize(0) == "-");
    CHECK(formatSize(999) == "999 B");
    CHECK(formatSize(1234) == "1.2 kB");
    CHECK(formatSize(12'345'678) == "12 MB");
    CHECK(formatSize(999'600) == "1.0 MB");
    CHECK(formatSize(3'210'000'000) == "3.21 GB");
    CHECK(formatDuration(0.254) == "0.25 s");
    CHECK(formatDuration(4.21) == "4.2 s");
    CHECK(formatDuration(59.6) == "1 min 00 s");
    CHECK(formatDuration(185) == "3 min 05 s");
    CHECK(formatDuration(7620) == "2 h 07 min");
}
