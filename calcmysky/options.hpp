#pragma once
// The command line, understood: what was asked, in types, with all contradictions already refused.

#include <filesystem>
#include <string>

#include "atmo/options.hpp"
#include "gl/context.hpp"
#include "solver/solve.hpp"
#include "subcommand.hpp"

namespace sky::cli {

enum class Action { Compute, DryRun, Validate, ListDevices, Subcommand, ShowText };
enum class ProgressStyle { Automatic, Bar, Json, None };

struct Request {
    Action action = Action::Compute;
    std::string text;                 ///< ShowText: help or version
    Subcommand* subcommand = nullptr; ///< Subcommand: which one
    std::string description;          ///< path of the .atmo file, "-" for standard input
    std::filesystem::path outDir;
    solver::Options solver;
    atmo::ParseOptions parsing;
    gl::HeadlessOptions gl;
    ProgressStyle progress = ProgressStyle::Automatic;
    bool quiet = false;
};

/// Understands the arguments.
///   throws  UsageError: one sentence, with a suggestion for a misspelt word
Request parseCommandLine(int argc, const char* const* argv, const std::vector<std::unique_ptr<Subcommand>>& subcommands);

} // namespace sky::cli
