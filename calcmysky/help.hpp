#pragma once
// The words of --help and --version.

#include <string>

#include <CLI/CLI.hpp>

namespace sky::cli {

/// Names of all parts of a model, separated by commas.
std::string partNames();

std::string versionText();
std::string helpHeader();
std::string helpFooter(); ///< examples, exit codes, environment

/// The help of `app`, or of the subcommand that was named; no more than one empty line in a row.
std::string helpText(const CLI::App& app);

/// CLI11's layout, with a usage line of ours.
class HelpFormatter : public CLI::Formatter
{
public:
    HelpFormatter();
    std::string make_usage(const CLI::App* app, std::string name) const override;
};

} // namespace sky::cli
