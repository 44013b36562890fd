// calcmysky: what was asked (options.cpp) goes to the libraries that can do it.

#include <iostream>
#include <iterator>
#include <optional>

#include "atmo/parse.hpp"
#include "base/error.hpp"
#include "gl/context.hpp"
#include "program.hpp"
#include "solver/medium_tables.hpp"
#include "solver/quality.hpp"
#include "solver/solve.hpp"

int main(int argc, char** argv)
{
    using namespace sky;
    cli::Services services;
    services.read = [](const std::string& path, const atmo::ParseOptions& options) {
        if (path != "-")
            return atmo::parseFile(path, options);
        const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
        return atmo::parse(text, "<standard input>", ".", options);
    };
    services.plan = [](const atmo::Description& description, const solver::Options& options, const gl::HeadlessOptions& openGl,
                       solver::Progress& progress) {
        std::optional<gl::HeadlessContext> context;
        try {
            context.emplace(openGl);
        } catch (const GlError& error) {
            if (options.qualityByTolerance)
                throw;
            progress.warning(std::string(error.what()) + " What the air asks for is not known.");
            return solver::plan(description, options);
        }
        std::vector<std::string> warnings; // solve() will give them
        const auto medium = solver::evaluateMedium(description, context->api(), warnings);
        const auto settled = solver::settled(options, medium, progress);
        auto plan = solver::plan(description, settled, &medium);
        if (const auto sentence = solver::beyondMemory(plan, settled))
            progress.warning(*sentence);
        return plan;
    };
    services.solve = [](const atmo::Description& description, const solver::Options& options, const gl::HeadlessOptions& openGl,
                        const std::filesystem::path& outDir, solver::Progress& progress) {
        gl::HeadlessContext context(openGl);
        solver::solve(description, options, context, outDir, progress);
    };
    services.validate = [](const atmo::Description& description, const gl::HeadlessOptions& openGl) {
        gl::HeadlessContext context(openGl);
        solver::validate(description, context);
    };
    return cli::runProgram(argc, argv, services);
}
