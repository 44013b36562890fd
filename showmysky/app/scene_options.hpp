#pragma once
// A scene as people write it: options of the command line, lines of a scene file, widgets of the window.

#include "development.hpp"
#include "showmysky/sky.hpp"
#include "solar_spectrum.hpp"
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace showmysky::app {

/// A city as people write it: distance=50km,azimuth=30,radius=5km,luminance=2,spectrum=1:2:3.
struct CityOption {
    double distance = 0, azimuth = 0, radius = 10e3, luminance = 1; ///< m, degrees, m, cd/m^2
    std::vector<double> spectrum{};                                 ///< empty: the model's

    City city() const;
    bool operator==(const CityOption&) const = default;
};
/// Cities separated by semicolons.   throws sky::UsageError: what was expected
std::vector<CityOption> parseCities(std::string_view text);
std::string toText(const std::vector<CityOption>& cities);

/// What is drawn and how. Angles in degrees, as people type them.
struct SceneOptions {
    double altitude = 0, sunZenith = 45, sunAzimuth = 0, moonZenith = 180, moonAzimuth = 0, moonDistance = 384400e3;
    double sunRadius = 0; ///< 0: as the model says
    double fieldOfView = 100, yaw = 0, pitch = 20;
    double lightPollution = 0;
    std::vector<CityOption> cities;
    double eclipseOrders = 0; ///< whole; 0: as the model has
    std::vector<std::string> layers{"zero", "single", "multiple"}, hiddenScatterers;
    SolarSpectrum solarSpectrum;
    Source source = Source::moments;
    Projection projection = Projection::perspective;
    bool eclipse = false, precomputedEclipse = false, eclipseFine = false, limbDarkening = false, onTheFly = false, mirror = false,
         unfiltered = false;
    Development development;

    /// Adds all options to a subcommand, and --scene, whose file comes before the others wherever it stands; the values
    /// land here when it is parsed.
    void addTo(CLI::App& app);
    /// throws  sky::UsageError where factors of the solar spectrum don't fit the model
    SceneSettings settings(const Sky& sky) const;
    Camera camera() const;
    /// The number named like its option without dashes.   throws sky::UsageError listing what there is
    double& number(const std::string& name);

    bool operator==(const SceneOptions&) const = default;
};

} // namespace showmysky::app
