// showmysky info: what a model holds.

#include "model/model.hpp"
#include "subcommand.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <sstream>

namespace showmysky::app {

namespace {

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string size(double bytes)
{
    const char* unit = bytes < 1e6 ? "kB" : "MB";
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %s", bytes / (bytes < 1e6 ? 1e3 : 1e6), unit);
    return text;
}

void printTable(std::ostream& out, const sky::model::Model& model, const sky::model::Table& table)
{
    out << "  " << table.name << ": " << table.quantity << ", " << table.unit << "\n    ";
    for (const auto& axis : table.axes)
        out << axis.nodes.size() << " " << axis.name << " x ";
    out << table.channelCount() << " channels, " << (table.half ? "half" : "float") << ", " << table.significandBits << " bits; "
        << table.file << ", " << size(static_cast<double>(model.manifest().files.at(table.file).bytes)) << "\n";
}

void print(std::ostream& out, const sky::model::Model& model)
{
    const auto& m = model.manifest();
    out << (m.name.empty() ? model.directory().string() : m.name) << ", made by " << m.generator << "\n\n"
        << "planet radius        " << number(m.planetRadius / 1e3) << " km\n"
        << "top of atmosphere    " << number(m.topOfAtmosphere / 1e3) << " km\n"
        << "Sun's angular radius " << number(m.sunAngularRadius * 180 / 3.14159265358979323846) << " degrees\n"
        << "wavelengths          " << m.wavelengthCount() << ", " << number(m.wavelengthsNm.front()) << " to "
        << number(m.wavelengthsNm.back()) << " nm\n"
        << "scattering orders    " << (m.allScatteringOrders ? "all" : std::to_string(m.scatteringOrders)) << "\n\n"
        << "species\n";
    for (const auto& species : m.species)
        out << "  " << species.name << (species.scatters ? ", scatters, phase function " + species.phaseFunctionType : ", absorbs only")
            << "\n";
    out << "\ntables\n";
    double bytes = 0;
    for (const auto& table : model.tables())
        printTable(out, model, table);
    for (const auto& [file, info] : m.files)
        bytes += static_cast<double>(info.bytes);
    out << "  all files: " << size(bytes) << "\n";
    if (!m.settings.empty())
        out << "\nsettings\n";
    for (const auto& [name, value] : m.settings)
        out << "  " << name << " = " << value << "\n";
    if (!m.estimatedError.empty())
        out << "\nestimated relative error\n";
    for (const auto& [name, value] : m.estimatedError)
        out << "  " << name << ": " << number(value) << "\n";
    if (!m.skipped.empty())
        out << "\nskipped\n";
    for (const auto& skipped : m.skipped)
        out << "  " << skipped.what << ": " << skipped.why << "\n";
    if (!m.warnings.empty())
        out << "\nwarnings\n";
    for (const auto& warning : m.warnings)
        out << "  " << warning << "\n";
}

class Info : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        auto* entry = app.add_subcommand("info", "Print what a model holds");
        entry->add_option("DIR", directory_, "Model directory.")->required();
        entry->add_flag("--json", json_, "Print the manifest as JSON, checked and in canonical order.");
        entry->add_flag("--verify", verify_, "Compare the checksums of all files.");
        return entry;
    }

    int run() override
    {
        const auto model = sky::model::Model::open(directory_);
        if (verify_)
            model.verifyChecksums();
        if (json_)
            std::cout << sky::model::writeManifest(model.manifest());
        else
            print(std::cout, model);
        if (verify_ && !json_)
            std::cout << "\nAll " << model.manifest().files.size() << " files have the checksums of the manifest.\n";
        return 0;
    }

private:
    std::string directory_;
    bool json_ = false, verify_ = false;
};

} // namespace

std::unique_ptr<Subcommand> makeInfo() { return std::make_unique<Info>(); }

} // namespace showmysky::app
