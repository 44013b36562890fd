#include "viewer.hpp"

#include "base/angles.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "scene_file.hpp"
#include "spectrum_plot.hpp"
#include <cstdio>
#include <filesystem>

namespace showmysky::app::preview {

namespace {

constexpr double patienceIdle = 0.1, patienceWaiting = 0.02; // s between looks at files and child processes
constexpr int framesAfterEvent = 3;

std::string inWords(const EclipseState& state)
{
    using Phase = EclipseState::Phase;
    using sky::base::degree;
    const char* phase = state.phase == Phase::total     ? "total eclipse"
                        : state.phase == Phase::annular ? "annular eclipse"
                        : state.phase == Phase::partial ? "partial eclipse"
                                                        : "no eclipse";
    char text[160];
    std::snprintf(text, sizeof text, "%s: %.2f %% of the Sun is hidden, magnitude %.4f, centres %.4f degrees apart", phase,
                  100 * state.obscuration, state.magnitude, state.separation / degree);
    return text;
}

/// Why higher orders are followed on the fly; empty where they are looked up.
std::string whyNoTable(const Sky& sky, const SceneSettings& settings)
{
    if (const std::string why = sky.whyUnsupported(settings); !why.empty())
        return why;
    if (settings.source != Source::textures)
        return "Followed on the fly: the model's eclipse table belongs to its 4D textures.";
    if (sky.usesEclipseTable(settings))
        return {};
    char text[160];
    std::snprintf(text, sizeof text, "Followed on the fly: the table has the Moon on the Sun, %.0f km away, all orders, an even disc.",
                  sky.moonDistance() / 1e3);
    return text;
}

} // namespace

Viewer::Viewer(State state)
    : state_(std::move(state)), window_(state_.windowWidth, state_.windowHeight, "showmysky"), interface_(window_),
      context_(window_.loader()), developer_(context_.api()), screen_(context_.api()), exhibit_(window_.loader())
{
}

void Viewer::open(const std::string& path)
{
    if (std::filesystem::path(path).extension() == ".scene") {
        loadSceneFile(path);
        return;
    }
    exhibit_.open(path);
    window_.setTitle(path + " - showmysky");
}

void Viewer::saveSceneFile()
{
    try {
        saveScene(state_.scene, state_.sceneFile);
        note_ = "Saved " + state_.sceneFile + ".";
    } catch (const sky::Error& error) {
        note_ = error.what();
    }
}

void Viewer::loadSceneFile(const std::string& path)
{
    try {
        loadScene(state_.scene, path);
        limitFieldOfView(state_.scene);
        state_.sceneFile = path;
        note_ = "Loaded " + path + ".";
    } catch (const sky::Error& error) {
        note_ = error.what();
    }
}

void Viewer::obey(const Wishes& wishes)
{
    if (wishes.pick)
        pick_ = wishes.pick;
    if (wishes.closePick)
        pick_.reset();
    if (wishes.toggleChrome)
        chrome_ = !chrome_;
    if (wishes.reload)
        exhibit_.reload();
    if (wishes.save)
        saveSceneFile();
    quit_ = quit_ || wishes.quit;
    for (const auto& path : wishes.open)
        open(path);
}

void Viewer::handle(const std::vector<Event>& events)
{
    for (const auto& event : events) {
        const bool key = std::holds_alternative<KeyPressed>(event);
        const bool captured = key ? interface_.wantsKeys() : interface_.wantsPointer();
        const auto wishes = pointer_.handle(event, state_.scene, window_.size(), captured);
        obey(wishes);
        if (wishes.pick || wishes.closePick)
            atRest_ = false; // the light of another pixel is to be read
    }
}

void Viewer::learnAboutModel()
{
    const Sky& sky = *exhibit_.sky();
    stage_.forget();
    known_.scatterers = sky.scatterers();
    known_.topOfAtmosphere = sky.topOfAtmosphere();
    framesDue_ = framesAfterEvent;
    atRest_ = false;
}

void Viewer::updateRefusals()
{
    const Sky& sky = *exhibit_.sky();
    const auto why = [&](const auto& change) {
        SceneSettings settings;
        settings.altitude = state_.scene.altitude;
        settings.moon.distance = state_.scene.moonDistance;
        change(settings);
        return sky.whyUnsupported(settings);
    };
    known_.eclipseRefusal = why([](SceneSettings& s) { s.eclipse = EclipseMode::on; });
    known_.pollutionRefusal = why([&](SceneSettings& s) {
        s.layers.lightPollution = true;
        s.lightPollutionLuminance = state_.scene.lightPollution;
    });
    known_.texturesRefusal = why([](SceneSettings& s) { s.source = Source::textures; });
    known_.onTheFlyRefusal = why([&](SceneSettings& s) {
        s.source = state_.scene.source;
        s.onTheFlySingleScattering = true;
    });
    try {
        const SceneSettings settings = settingsFor(sky, state_.scene);
        known_.eclipseTableNote = whyNoTable(sky, settings);
        known_.obscuration = inWords(sky.eclipseState(settings));
    } catch (const std::exception& error) {
        known_.obscuration = error.what();
    }
}

void Viewer::updateModel()
{
    const std::string before = exhibit_.activity() + exhibit_.problem();
    if (exhibit_.update())
        learnAboutModel();
    if (exhibit_.activity() + exhibit_.problem() != before)
        framesDue_ = std::max(framesDue_, 2); // this one may be under way already
}

void Viewer::updateSky()
{
    Sky* sky = exhibit_.sky();
    if (!sky)
        return;
    SceneOptions scene = state_.scene;
    scene.development = {}; // what comes after the light
    const bool changed = !(lastScene_ == scene);
    lastScene_ = std::move(scene);
    if (changed || known_.obscuration.empty())
        updateRefusals();
    if (changed)
        atRest_ = false;
    if (atRest_)
        return;
    const auto result =
        stage_.advance(*sky, state_.scene, window_.framebuffer(), changed || pointer_.dragging(), [this] { context_.api()->Finish(); });
    const bool nowAtRest = result.atRest && !pointer_.dragging();
    if (result.drawn) {
        screen_.lightChanged();
        exposure_ = automaticExposure(developer_.sample(sky->luminanceTexture()));
    }
    if (pick_ && nowAtRest && sky->luminanceTexture() != 0) {
        const Point at = window_.inFramebuffer(*pick_);
        const Canvas size = window_.framebuffer();
        reading_ = readLight(*sky, {at.x / size.width, at.y / size.height});
    }
    if (!pick_)
        reading_.reset();
    framesDue_ = std::max(framesDue_, result.drawn || nowAtRest ? 2 : 0);
    atRest_ = nowAtRest;
}

PanelFacts Viewer::facts() const
{
    PanelFacts facts = known_;
    facts.model = exhibit_.path().string();
    facts.exposure = exposure_;
    facts.refusal = stage_.refusal();
    facts.activity = exhibit_.waiting() ? exhibit_.activity() : stage_.activity();
    facts.fraction = exhibit_.waiting() ? exhibit_.fraction() : stage_.fraction();
    facts.frameSeconds = frameSeconds_;
    facts.skySeconds = stage_.drawSeconds();
    facts.screenSeconds = screen_.seconds();
    facts.problem = exhibit_.problem();
    facts.note = note_;
    return facts;
}

void Viewer::drawFrame()
{
    const unsigned light = exhibit_.sky() ? exhibit_.sky()->luminanceTexture() : 0;
    auto development = state_.scene.development;
    if (development.automatic)
        development.exposure = exposure_;
    screen_.show(developer_, light, development, window_.framebuffer());
    if (chrome_) {
        const auto wishes = drawPanel(state_, facts());
        if (wishes.reload)
            exhibit_.reload();
        if (wishes.save)
            saveSceneFile();
        if (wishes.load)
            loadSceneFile(state_.sceneFile);
        if (pick_ && reading_ && !drawReading(*reading_, static_cast<float>(pick_->x), static_cast<float>(pick_->y)))
            pick_.reset();
    }
    drawNotice(facts(), light != 0);
    interface_.end();
    window_.show();
}

void Viewer::run()
{
    while (!window_.closing() && !quit_) {
        const bool busy = framesDue_ > 0 || (exhibit_.sky() && !atRest_);
        const auto events = window_.events(busy ? 0 : exhibit_.waiting() ? patienceWaiting : patienceIdle);
        const sky::base::Stopwatch watch;
        if (!events.empty())
            framesDue_ = framesAfterEvent;
        const bool drawing = framesDue_ > 0;
        if (drawing) {
            interface_.begin(events); // before the events: it knows which of them belong to widgets
            handle(events);
        }
        updateModel();
        updateSky();
        if (drawing) {
            drawFrame();
            --framesDue_;
            frameSeconds_ = watch.seconds();
        }
    }
    const Canvas size = window_.size();
    state_.windowWidth = size.width;
    state_.windowHeight = size.height;
}

} // namespace showmysky::app::preview
