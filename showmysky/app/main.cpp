// showmysky: what was asked goes to the subcommand that does it; errors become sentences and exit codes.

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "showmysky/error.hpp"
#include "subcommand.hpp"
#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

namespace {

constexpr int exitFailure = 1, exitInput = 2;

int complain(const std::string& message, int code)
{
    std::cerr << "showmysky: " << message << std::endl;
    return code;
}

/// `showmysky MODEL ...` is `showmysky view MODEL ...`.
///   throws  sky::UsageError where the first word is neither a subcommand nor a path
std::vector<std::string> withSubcommand(const std::vector<CLI::App*>& subcommands, std::vector<std::string> words)
{
    if (words.empty() || words[0].substr(0, 1) == "-")
        return words;
    std::vector<std::string> names;
    for (const auto* subcommand : subcommands)
        names.push_back(subcommand->get_name());
    if (std::find(names.begin(), names.end(), words[0]) != names.end())
        return words;
    if (!std::filesystem::exists(words[0]))
        throw sky::UsageError("`" + words[0] + "` is neither a subcommand nor a model or description." + sky::suggestion(words[0], names));
    words.insert(words.begin(), "view");
    return words;
}

} // namespace

int main(int argc, char** argv)
{
    using namespace showmysky;
    CLI::App app{"Shows the sky of a model made by calcmysky: `showmysky MODEL` opens a window."};
    app.name("showmysky");
    app.set_version_flag("--version", SHOWMYSKY_VERSION);
    app.require_subcommand(1);
    const auto subcommands = app::makeSubcommands();
    std::vector<CLI::App*> entries;
    for (const auto& subcommand : subcommands)
        entries.push_back(subcommand->addTo(app));
    try {
        auto words = withSubcommand(entries, {argv + 1, argv + argc});
        std::reverse(words.begin(), words.end()); // as the parser wants them
        app.parse(std::move(words));
        for (std::size_t i = 0; i < entries.size(); ++i)
            if (*entries[i])
                return subcommands[i]->run();
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : (app.exit(error), exitInput);
    } catch (const sky::Error& error) {
        return complain(error.what(), error.inputMustChange() ? exitInput : exitFailure);
    } catch (const Error& error) {
        const bool input = error.kind() != ErrorKind::openGl && error.kind() != ErrorKind::other;
        return complain(error.what(), input ? exitInput : exitFailure);
    } catch (const std::exception& error) {
        return complain(std::string("Something failed that should not: ") + error.what(), exitFailure);
    }
    return exitFailure;
}
