#pragma once

#include <memory>
#include <vector>

namespace CLI {
class App;
}

namespace showmysky::app {

/// `showmysky NAME ...`: one file each, entered in subcommands.cpp.
class Subcommand
{
public:
    virtual ~Subcommand() = default;
    /// Adds the subcommand with its options to the command line and returns it.
    virtual CLI::App* addTo(CLI::App& app) = 0;
    /// Does the work; returns the exit code. Throws sky::Error or showmysky::Error where it fails.
    virtual int run() = 0;
};

/// All subcommands, in the order of --help.
std::vector<std::unique_ptr<Subcommand>> makeSubcommands();

std::unique_ptr<Subcommand> makeView();
std::unique_ptr<Subcommand> makeRender();
std::unique_ptr<Subcommand> makeMeasure();
std::unique_ptr<Subcommand> makeProbe();
std::unique_ptr<Subcommand> makeInfo();

} // namespace showmysky::app
