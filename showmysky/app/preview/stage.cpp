#include "stage.hpp"
#include "base/stopwatch.hpp"

#include <algorithm>

namespace showmysky::app::preview {

namespace {

constexpr double stepBudget = 0.015; // s
constexpr double comfortable = 0.03; // s, of a picture while things move
constexpr int mostReduction = 4;

/// The part of a scene that decides about light, not where one looks or how it is shown.
SceneOptions lightOf(SceneOptions scene)
{
    const SceneOptions plain;
    scene.projection = plain.projection;
    scene.fieldOfView = plain.fieldOfView;
    scene.yaw = plain.yaw;
    scene.pitch = plain.pitch;
    scene.development = plain.development;
    return scene;
}

} // namespace

SceneSettings settingsFor(const Sky& sky, const SceneOptions& scene)
{
    SceneSettings settings = scene.settings(sky);
    const auto names = sky.scatterers();
    auto& hidden = settings.layers.hiddenScatterers;
    hidden.erase(std::remove_if(hidden.begin(), hidden.end(),
                                [&](const auto& name) { return std::find(names.begin(), names.end(), name) == names.end(); }),
                 hidden.end());
    return settings;
}

void Stage::ask(Sky& sky, const SceneOptions& scene)
{
    SceneOptions light = lightOf(scene);
    if (asked_ == light)
        return;
    asked_ = std::move(light);
    try {
        const SceneSettings settings = settingsFor(sky, scene);
        refusal_ = sky.whyUnsupported(settings);
        if (refusal_.empty()) {
            sky.setSettings(settings);
            preparing_ = true;
        }
    } catch (const std::exception& error) {
        refusal_ = error.what();
    }
}

Stage::Result Stage::advance(Sky& sky, const SceneOptions& scene, const Canvas& canvas, bool moving, const std::function<void()>& finish)
{
    // What was begun is finished first: otherwise a Sun that is dragged would never arrive.
    if (!preparing_)
        ask(sky, scene);
    const sky::base::Stopwatch watch;
    while (preparing_ && watch.seconds() < stepBudget) {
        const Progress progress = sky.prepareStep();
        activity_ = progress.done ? std::string() : progress.activity;
        fraction_ = progress.fraction;
        preparing_ = !progress.done;
    }
    const bool behind = preparing_ || asked_ != lightOf(scene);
    reduction_ = 1;
    while (moving && reduction_ < mostReduction && fullSeconds_ / (reduction_ * reduction_) > comfortable)
        ++reduction_;
    const sky::base::Stopwatch drawing;
    Result result;
    try {
        // The camera goes on turning under the sky that was there before.
        result.drawn = preparing_ ? sky.drawPrepared(scene.camera(), canvas.width, canvas.height, reduction_)
                                  : sky.draw(scene.camera(), canvas.width, canvas.height, reduction_);
    } catch (const std::exception& error) {
        refusal_ = error.what();
        return {false, true};
    }
    if (result.drawn) {
        finish();
        drawSeconds_ = drawing.seconds();
        fullSeconds_ = drawSeconds_ * reduction_ * reduction_;
    }
    result.atRest = !behind && reduction_ == 1;
    return result;
}

} // namespace showmysky::app::preview
