// showmysky MODEL, in full `showmysky view MODEL`: the window.

#include "base/error.hpp"
#include "preferences.hpp"
#include "subcommand.hpp"
#include "viewer.hpp"
#include <CLI/CLI.hpp>
#include <filesystem>

namespace showmysky::app {

namespace {

class View : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        auto* view = app.add_subcommand("view", "Open a window; `showmysky MODEL` is short for it");
        view->add_option("MODEL", model_, "model directory or .atmo file; without it, drop one on the window");
        state_.scene.addTo(*view);
        // Before any option: what the command line says goes before what the last window left.
        view->preparse_callback([this](std::size_t) { remember(); });
        return view;
    }

    int run() override
    {
        if (!model_.empty() && !std::filesystem::exists(model_))
            throw sky::UsageError("There is no model or description `" + model_ + "`.");
        preview::limitFieldOfView(state_.scene);
        preview::Viewer viewer(state_);
        viewer.note(note_);
        if (!model_.empty())
            viewer.open(model_);
        viewer.run();
        savePreferences(viewer.state());
        return 0;
    }

private:
    void remember()
    {
        try {
            loadPreferences(state_);
        } catch (const sky::Error& error) {
            note_ = std::string("Settings of the last time are lost: ") + error.what();
        }
    }

    std::string model_, note_;
    preview::State state_;
};

} // namespace

std::unique_ptr<Subcommand> makeView() { return std::make_unique<View>(); }

} // namespace showmysky::app
