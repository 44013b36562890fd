#pragma once
// All that is computed without OpenGL: a model, settings, and the sky tables and spectra that follow from both.

#include "aerial.hpp"
#include "cities.hpp"
#include "eclipse_sky.hpp"
#include "glow.hpp"
#include "illuminance.hpp"
#include "moment_gather.hpp"
#include "painter.hpp"
#include "showmysky/sky.hpp"
#include "texture_lookup.hpp"
#include <atomic>
#include <future>
#include <optional>

namespace showmysky {

class Scene
{
public:
    explicit Scene(std::string directory) : directory_(std::move(directory)) {}
    ~Scene() { ending_ = true; }

    // Loading, in this order.
    static constexpr int loadSteps = 4;
    static const char* loadActivity(int step);
    void load(int step);

    const Atmosphere& atmosphere() const { return *atmosphere_; }
    const Phases& phases() const { return *phases_; }
    bool hasSource(Source source) const;
    /// The ground reflects light, but nothing tells what the sky sends it: models without moments.
    bool skyLeavesGroundDark() const;
    std::string whyUnsupported(const SceneSettings& settings) const;

    /// throws Error
    EclipseState eclipseState(const SceneSettings& settings) const;
    bool usesEclipseTable(const SceneSettings& settings) const;

    /// Checks and keeps the settings.   throws Error
    void setSettings(const SceneSettings& settings);
    const SceneSettings& settings() const { return settings_; }

    /// True if the tables of the present settings are there.
    bool ready() const { return ready_; }
    /// Does a part of the work towards them.
    Progress step();
    const SkyView& view() const { return view_; }
    const CityLight& cityLight() const { return cityView_; }
    SceneGeometry geometry() const;
    /// For hosts that ask: follows some lines of aerial perspective for the tables, which must be there; true once all is done.
    bool aerialStep();
    const Aerial& aerial() const { return *aerial_; }
    /// From the tables, which must be there, and the Sun.
    Illuminance illuminance() const;
    /// Counts changes of what the picture depends on.
    int version() const { return version_; }

    /// Spectral radiance in a direction, W m^-2 sr^-1 nm^-1, in double precision; without the solar disc.
    /// In an eclipse the tables must be there, or are made first.
    std::vector<double> spectralRadiance(const std::array<double, 3>& direction);

private:
    bool onceAtMost() const;
    LayersUsed layersUsed() const;
    double sunRadius() const;
    void followSunlight();
    ViewTable glow() const;
    bool lightCities();
    SkyView gathered(LayersUsed layers);
    ViewTable atLines(const ViewTable& table) const;
    ViewTable multipleOfLines() const;
    SkyView eclipsedView(const OrdinarySky& sky) const;
    SkyAxes skyAxes() const;
    Progress eclipseStep();
    EclipseScene eclipseScene() const;
    std::vector<Texel> sunColours(int count) const;
    Crescent crescent() const;
    Texel limbExponents() const;

    std::string directory_;
    std::unique_ptr<Atmosphere> atmosphere_;
    std::unique_ptr<Phases> phases_;
    std::optional<sky::physics::Moments> moments_;
    std::unique_ptr<sky::physics::SunTable> sun_;
    double tabulatedSunRadius_ = -1;
    std::unique_ptr<MomentGather> gather_;
    std::unique_ptr<TextureLookup> lookup_;
    std::unique_ptr<Glow> glow_;     ///< once light pollution has been asked for
    std::unique_ptr<Cities> cities_; ///< once there are some
    CityLight cityView_;
    std::unique_ptr<Aerial> aerial_;              ///< once a host has asked for it
    std::optional<SceneSettings> aerialSettings_; ///< that it is for
    SceneSettings settings_;
    std::unique_ptr<EclipseSky> eclipse_; ///< once an eclipse has been asked for
    OrdinarySky ordinary_;                ///< in an eclipse: what it dims
    ViewTable eclipsed_;                  ///< light of higher orders from the model's eclipse table; empty where it isn't used
    SkyView view_;
    bool ordinaryReady_ = false;
    bool ready_ = false;
    int version_ = 0;
    std::atomic<bool> ending_ = false; ///< calls off what the background does
    std::future<CityLight> citiesLit_; ///< in the background; last, so that it ends before what it reads
};

} // namespace showmysky
