// calcmysky reference: radiances by the independent Monte Carlo judge, as a table.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "atmo/parse.hpp"
#include "base/error.hpp"
#include "ground_light.hpp"
#include "model/medium_tables.hpp"
#include "progress.hpp"
#include "reference_queries.hpp"
#include "solver/medium_tables.hpp"
#include "subcommand.hpp"
#include "values.hpp"
#include "verify_judge.hpp"
#include "verify_samples.hpp"

namespace sky::cli {

namespace {

/// What the judge needs to know of an atmosphere.
struct Atmosphere {
    std::string name;
    physics::Medium medium;
    int orders = 0; ///< as computed; 0: all
    EclipseScale eclipse;
};

Atmosphere readModel(const std::string& directory)
{
    const model::Model file = model::Model::open(directory);
    const auto& manifest = file.manifest();
    return {manifest.name,
            model::readMedium(file),
            manifest.allScatteringOrders ? 0 : manifest.scatteringOrders,
            {manifest.moonRadius, manifest.sunDistance}};
}

Atmosphere readDescription(const std::string& path, const gl::HeadlessOptions& openGl, Reporter& reporter)
{
    const atmo::Description description = atmo::parseFile(path);
    const gl::HeadlessContext context(openGl);
    std::vector<std::string> warnings;
    Atmosphere result{{},
                      solver::evaluateMedium(description, context.api(), warnings),
                      description.allScatteringOrders ? 0 : description.scatteringOrders,
                      {description.moonRadius, description.sunDistance}};
    for (const std::string& sentence : warnings)
        reporter.warning(sentence);
    return result;
}

class Reference : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        CLI::App* sub = app.add_subcommand("reference", "Compute sky radiances by Monte Carlo, slowly and independently");
        sub->add_option("atmosphere", atmosphere_, "A model's directory, or a .atmo file")->option_text("DIR|FILE");
        sub->add_option(
               "queries", queries_,
               "CSV: altitude_m, sza_deg, vza_deg, relaz_deg, lambda_nm; for eclipses moon_zenith_deg,\nmoon_azimuth_deg, earth_moon_distance_m")
            ->option_text("QUERIES.csv");
        sub->add_option("--grid", grid_, "default: the places that verify looks at, in place of a file")->option_text("NAME");
        sub->add_option("-o,--output", output_, "Where the table goes, in place of standard output")->option_text("OUT.csv");
        sub->add_option("--relative-error", relativeError_, "Standard error at which a row is done, a part of its radiance.\nDefault 0.001")
            ->option_text("X");
        sub->add_option("--seconds", seconds_, "Time for all rows together; the noisiest get the most. Default: no limit")
            ->option_text("T");
        sub->add_option("--ground-light", groundLight_,
                        "Light of a glowing ground in place of the Sun's, as a share of its\nradiance: all, or "
                        "distance=M,radius=M[,azimuth=DEG] for a disc")
            ->option_text("all|DISC");
        sub->add_option("--orders", orders_, "Scattering orders, or all. Default: those of the atmosphere")->option_text("N");
        sub->add_option("--seed", seed_, "Of the random numbers. Default 1")->option_text("N");
        return sub;
    }

    int run(const Request& request) override
    {
        if (atmosphere_.empty())
            throw UsageError("Which atmosphere? Give a model's directory or a .atmo file: "
                             "calcmysky reference DIR QUERIES.csv.");
        if (queries_.empty() == grid_.empty())
            throw UsageError("Where to look? Give either a file of queries or --grid default.");
        if (!grid_.empty())
            readChoice("--grid", grid_, {"default"});
        JudgeSettings settings;
        settings.seconds = seconds_;
        settings.seed = seed_;
        if (seconds_ < 0)
            throw UsageError("--seconds takes a time above 0.");
        if (!relativeError_.empty())
            settings.relativeError = readFraction("--relative-error", relativeError_);

        std::optional<montecarlo::GroundDisc> disc;
        if (!groundLight_.empty())
            disc = readGroundLight("--ground-light", groundLight_);

        const auto reporter = makeReporter(request.progress, request.quiet, standardError());
        reporter->stage("medium", 0);
        Atmosphere atmosphere =
            std::filesystem::is_directory(atmosphere_) ? readModel(atmosphere_) : readDescription(atmosphere_, request.gl, *reporter);
        if (atmosphere.name.empty())
            atmosphere.name = nameFromPath();
        const int usualOrders = groundLight_.empty() ? atmosphere.orders : 0; // light pollution has all of them
        settings.orders = orders_.empty() ? usualOrders : orders_ == "all" ? 0 : readInteger("--orders", orders_, 1, 1000);
        const std::vector<montecarlo::Query> queries = readAllQueries(atmosphere);
        const montecarlo::Reference reference(atmosphere.medium);
        reporter->stage("reference", 0.01);
        const auto advance = [&](double f) { reporter->advance(0.01 + 0.99 * f); };
        const auto results = groundLight_.empty() ? judge(reference, queries, settings, advance)
                                                  : judgeGroundLight(reference, queries, disc, settings, advance);
        reporter->finished();
        std::vector<montecarlo::Row> rows;
        for (std::size_t i = 0; i < queries.size(); ++i)
            rows.push_back({atmosphere.name, settings.orders, queries[i], results[i]});
        write(rows, atmosphere.medium.wavelengthsNm);
        return 0;
    }

private:
    /// File or directory name without its ending; commas would break the table.
    std::string nameFromPath() const
    {
        std::string name = std::filesystem::weakly_canonical(atmosphere_).stem().string();
        std::replace(name.begin(), name.end(), ',', '_');
        return name;
    }

    std::vector<montecarlo::Query> readAllQueries(const Atmosphere& atmosphere) const
    {
        constexpr int rowsPerCell = 12;
        std::vector<montecarlo::Query> queries;
        if (queries_.empty()) {
            for (const Sample& sample : sampleSky(atmosphere.medium, rowsPerCell))
                if (sample.query.altitude < atmosphere.medium.topOfAtmosphere) // not from space: tables stay those that were published
                    queries.push_back(sample.query);
            return queries;
        }
        std::ifstream file(queries_);
        if (!file)
            throw FileError("Can't read `" + queries_ + "`.");
        return readQueries(file, queries_, atmosphere.medium.wavelengthsNm, atmosphere.eclipse);
    }

    void write(const std::vector<montecarlo::Row>& rows, const std::vector<double>& wavelengthsNm) const
    {
        if (output_.empty()) {
            montecarlo::writeCsv(std::cout, rows, wavelengthsNm);
            std::cout << std::flush;
            return;
        }
        std::ofstream file(output_);
        montecarlo::writeCsv(file, rows, wavelengthsNm);
        file.close();
        if (!file)
            throw FileError("Can't write `" + output_ + "`.");
    }

    std::string atmosphere_, queries_, grid_, output_, relativeError_, orders_, groundLight_;
    double seconds_ = 0;
    std::uint64_t seed_ = 1;
};

} // namespace

std::unique_ptr<Subcommand> makeReference() { return std::make_unique<Reference>(); }

} // namespace sky::cli
