// The moments against Monte Carlo tables made by other code: sky radiance, single scattering included, all rows of a regime.
#include "media.hpp"
#include "physics/source_iteration.hpp"
#include "reference_table.hpp"
#include <catch2/catch.hpp>

using namespace sky::physics;

namespace {

/// Relative deviations of a regime: rms with the noise of the table taken out, mean, largest in standard errors.
struct Deviation {
    int rows = 0;
    double squares = 0, noise = 0, sum = 0;
    void add(double off, double standardError)
    {
        ++rows;
        sum += off;
        squares += off * off;
        noise += standardError * standardError;
    }
    double rms() const { return std::sqrt(std::max(0., squares - noise) / rows); }
    double mean() const { return sum / rows; }
};

struct Regimes {
    Deviation day, sunset, twilight; // Sun's zenith angle to 85, to 92, to 96 degrees
};

Regimes compare(sky::test::Aerosol aerosol, const std::string& table, const MomentSettings& settings, int events)
{
    const Medium medium = sky::test::sampleEarth(aerosol);
    const Profile profile(medium);
    const Optics optics = makeOptics(medium, settings.degree, settings.truncatePeaks);
    const SunTable sun(profile, optics, medium.sunAngularRadius);
    std::vector<double> largest(optics.species, 0.);
    for (int s = 0; s < optics.species; ++s)
        for (int w = 0; w < optics.wavelengths; ++w)
            largest[s] = std::max(largest[s], optics.extinction[s * optics.wavelengths + w]);
    const MomentGrid grid(profile, largest, settings.altitudes, settings.suns);
    const Moments moments = iterateSource(medium, profile, optics, sun, grid, settings, events);
    const SkyEvaluator sky(medium, profile, optics, sun);
    RayTracer tracer(profile, optics);
    Regimes regimes;
    std::vector<double> value(optics.wavelengths);
    for (const auto& row : sky::test::referenceTable(table)) {
        sky.radiance(tracer, &moments, row.altitude, row.mu, row.muSun, row.nu(), {}, value.data());
        const double truth = row.single + row.multiple;
        auto& regime = row.sza <= 85 ? regimes.day : row.sza <= 92 ? regimes.sunset : regimes.twilight;
        regime.add(value[row.wavelength] / truth - 1, row.standardError / truth);
    }
    return regimes;
}

/// What the default settings are worth. Their grids leave a quarter of a percent by day and, with aerosol, one and a half in
/// twilight (docs/accuracy); the noise of the tables, already taken out, is 0.1 % and 0.3 %.
void expectDefaultAccuracy(const Regimes& r)
{
    CAPTURE(r.day.mean(), r.sunset.mean(), r.twilight.mean());
    CHECK(r.day.rows + r.sunset.rows + r.twilight.rows == 620);
    CHECK(r.day.rms() < 0.004);
    CHECK(r.sunset.rms() < 0.005);
    CHECK(r.twilight.rms() < 0.018);
}

} // namespace

TEST_CASE("moments agree with Monte Carlo: Earth with aerosol, four orders")
{
    expectDefaultAccuracy(compare(sky::test::Aerosol::Yes, "earth_orders4.csv", {}, 3));
}

// Nine events: the tenth order adds less than 1e-3 at 391 nm.
TEST_CASE("moments agree with Monte Carlo: air without aerosol, all orders", "[slow]")
{
    expectDefaultAccuracy(compare(sky::test::Aerosol::No, "thin_all.csv", {}, 9));
}

TEST_CASE("moments agree with Monte Carlo: Earth with aerosol, all orders", "[slow]")
{
    expectDefaultAccuracy(compare(sky::test::Aerosol::Yes, "earth_all.csv", {}, 9));
}
