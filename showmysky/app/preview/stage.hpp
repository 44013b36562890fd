#pragma once
// Gets the wanted scene drawn without a frame that takes long: tables in steps, fewer pixels while things move.

#include "input.hpp"
#include "scene_options.hpp"
#include "showmysky/sky.hpp"
#include <optional>
#include <string>

namespace showmysky::app::preview {

class Stage
{
public:
    /// What a call of advance did.
    struct Result {
        bool drawn = false;  ///< there is a new picture
        bool atRest = false; ///< the picture shows the wanted scene at full resolution (or the last one that was possible)
    };

    /// Does some tens of milliseconds of work for the scene.
    ///   finish  waits until what was drawn is there, to know how long it takes
    Result advance(Sky& sky, const SceneOptions& scene, const Canvas& canvas, bool moving, const std::function<void()>& finish);
    /// Another model: nothing is known of it.
    void forget() { *this = Stage(); }

    /// Why the wanted scene can't be drawn; empty if it can.
    const std::string& refusal() const { return refusal_; }
    /// What is being prepared; empty if nothing is.
    const std::string& activity() const { return activity_; }
    double fraction() const { return fraction_; }       ///< of it, 0..1
    double drawSeconds() const { return drawSeconds_; } ///< of the last picture

private:
    void ask(Sky& sky, const SceneOptions& scene);

    std::optional<SceneOptions> asked_; ///< without camera and development
    bool preparing_ = false;
    std::string refusal_, activity_;
    double fraction_ = 0;
    double drawSeconds_ = 0, fullSeconds_ = 0; ///< of the last picture; of one at full resolution, as it seems
    int reduction_ = 1;
};

/// What the library makes of a scene, without hidden scatterers that the model doesn't have.
///   throws  sky::UsageError as SceneOptions::settings
SceneSettings settingsFor(const Sky& sky, const SceneOptions& scene);

} // namespace showmysky::app::preview
