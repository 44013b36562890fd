// Error of a model against a table of reference radiances, by height of the Sun.
//
//   bench_accuracy MODEL REFERENCE.csv [--source moments|textures] [--rows]
//
// rms of the relative error of single + multiple scattering, with the reference's own noise removed:
// sqrt(mean(e^2) - mean(noise^2)). Textures need a model with spectral tables (calcmysky --radiance).

#include "base/error.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "model/scattering_table.hpp"
#include "physics/harmonics.hpp"
#include "physics/sky.hpp"
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>

using namespace sky;

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

struct Row {
    double altitude, sunZenith, viewZenith, azimuth, wavelength, radiance, noise;
};

std::vector<Row> readReference(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
        throw FileError("Can't read \"" + path + "\".");
    std::string line;
    std::getline(file, line);
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        std::vector<std::string> c;
        std::stringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            c.push_back(cell);
        if (c.size() < 11)
            throw FileError("\"" + path + "\": expected 11 columns in \"" + line + "\".");
        rows.push_back({std::stod(c[2]), std::stod(c[3]) * degree, std::stod(c[4]) * degree, std::stod(c[5]) * degree,
                        std::stod(c[6]), std::stod(c[7]) + std::stod(c[8]), std::stod(c[9])});
    }
    return rows;
}

/// Radiance per unit solar irradiance of one row.
using Source = std::function<double(const Row&, int wavelength)>;

Source fromMoments(const model::Model& file)
{
    struct State {
        physics::Medium medium;
        physics::Profile profile;
        physics::Optics optics;
        physics::SunTable sun;
        physics::Moments moments;
        physics::SkyEvaluator sky;
        physics::RayTracer tracer;
        State(const model::Model& m)
            : medium(model::readMedium(m)), profile(medium), optics(model::readOptics(m, medium)),
              sun(profile, optics, medium.sunAngularRadius, 192, 256), moments(model::readMoments(m)),
              sky(medium, profile, optics, sun), tracer(profile, optics)
        {
        }
    };
    auto s = std::make_shared<State>(file);
    return [s](const Row& r, int w) {
        const double mu = std::cos(r.viewZenith), muSun = std::cos(r.sunZenith);
        const double nu = mu * muSun + std::sin(r.viewZenith) * std::sin(r.sunZenith) * std::cos(r.azimuth);
        physics::SkyEvaluator::Parts parts;
        parts.singleNodes = 300;
        parts.multipleNodes = 40;
        std::vector<double> result(s->medium.wavelengthsNm.size());
        s->sky.radiance(s->tracer, &s->moments, r.altitude, mu, muSun, nu, parts, result.data());
        return result[w];
    };
}

Source fromTextures(const model::Model& file)
{
    struct State {
        physics::Medium medium;
        std::vector<std::pair<const physics::Species*, model::ScatteringTable>> single;
        model::ScatteringTable multiple;
        State(const model::Model& m) : medium(model::readMedium(m)), multiple(m, "multiple-scattering")
        {
            for (const auto& species : medium.species)
                if (species.scatters())
                    single.emplace_back(&species, model::ScatteringTable(m, "single-scattering/" + species.name));
        }
    };
    auto s = std::make_shared<State>(file);
    if (s->multiple.table().channels != model::Channels::SpectralRadiance)
        throw UsageError("This model holds luminance; make it with --radiance to compare spectra.");
    return [s](const Row& r, int w) {
        const double view = 90 * degree - r.viewZenith, sun = 90 * degree - r.sunZenith;
        const double nu = std::sin(view) * std::sin(sun) + std::cos(view) * std::cos(sun) * std::cos(r.azimuth);
        std::vector<double> value(s->medium.wavelengthsNm.size()), phase(value.size());
        s->multiple.sample(s->multiple.slice(r.altitude, sun), r.altitude, view, r.azimuth, value.data());
        double total = value[w];
        for (auto& [species, table] : s->single) {
            table.sample(table.slice(r.altitude, sun), r.altitude, view, r.azimuth, value.data());
            phase.assign(phase.size(), 1.);
            if (!species->smooth)
                physics::phaseFunctionAt(s->medium, *species, std::acos(std::clamp(nu, -1., 1.)), phase.data());
            total += value[w] * phase[w];
        }
        return total / s->medium.solarIrradiance[w];
    };
}

} // namespace

int main(int argc, char** argv)
{
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
        const Source evaluate = source == "moments" ? fromMoments(file) : fromTextures(file);
        const auto& wavelengths = file.manifest().wavelengthsNm;
        struct Sum {
            double squares = 0, noise = 0, error = 0;
            int count = 0;
        } sums[3];
        for (const Row& row : readReference(reference)) {
            int w = -1;
            for (std::size_t i = 0; i < wavelengths.size(); ++i)
                if (std::abs(wavelengths[i] - row.wavelength) < 0.01)
                    w = static_cast<int>(i);
            if (w < 0)
                continue;
            const double error = evaluate(row, w) / row.radiance - 1, noise = row.noise / row.radiance;
            Sum& sum = sums[row.sunZenith <= 86.01 * degree ? 0 : row.sunZenith <= 91.01 * degree ? 1 : 2];
            sum.squares += error * error;
            sum.noise += noise * noise;
            sum.error += error;
            ++sum.count;
            if (rows)
                std::printf("altitude %6.0f sun %5.1f view %5.1f azimuth %5.1f wavelength %7.3f error %+8.3f %% noise %6.3f %%\n",
                            row.altitude, row.sunZenith / degree, row.viewZenith / degree, row.azimuth / degree, row.wavelength,
                            100 * error, 100 * noise);
        }
        std::printf("regime     rows   rms error   mean error   noise of the judge\n");
        const char* names[] = {"day", "sunset", "twilight"};
        for (int i = 0; i < 3; ++i)
            if (const Sum& s = sums[i]; s.count > 0)
                std::printf("%-9s %5d   %7.3f %%   %+8.3f %%   %7.3f %%\n", names[i], s.count,
                            100 * std::sqrt(std::max(0., (s.squares - s.noise) / s.count)), 100 * s.error / s.count,
                            100 * std::sqrt(s.noise / s.count));
    } catch (const Error& error) {
        std::fprintf(stderr, "bench_accuracy: %s\n", error.what());
        return error.inputMustChange() ? 2 : 1;
    }
}
