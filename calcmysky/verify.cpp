// calcmysky verify: how good is this model? Compares it with the Monte Carlo reference where it matters.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "model/evaluate.hpp"
#include "model/medium_tables.hpp"
#include "progress.hpp"
#include "subcommand.hpp"
#include "values.hpp"
#include "verify_judge.hpp"
#include "verify_report.hpp"
#include "verify_samples.hpp"

namespace sky::cli {

namespace {

/// Samples in each cell of regime and altitude: few enough that each is judged well, enough that they stand for the cell.
int rowsFor(const double seconds) { return std::clamp(static_cast<int>(seconds / 6), 6, 60); }

std::vector<VerifiedRow> evaluated(const model::Model& file, const model::SkySource source, const std::vector<Sample>& samples)
{
    const auto sky = model::openSky(file, source);
    std::vector<VerifiedRow> rows;
    for (const Sample& sample : samples) {
        const montecarlo::Query& q = sample.query;
        const auto w = static_cast<std::size_t>(q.wavelength);
        const auto radiance = sky->radiance({q.altitude, q.sunZenithAngle, q.viewZenithAngle, q.relativeAzimuth});
        rows.push_back({sample, file.manifest().wavelengthsNm[w], radiance.single[w], radiance.multiple[w], {}});
    }
    return rows;
}

class Verify : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        CLI::App* sub = app.add_subcommand("verify", "Say how accurate a model is, by Monte Carlo");
        sub->add_option("model", directory_, "The model's directory")->option_text("DIR");
        sub->add_option("--seconds", seconds_, "Time for the reference; more time, less noise. Default 60")->option_text("T");
        sub->add_option("--source", source_, "moments or textures (of a model made with --radiance).\nDefault: moments where there are any")
            ->option_text("NAME");
        sub->add_option("--json", json_, "Write all results there too, - for standard output in place of the table")->option_text("FILE");
        sub->add_option("--fail-above", failAbove_, "Exit code 1 where the rms error of any line of the table is above this part,\nor nothing could be judged")
            ->option_text("X");
        sub->add_option("--seed", seed_, "Of the random numbers. Default 1")->option_text("N");
        return sub;
    }

    int run(const Request& request) override
    {
        if (directory_.empty())
            throw UsageError("Which model? Give its directory: calcmysky verify DIR.");
        if (!(seconds_ > 0))
            throw UsageError("--seconds takes a time above 0.");
        std::optional<double> failAbove;
        if (!failAbove_.empty())
            failAbove = readFraction("--fail-above", failAbove_);
        const Verification verification = verify(request);
        if (json_ == "-") {
            writeJson(verification, std::cout);
        } else {
            printTable(verification, std::cout);
            if (!json_.empty())
                writeJsonFile(verification);
        }
        return failAbove && largestError(verification) > *failAbove ? 1 : 0;
    }

private:
    model::SkySource chosenSource(const model::Model& file) const
    {
        if (source_.empty())
            return model::usualSource(file);
        using enum model::SkySource;
        return std::vector{Moments, Textures}[readChoice("--source", source_, {"moments", "textures"})];
    }

    Verification verify(const Request& request) const
    {
        const base::Stopwatch watch;
        const model::Model file = model::Model::open(directory_);
        const model::SkySource source = chosenSource(file);
        const auto reporter = makeReporter(request.progress, request.quiet, standardError());
        Verification v;
        v.directory = directory_;
        v.source = source == model::SkySource::Moments ? "moments" : "textures";
        v.orders = file.manifest().allScatteringOrders ? 0 : file.manifest().scatteringOrders;
        const montecarlo::Reference reference(model::readMedium(file));
        v.scale = sampleScale(reference.medium());

        reporter->stage("model", 0);
        auto rows = evaluated(file, source, sampleSky(reference.medium(), rowsFor(seconds_)));
        reporter->stage("reference", 0.02);
        std::vector<montecarlo::Query> queries;
        for (const VerifiedRow& row : rows)
            queries.push_back(row.sample.query);
        JudgeSettings settings;
        settings.orders = v.orders;
        settings.seconds = seconds_;
        settings.seed = seed_;
        const auto judged = judge(reference, queries, settings, [&](double f) { reporter->advance(0.02 + 0.98 * f); });
        reporter->finished();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].judged = judged[i];
            if (isDark(judged[i]))
                ++v.darkRows;
            else if (!isSure(judged[i]))
                ++v.unsureRows;
            else
                v.rows.push_back(rows[i]);
        }
        v.seconds = watch.seconds();
        return v;
    }

    void writeJsonFile(const Verification& verification) const
    {
        std::ofstream file(json_);
        writeJson(verification, file);
        file.close();
        if (!file)
            throw FileError("--json: can't write `" + json_ + "`.");
    }

    std::string directory_, source_, json_, failAbove_;
    double seconds_ = 60;
    std::uint64_t seed_ = 1;
};

} // namespace

std::unique_ptr<Subcommand> makeVerify() { return std::make_unique<Verify>(); }

} // namespace sky::cli
