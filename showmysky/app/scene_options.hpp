#pragma once
// Every scene setting as an option of the command line.

#include "picture.hpp"
#include "showmysky/sky.hpp"
#include <CLI/CLI.hpp>
#include <functional>

namespace showmysky::app {

/// What `render` draws. Angles in degrees, as people type them.
struct SceneOptions {
    double altitude = 0, sunZenith = 45, sunAzimuth = 0, moonZenith = 180, moonAzimuth = 0, moonDistance = 384400e3;
    double sunRadius = 0; ///< 0: as the model says
    double fieldOfView = 100, yaw = 0, pitch = 20;
    double lightPollution = 0;
    std::vector<std::string> layers{"zero", "single", "multiple"}, hiddenScatterers;
    std::vector<double> solarSpectrum;
    Source source = Source::moments;
    Projection projection = Projection::perspective;
    bool eclipse = false, onTheFly = false, mirror = false, unfiltered = false;
    Development development;

    /// Adds all options to a subcommand; the values land here when it is parsed.
    void addTo(CLI::App& app);
    SceneSettings settings() const;
    Camera camera() const;
    /// The number named like its option without dashes.   throws sky::UsageError listing what there is
    double& number(const std::string& name);
};

} // namespace showmysky::app
