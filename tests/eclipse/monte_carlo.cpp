// The quotient of the field against Monte Carlo with a Moon: data/README.md has the commands that made the table.
#include "scene.hpp"
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>

using namespace sky;
using namespace sky::eclipse;
using namespace sky::eclipse::test;

namespace {

struct Row {
    double altitude, sunZenith, viewZenith, azimuth, wavelengthNm, moonZenith, moonAzimuth, moonDistance; ///< m, degrees
    double single, multiple, error, uneclipsed, uneclipsedError;
};

std::vector<Row> table()
{
    std::ifstream in(SKY_TEST_DATA "/data/earth_small_eclipses.csv");
    std::vector<Row> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream text(line);
        Row r{};
        text >> r.altitude >> r.sunZenith >> r.viewZenith >> r.azimuth >> r.wavelengthNm >> r.moonZenith >> r.moonAzimuth >>
            r.moonDistance >> r.single >> r.multiple >> r.error >> r.uneclipsed >> r.uneclipsedError;
        REQUIRE(text);
        rows.push_back(r);
    }
    return rows;
}

} // namespace

// The sky without Moon comes from the same judge, so that the quotient alone is on trial. Deviations count against the mean of the whole eclipsed
// sky, order 1 included, over the rows of a scene and wavelength.
TEST_CASE("eclipse field: agrees with Monte Carlo, totality to partial phases")
{
    FieldSettings settings; // what the renderer uses
    const Earth earth(settings);
    std::map<std::pair<double, double>, std::vector<Row>> scenes; // by altitude, and Sun and Moon
    for (const Row& row : table())
        scenes[{row.altitude, 1e3 * row.sunZenith + row.moonZenith}].push_back(row);
    REQUIRE(scenes.size() == 5);
    for (const auto& [key, rows] : scenes) {
        const Row& first = rows.front();
        auto bodies = earth.bodies((90 - first.sunZenith) * degrees, 0, 0, first.altitude);
        const double zenith = first.moonZenith * degrees, azimuth = first.moonAzimuth * degrees;
        bodies.moonDirection = {std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth), std::cos(zenith)};
        bodies.moonDistance = first.moonDistance;
        bodies.sunDistance = 1.01208 * 149597870700.;
        const auto field = earth.solved(bodies);
        for (const int w : {0, 2}) { // 391 and 579 nm
            double squares = 0, noise = 0, sum = 0, sky = 0, normalised = 0;
            int count = 0;
            for (const Row& row : rows) {
                if (std::abs(row.wavelengthNm - earth.medium.wavelengthsNm[std::size_t(w)]) > 1)
                    continue;
                const double mu = std::cos(row.viewZenith * degrees);
                const auto light =
                    field.view({{row.altitude, mu, physics::hitsGround(bodies.planet, row.altitude, mu), 0}}, {row.azimuth * degrees});
                const double ratio = static_cast<double>(light.skyRatio(0, 0, w)), off = ratio * row.uneclipsed - row.multiple;
                const double error = std::hypot(row.error, ratio * row.uneclipsedError);
                squares += off * off;
                noise += error * error;
                normalised += off * off / (error * error + std::pow(0.03 * row.multiple, 2));
                sum += off;
                sky += row.single + row.multiple;
                ++count;
            }
            REQUIRE(count >= 4);
            const double mean = sky / count, rms = std::sqrt(squares / count) / mean, noiseShare = std::sqrt(noise / count) / mean;
            const double goal = first.moonZenith == 49.8 ? 0.01 : 0.02; // partial, total: docs/eclipses.md
            CAPTURE(first.altitude, first.sunZenith, first.moonZenith, w, rms, noiseShare, sum / sky, normalised / count);
            // The square of the noise is itself uncertain, by sqrt(2 / rows) of it: three times that.
            CHECK(rms * rms < goal * goal + noiseShare * noiseShare * (1 + 3 * std::sqrt(2. / count)));
            CHECK(std::abs(sum / sky) < goal + 2 * noiseShare / std::sqrt(count));
            CHECK(normalised / count < 1 + 3 * std::sqrt(2. / count)); // each row within its error bar and 3 %
        }
    }
}
