// Error of a model against a table of reference radiances, by height of the Sun.
//
//   bench_accuracy MODEL REFERENCE.csv [--source moments|textures] [--rows]
//
// rms of the relative error of single + multiple scattering, with the reference's own noise removed
// (model/error_summary.hpp). Textures need a model with spectral tables (calcmysky --radiance).

#include "base/error.hpp"
#include "model/error_summary.hpp"
#include "model/medium_tables.hpp"
#include "reference_table.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>

using namespace sky;

int main(int argc, char** argv)
{
    constexpr double degree = 3.14159265358979323846 / 180;
    CLI::App app{"Error of a model against reference radiances, by height of the Sun."};
    std::string directory, reference, source = "moments";
    bool rows = false;
    app.add_option("model", directory, "model directory")->required();
    app.add_option("reference", reference, "CSV of reference radiances")->required();
    app.add_option("--source", source, "what to judge")->check(CLI::IsMember({"moments", "textures"}));
    app.add_flag("--rows", rows, "print every row");
    CLI11_PARSE(app, argc, argv);
    try {
        const auto file = model::Model::open(directory);
        const auto sky = model::openSky(file, source == "moments" ? model::SkySource::Moments : model::SkySource::Textures);
        model::ErrorSummary sums[4]; // by regime; all seen from high up
        const auto scale = cli::sampleScale(model::readMedium(file));
        for (const auto& row : bench::readReference(reference)) {
            const int w = bench::wavelengthIndex(row, file.manifest().wavelengthsNm);
            if (w < 0)
                continue;
            const auto radiance = sky->radiance(row.geometry);
            const double error = (radiance.single[w] + radiance.multiple[w]) / row.radiance - 1, noise = row.noise / row.radiance;
            sums[bench::regimeOf(row, scale)].add(error, noise);
            if (bench::isHigh(row, scale))
                sums[3].add(error, noise);
            if (rows)
                std::printf("altitude %6.0f sun %5.1f view %5.1f azimuth %5.1f wavelength %7.3f error %+8.3f %% noise %6.3f %%\n",
                            row.geometry.altitude, row.geometry.sunZenithAngle / degree, row.geometry.viewZenithAngle / degree,
                            row.geometry.relativeAzimuth / degree, row.wavelengthNm, 100 * error, 100 * noise);
        }
        std::printf("regime         rows   rms error     +/-       mean error   noise of the judge\n");
        for (int i = 0; i < 4; ++i)
            if (const auto& s = sums[i]; s.rows() > 0)
                std::printf("%-13s %5d   %7.3f %%   %5.3f %%   %+8.3f %%   %7.3f %%\n", i < 3 ? bench::regimeNames[i] : "from high up",
                            s.rows(), 100 * s.rms(), 100 * s.uncertainty(), 100 * s.mean(), 100 * s.noise());
    } catch (const Error& error) {
        std::fprintf(stderr, "bench_accuracy: %s\n", error.what());
        return error.inputMustChange() ? 2 : 1;
    }
}
