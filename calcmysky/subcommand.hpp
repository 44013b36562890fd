#pragma once

#include <memory>
#include <vector>

namespace CLI {
class App;
}

namespace sky::cli {

struct Request;

/// `calcmysky NAME ...`: one file each, entered in subcommands.cpp.
class Subcommand
{
public:
    virtual ~Subcommand() = default;
    /// Adds the subcommand with its options to the command line and returns it. The options of the main command about
    /// OpenGL, progress and quiet are understood after the subcommand's name too; `run` finds them in the request.
    virtual CLI::App* addTo(CLI::App& app) = 0;
    /// Does the work; returns the exit code. Throws Error where it fails.
    virtual int run(const Request& request) = 0;
};

/// All subcommands, in the order of --help.
std::vector<std::unique_ptr<Subcommand>> makeSubcommands();

std::unique_ptr<Subcommand> makeDoctor();
std::unique_ptr<Subcommand> makeReference();
std::unique_ptr<Subcommand> makeVerify();

} // namespace sky::cli
