#include "help.hpp"

#include "solver/solve.hpp"

namespace sky::cli {

std::string partNames()
{
    std::string names;
    for (const solver::Part part : solver::allParts())
        names += (names.empty() ? "" : ", ") + nameOf(part);
    return names;
}

std::string versionText() { return "calcmysky " CALCMYSKY_VERSION; }

std::string helpHeader()
{
    return "Computes how the sky of a planet looks from a description of its air, and writes a model\n"
           "that showmysky and planetarium programs draw. Needs OpenGL 4.3, no window and no display.";
}

std::string helpFooter()
{
    return "Parts of a model: " + partNames() + R"(.

Examples:
  calcmysky earth.atmo --out-dir earth            the whole model
  calcmysky earth.atmo --out-dir earth --only moments
                                                  the small complete model, in seconds
  calcmysky earth.atmo --dry-run                  what would happen, and what it would cost
  calcmysky earth.atmo --out-dir ground --altitudes 0 --skip eclipsed
                                                  for an observer who stays on the ground
  sed s/0.3/0.9/ earth.atmo | calcmysky - --out-dir white
                                                  a description from another program

Exit codes: 0 done; 1 driver, disk or numbers failed; 2 the description or the options must change;
130 stopped by Ctrl-C. Where a run fails or is stopped, the old model stays as it was.

Environment: NO_COLOR turns colours off. All options: docs/options.md, the language: docs/language.md.
)";
}

std::string helpText(const CLI::App& app)
{
    std::string text = app.help();
    for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;)
        text.erase(at, 1);
    return text;
}

HelpFormatter::HelpFormatter() { column_width(34); }

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const
{
    if (app->get_parent())
        return "\nUsage: calcmysky " + app->get_name() + " [OPTION...]\n\n";
    return "\nUsage: " + name + " FILE --out-dir DIR [OPTION...]\n\n";
}

} // namespace sky::cli
