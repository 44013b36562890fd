#pragma once
// The program without its libraries: from the arguments to the exit code.

#include <functional>
#include <string>
#include <vector>

#include "options.hpp"

namespace sky::cli {

/// What the program calls to do the work. main.cpp puts the libraries here, tests what they want to see.
struct Services {
    std::function<atmo::Description(const std::string& path, const atmo::ParseOptions&)> read; ///< path may be "-"
    /// Needs OpenGL only where the quality is to be picked; tells what it picked.
    std::function<std::vector<solver::PlanItem>(const atmo::Description&, const solver::Options&, const gl::HeadlessOptions&,
                                                solver::Progress&)>
        plan;
    std::function<void(const atmo::Description&, const solver::Options&, const gl::HeadlessOptions&, const std::filesystem::path& outDir,
                       solver::Progress&)>
        solve;
    std::function<void(const atmo::Description&, const gl::HeadlessOptions&)> validate;
};

/// 0 done, 1 failure, 2 the input must change, 130 interrupted.
int runProgram(int argc, const char* const* argv, const Services& services);

} // namespace sky::cli
