// showmysky probe: numbers of the sky for a table of questions.

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/suggest.hpp"
#include "probe_queries.hpp"
#include "probe_sources.hpp"
#include "scene_options.hpp"
#include "subcommand.hpp"
#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <sstream>

namespace showmysky::app {

namespace {

constexpr int exitInput = 2;

unsigned parseLayers(const std::string& list)
{
    const std::vector<std::pair<std::string, unsigned>> known{{"zero", Photometer::zeroOrder},
                                                              {"single", Photometer::singleScattering},
                                                              {"multiple", Photometer::multipleScattering},
                                                              {"light-pollution", Photometer::lightPollution}};
    unsigned layers = 0;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
        const auto found = std::find_if(known.begin(), known.end(), [&](const auto& layer) { return layer.first == word; });
        if (found == known.end())
            throw sky::UsageError("--layers knows zero, single, multiple and light-pollution, not \"" + word + "\"." +
                                  sky::suggestion(word, {"zero", "single", "multiple", "light-pollution"}));
        layers |= found->second;
    }
    if (layers == 0)
        throw sky::UsageError("--layers is empty; expected some of zero, single, multiple, light-pollution.");
    return layers;
}

class Probe : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        auto* entry = app.add_subcommand("probe", "Answer a table of questions: spectral radiance or luminance of directions");
        entry->add_option("DIR", directory_, "Model directory.")->required();
        entry->add_option("QUERIES", queries_,
                          "CSV file with a header of altitude_m, sun_zenith_deg, sun_azimuth_deg, "
                          "view_zenith_deg, view_azimuth_deg; - for standard input.");
        entry->add_option("-o,--output", output_, "CSV file to write; - (the default) for standard output.");
        entry->add_option("--source", source_, "moments (the default), textures, or cpu: the moments in double precision.");
        entry->add_option("--layers", layers_, "Light to add up: some of zero,single,multiple,light-pollution (default: the first three).");
        entry
            ->add_option("--city", cities_,
                         "Add the light of a city: distance=50km,azimuth=30,radius=5km,luminance=2[,spectrum=A:B:...]; "
                         "repeat it, or separate more by semicolons.")
            ->allow_extra_args(false);
        entry->add_flag("--precomputed-eclipse", precomputedEclipse_,
                        "With --source textures: where Sun and Moon stand concentric, take higher orders from the model's table of "
                        "eclipses; elsewhere they are followed on the fly.");
        entry->add_flag("--benchmark", benchmark_, "Print how long one question takes, instead of answering any.");
        return entry;
    }

    int run() override
    {
        const unsigned layers = parseLayers(layers_);
        if (benchmark_)
            return measure(layers);
        if (queries_.empty())
            throw sky::UsageError("probe needs a CSV file of questions, or - for standard input.");
        const ProbeQueries queries = read();
        if (!queries.complaints.empty()) {
            for (const auto& complaint : queries.complaints)
                std::cerr << complaint << "\n";
            return exitInput;
        }
        const auto source = makeSource();
        std::string text = queries.header;
        const auto columns = source->columns();
        for (const auto& column : columns)
            text += "," + column;
        text += "\n";
        const auto cities = parsedCities();
        std::optional<Photometer> photometer;
        if (!cities.empty())
            photometer.emplace(directory_);
        std::vector<double> values(columns.size());
        for (std::size_t i = 0; i < queries.views.size(); ++i) {
            source->answer(queries.views[i], queries.moons.empty() ? nullptr : &queries.moons[i], layers, values.data());
            if (!cities.empty())
                addCities(*photometer, queries.views[i], cities, values);
            text += queries.lines[i];
            for (const double value : values) {
                char number[32];
                std::snprintf(number, sizeof number, ",%.8g", value);
                text += number;
            }
            text += "\n";
        }
        write(text);
        return 0;
    }

private:
    std::unique_ptr<ProbeSource> makeSource() const
    {
        if (source_ == "textures")
            return makeTextureSource(directory_, precomputedEclipse_);
        if (source_ != "moments" && source_ != "cpu")
            throw sky::UsageError("--source is \"" + source_ + "\"; expected moments, textures or cpu.");
        return makeMomentSource(directory_, source_ == "cpu" ? Photometer::Method::reference : Photometer::Method::fast);
    }

    std::vector<City> parsedCities() const
    {
        std::vector<City> cities;
        for (const auto& text : cities_)
            for (const auto& city : parseCities(text))
                cities.push_back(city.city());
        return cities;
    }

    static void addCities(const Photometer& photometer, const Photometer::View& view, const std::vector<City>& cities,
                          std::vector<double>& values)
    {
        std::vector<double> spectrum(photometer.wavelengthsNm().size());
        photometer.cityRadiance(&view, 1, cities, spectrum.data());
        if (values.size() == spectrum.size()) {
            for (std::size_t w = 0; w < values.size(); ++w)
                values[w] += spectrum[w];
            return;
        }
        const auto colour = photometer.colourOf(spectrum.data());
        const double parts[] = {colour.X, colour.Y, colour.Z, colour.scotopic};
        for (std::size_t c = 0; c < 4; ++c)
            values[c] += parts[c];
    }

    ProbeQueries read() const
    {
        if (queries_ == "-")
            return readQueries(std::cin, "standard input");
        std::ifstream file(queries_);
        if (!file)
            throw sky::UsageError("The file '" + queries_ + "' can't be read.");
        return readQueries(file, queries_);
    }

    void write(const std::string& text) const
    {
        if (output_ == "-") {
            std::cout << text << std::flush;
            if (!std::cout)
                throw sky::FileError("Standard output can't be written.");
            return;
        }
        std::ofstream file(output_);
        file << text;
        file.close();
        if (!file)
            throw sky::FileError("The file '" + output_ + "' can't be written.");
    }

    /// Mean time of a question in the fastest of many short runs: other work on the machine counts least so.
    int measure(unsigned layers) const
    {
        const Photometer photometer(directory_, source_ == "cpu" ? Photometer::Method::reference : Photometer::Method::fast);
        constexpr int questions = 50, runs = 100;
        std::mt19937 random(1);
        std::uniform_real_distribution<double> unit;
        std::vector<Photometer::View> views(questions);
        std::vector<double> spectra(questions * photometer.wavelengthsNm().size());
        const auto fastest = [&](bool sameRay) {
            double best = 1e9;
            for (int run = 0; run < runs; ++run) {
                for (auto& view : views)
                    view = {sameRay ? 1000 : unit(random) * 0.1 * photometer.topOfAtmosphere(), unit(random) * 1.66, 0,
                            sameRay ? 1 : unit(random) * 1.57, unit(random) * 6.28};
                const sky::base::Stopwatch watch;
                photometer.radianceMany(views.data(), views.size(), layers, spectra.data());
                best = std::min(best, watch.seconds() / questions);
            }
            return best * 1e6;
        };
        std::printf("%zu wavelengths, layers %s, one thread\n", photometer.wavelengthsNm().size(), layers_.c_str());
        std::printf("any direction                         %6.1f us\n", fastest(false));
        std::printf("same altitude and view zenith angle   %6.1f us\n", fastest(true));
        return 0;
    }

    std::vector<std::string> cities_;
    std::string directory_, queries_, output_ = "-", source_ = "moments", layers_ = "zero,single,multiple";
    bool benchmark_ = false, precomputedEclipse_ = false;
};

} // namespace

std::unique_ptr<Subcommand> makeProbe() { return std::make_unique<Probe>(); }

} // namespace showmysky::app
