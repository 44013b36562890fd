// Takes the place of view.cpp where GLFW or Dear ImGui was missing when showmysky was built.

#include "base/error.hpp"
#include "subcommand.hpp"
#include <CLI/CLI.hpp>

namespace showmysky::app {

namespace {

class View : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        auto* view = app.add_subcommand("view", "Open a window (not in this build)");
        view->allow_extras();
        return view;
    }

    int run() override
    {
        throw sky::UsageError("This showmysky was built without its window, because GLFW or Dear ImGui was missing. "
                              "`showmysky render MODEL -o sky.png` draws the same picture.");
    }
};

} // namespace

std::unique_ptr<Subcommand> makeView() { return std::make_unique<View>(); }

} // namespace showmysky::app
