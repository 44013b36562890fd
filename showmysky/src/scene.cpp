#include "scene.hpp"

#include "base/angles.hpp"
#include "bodies.hpp"
#include "model/eclipse_table.hpp"
#include "model/moment_tables.hpp"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::pi;
/// The table of sunlight: coarser than the solver's, error below 1e-3 (tests/showmysky/scene.cpp).
constexpr int sunAltitudes = 64, sunElevations = 96;
/// Rays that a step of preparation follows.
constexpr int raysPerStep = 16;
/// Lines of aerial perspective that one follows: each costs more.
constexpr int linesPerStep = 8;
/// Heights on the disc at which the Sun's light is followed for its illuminance.
constexpr int illuminanceSamples = 33;
/// That a step waits for the light of cities.
constexpr std::chrono::milliseconds cityPatience{10};
/// Whatever a model asks for, its tables stay within what textures can hold.
constexpr int mostEclipseSize = 256;

bool same(const Layers& a, const Layers& b)
{
    return a.zeroOrder == b.zeroOrder && a.singleScattering == b.singleScattering && a.multipleScattering == b.multipleScattering &&
           a.lightPollution == b.lightPollution && a.hiddenScatterers == b.hiddenScatterers;
}

/// True if both ask for the same sky tables, the Moon aside.
bool sameTables(const SceneSettings& a, const SceneSettings& b)
{
    return a.altitude == b.altitude && a.sun.zenithAngle == b.sun.zenithAngle && a.sun.angularRadius == b.sun.angularRadius &&
           same(a.layers, b.layers) && a.lightPollutionLuminance == b.lightPollutionLuminance && a.cities == b.cities &&
           a.source == b.source && a.onTheFlySingleScattering == b.onTheFlySingleScattering &&
           a.solarSpectrumFactors == b.solarSpectrumFactors;
}

/// True if the Moon takes the same light in both.
bool sameEclipse(const SceneSettings& a, const SceneSettings& b)
{
    if (a.eclipse != b.eclipse)
        return false;
    return a.eclipse == EclipseMode::off ||
           (a.sun.azimuth == b.sun.azimuth && a.moon.azimuth == b.moon.azimuth && a.moon.zenithAngle == b.moon.zenithAngle &&
            a.moon.distance == b.moon.distance && a.eclipseOrders == b.eclipseOrders && a.eclipseFine == b.eclipseFine &&
            a.limbDarkening == b.limbDarkening && a.precomputedEclipse == b.precomputedEclipse && a.pseudoMirror == b.pseudoMirror);
}

void require(bool fine, const std::string& message)
{
    if (!fine)
        throw Error(ErrorKind::settings, message);
}

} // namespace

const char* Scene::loadActivity(int step)
{
    static constexpr const char* names[loadSteps] = {"Reading the medium", "Reading the moments", "Tabulating phase functions",
                                                     "Following sunlight"};
    return names[step];
}

void Scene::load(int step)
{
    if (step == 0)
        atmosphere_ = std::make_unique<Atmosphere>(directory_);
    else if (step == 1 && atmosphere_->model.hasTable("moments"))
        moments_ = sky::model::readMoments(atmosphere_->model);
    else if (step == 2)
        phases_ = std::make_unique<Phases>(*atmosphere_);
    else if (step == 3) {
        lookup_ = std::make_unique<TextureLookup>(*atmosphere_, *phases_);
        if (!hasSource(settings_.source))
            settings_.source = hasSource(Source::moments) ? Source::moments : Source::textures;
        followSunlight();
    }
}

double Scene::sunRadius() const { return settings_.sun.angularRadius.value_or(atmosphere_->medium.sunAngularRadius); }

void Scene::followSunlight()
{
    gather_.reset();
    eclipse_.reset();
    aerial_.reset();
    aerialSettings_.reset();
    ordinaryReady_ = false;
    tabulatedSunRadius_ = sunRadius();
    sun_ = std::make_unique<physics::SunTable>(atmosphere_->profile, atmosphere_->optics, tabulatedSunRadius_, sunAltitudes, sunElevations);
    gather_ = std::make_unique<MomentGather>(*atmosphere_, *phases_, moments_ ? &*moments_ : nullptr, *sun_, tabulatedSunRadius_);
}

bool Scene::onceAtMost() const { return sky::model::scattersOnceAtMost(atmosphere_->model.manifest()); }

bool Scene::skyLeavesGroundDark() const
{
    const auto& albedo = atmosphere_->medium.groundAlbedo;
    return !moments_ && !onceAtMost() && std::any_of(albedo.begin(), albedo.end(), [](double a) { return a > 0; });
}

bool Scene::hasSource(Source source) const
{
    return source == Source::moments ? atmosphere_->model.hasTable("moments") || onceAtMost()
                                     : TextureLookup::missingTable(*atmosphere_).empty();
}

std::string Scene::whyUnsupported(const SceneSettings& settings) const
{
    if (settings.layers.lightPollution && (settings.lightPollutionLuminance > 0 || settings.cities.empty()))
        if (const std::string why = Glow::whyMissing(atmosphere_->model); !why.empty())
            return why;
    if (!hasSource(settings.source))
        return settings.source == Source::moments ? "The model holds no moments; compute it anew, or choose the 4D textures as source."
                                                  : "The model lacks the table `" + TextureLookup::missingTable(*atmosphere_) +
                                                        "`; compute it with all textures, or choose the moments as source.";
    if (settings.source == Source::textures) {
        if (settings.altitude > atmosphere_->planet().topOfAtmosphere)
            return "The 4D textures end at the top of the atmosphere; above it, choose the moments as source.";
        if (!settings.solarSpectrumFactors.empty() && TextureLookup::anyLuminance(*atmosphere_))
            return "The 4D textures of this model hold luminance, on which another solar spectrum can't act; compute "
                   "it with "
                   "--radiance, or choose the moments as source.";
        if (settings.eclipse == EclipseMode::on && settings.precomputedEclipse && !onceAtMost() &&
            !atmosphere_->model.hasTable(sky::model::eclipseTable))
            return "The model holds no table of eclipses; compute it without --no-eds-tex, or let eclipses be followed on the fly.";
    }
    return {};
}

void Scene::setSettings(const SceneSettings& settings)
{
    require(std::isfinite(settings.altitude) && settings.altitude >= 0, "The altitude must be a number of metres, at least 0.");
    require(std::isfinite(settings.sun.azimuth) && std::isfinite(settings.moon.azimuth), "An azimuth must be a number.");
    require(settings.sun.zenithAngle >= 0 && settings.sun.zenithAngle <= pi + 1e-9,
            "The zenith angle of the Sun must be between 0 and 180 degrees.");
    require(settings.moon.zenithAngle >= 0 && settings.moon.zenithAngle <= pi + 1e-9,
            "The zenith angle of the Moon must be between 0 and 180 degrees.");
    require(!settings.sun.angularRadius || (*settings.sun.angularRadius > 0 && *settings.sun.angularRadius < 0.5),
            "The angular radius of the Sun must be above 0 and below 0.5 radians.");
    require(std::isfinite(settings.lightPollutionLuminance) && settings.lightPollutionLuminance >= 0,
            "The luminance of the ground must be a number of cd/m^2, at least 0.");
    require(settings.eclipseOrders == 0 || settings.eclipseOrders >= 2,
            "The orders of scattering in an eclipse must be at least 2, or 0 for those of the model.");
    if (settings.eclipse == EclipseMode::on)
        eclipseState(settings); // throws if the Moon can't be there
    const auto& factors = settings.solarSpectrumFactors;
    require(factors.empty() || factors.size() == static_cast<std::size_t>(atmosphere_->wavelengths()),
            "The solar spectrum needs one factor for each of the " + std::to_string(atmosphere_->wavelengths()) + " wavelengths.");
    require(std::all_of(factors.begin(), factors.end(), [](double f) { return std::isfinite(f) && f >= 0; }),
            "Factors on the solar spectrum must be numbers, at least 0.");
    for (const auto& name : settings.layers.hiddenScatterers) {
        std::vector<std::string> known;
        for (const int s : atmosphere_->optics.scatterers)
            known.push_back(atmosphere_->medium.species[static_cast<std::size_t>(s)].name);
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            std::string all;
            for (const auto& other : known)
                all += (all.empty() ? "`" : ", `") + other + "`";
            throw Error(ErrorKind::settings,
                        "There is no scatterer `" + name + "` in the model; it has " + (all.empty() ? "none" : all) + ".");
        }
    }
    const std::string why = whyUnsupported(settings);
    if (!why.empty())
        throw Error(ErrorKind::unsupported, why);
    if (!settings.cities.empty()) {
        if (!cities_)
            cities_ = std::make_unique<Cities>(atmosphere_->medium, atmosphere_->model.manifest().lightPollutionRadiance);
        const std::string wrong = cities_->whyNot(settings.cities);
        require(wrong.empty(), wrong);
    }
    if (settings.layers.lightPollution && settings.lightPollutionLuminance > 0 && !glow_)
        glow_ = std::make_unique<Glow>(atmosphere_->model, atmosphere_->medium);
    if (!sameTables(settings, settings_) || settings.eclipse != settings_.eclipse)
        ordinaryReady_ = ready_ = false;
    if (!sameEclipse(settings, settings_))
        ready_ = false;
    settings_ = settings;
    ++version_;
}

EclipseState Scene::eclipseState(const SceneSettings& settings) const
{
    const double radius = settings.sun.angularRadius.value_or(atmosphere_->medium.sunAngularRadius);
    return stateOf(bodiesOf(atmosphere_->model.manifest(), settings.altitude, settings.sun, settings.moon, radius));
}

bool Scene::usesEclipseTable(const SceneSettings& settings) const
{
    const auto& manifest = atmosphere_->model.manifest();
    const bool sameOrders =
        settings.eclipseOrders == 0 || (!manifest.allScatteringOrders && settings.eclipseOrders == manifest.scatteringOrders);
    if (settings.eclipse == EclipseMode::off || !settings.precomputedEclipse || settings.source != Source::textures ||
        !settings.layers.multipleScattering || settings.limbDarkening || !sameOrders ||
        !atmosphere_->model.hasTable(sky::model::eclipseTable))
        return false;
    const double radius = settings.sun.angularRadius.value_or(manifest.sunAngularRadius);
    return sky::model::eclipseTableFits(manifest, bodiesOf(manifest, settings.altitude, settings.sun, settings.moon, radius));
}

LayersUsed Scene::layersUsed() const
{
    LayersUsed used;
    used.ground = settings_.layers.zeroOrder;
    used.multiple = settings_.layers.multipleScattering;
    const auto& hidden = settings_.layers.hiddenScatterers;
    for (const int s : atmosphere_->optics.scatterers) {
        const auto& name = atmosphere_->medium.species[static_cast<std::size_t>(s)].name;
        used.single.push_back(settings_.layers.singleScattering && std::find(hidden.begin(), hidden.end(), name) == hidden.end());
    }
    return used;
}

Progress Scene::step()
{
    if (ready_)
        return {true, 1, {}};
    if (sunRadius() != tabulatedSunRadius_) {
        followSunlight();
        return {false, 0.1, "Following rays"};
    }
    phases_->look(settings_.altitude, std::cos(settings_.sun.zenithAngle));
    if (lightCities())
        return {false, 0.1, "Lighting cities"};
    const bool eclipse = settings_.eclipse == EclipseMode::on;
    if (eclipse && ordinaryReady_)
        return eclipseStep();
    LayersUsed layers = layersUsed();
    const bool ground = layers.ground;
    const bool anySingle = std::find(layers.single.begin(), layers.single.end(), true) != layers.single.end();
    const bool single = anySingle && (settings_.source == Source::moments || settings_.onTheFlySingleScattering);
    if (ground || single || (layers.multiple && settings_.source == Source::moments)) {
        gather_->setAltitude(settings_.altitude);
        if (gather_->fractionDone() < 1) {
            const bool done = gather_->step(raysPerStep);
            return {false, 0.1 + 0.7 * gather_->fractionDone(), done ? "Gathering light" : "Following rays"};
        }
    }
    if (eclipse) {
        // The parts that the Moon dims each in its own way.
        layers.ground = false;
        ordinary_ = {gathered(layers), {}, {}, glow()};
        eclipsed_ = {};
        if (ground) {
            LayersUsed part{true, true, false, false, std::vector<bool>(layers.single.size(), false)};
            const auto weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
            const double muSun = std::cos(settings_.sun.zenithAngle);
            ordinary_.groundDirect = gather_->gather(muSun, part, weights).whole;
            std::swap(part.groundDirect, part.groundDiffuse);
            ordinary_.groundDiffuse = gather_->gather(muSun, part, weights).whole;
        }
        ordinaryReady_ = true;
        return {false, 0.85, "Following the shadow"};
    }
    view_ = gathered(layers);
    if (ViewTable light = glow(); !light.empty())
        view_.whole = sum(resampled(view_.whole, drawnHalfViews, drawnAzimuths), resampled(light, drawnHalfViews, drawnAzimuths));
    ready_ = true;
    ++version_;
    return {true, 1, {}};
}

SkyView Scene::gathered(LayersUsed layers)
{
    const double muSun = std::cos(settings_.sun.zenithAngle);
    const auto weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
    const LayersUsed looked = [&] {
        LayersUsed result = layers;
        if (settings_.onTheFlySingleScattering)
            result.single.assign(result.single.size(), false);
        return result;
    }();
    if (settings_.source == Source::textures) {
        layers.multiple = false;
        if (!settings_.onTheFlySingleScattering)
            layers.single.assign(layers.single.size(), false);
    }
    const bool gathers =
        layers.ground || layers.multiple || std::find(layers.single.begin(), layers.single.end(), true) != layers.single.end();
    if (settings_.source == Source::moments)
        return gathers ? gather_->gather(muSun, layers, weights) : SkyView{{}, std::vector<ViewTable>(layers.single.size())};
    SkyView view = lookup_->slice(settings_.altitude, muSun, looked, weights);
    if (gathers) {
        SkyView own = gather_->gather(muSun, layers, weights);
        view.whole = sum(resampled(view.whole, drawnHalfViews, drawnAzimuths), resampled(own.whole, drawnHalfViews, drawnAzimuths));
        for (std::size_t i = 0; i < own.scattered.size(); ++i)
            if (!own.scattered[i].empty())
                view.scattered[i] = std::move(own.scattered[i]);
    }
    return view;
}

EclipseScene Scene::eclipseScene() const
{
    const auto& manifest = atmosphere_->model.manifest();
    EclipseScene scene;
    scene.bodies = bodiesOf(manifest, settings_.altitude, settings_.sun, settings_.moon, sunRadius());
    scene.orders.all = settings_.eclipseOrders == 0 && manifest.allScatteringOrders;
    scene.orders.orders = settings_.eclipseOrders == 0 ? manifest.scatteringOrders : settings_.eclipseOrders;
    scene.limbDarkening = settings_.limbDarkening;
    const bool ground = settings_.layers.zeroOrder && !settings_.pseudoMirror && moments_;
    scene.field = !onceAtMost() && (ground || (settings_.layers.multipleScattering && !usesEclipseTable(settings_)));
    scene.weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
    return scene;
}

Progress Scene::eclipseStep()
{
    if (!eclipse_)
        eclipse_ = std::make_unique<EclipseSky>(*atmosphere_, *phases_, *sun_);
    eclipse_->set(eclipseScene());
    if (!eclipse_->step())
        return {false, 0.85 + 0.15 * eclipse_->fractionDone(), "Following the shadow"};
    if (usesEclipseTable(settings_) && eclipsed_.empty())
        eclipsed_ = lookup_->eclipsed(settings_.altitude, std::cos(settings_.sun.zenithAngle),
                                      atmosphere_->luminanceWeights(settings_.solarSpectrumFactors));
    view_ = eclipsedView(ordinary_);
    ready_ = true;
    ++version_;
    return {true, 1, {}};
}

SkyView Scene::eclipsedView(const OrdinarySky& sky) const
{
    // The description asks for sizes of the half turn; no fewer than these serve.
    const auto asked = [&](const char* name) {
        const auto& stored = atmosphere_->model.manifest().settings;
        const auto found = stored.find(name);
        return found == stored.end() ? 0 : std::clamp(std::atoi(found->second.c_str()), 0, mostEclipseSize);
    };
    const int finer = settings_.eclipseFine ? 4 : 1;
    const int halfViews = std::max(eclipseHalfViews, (asked("eclipse.views") + 1) / 2);
    const int halfTurn = std::max((eclipseAzimuths - 1) / 2, asked("eclipse.azimuths") - 1);
    return eclipse_->dimmed(sky, usesEclipseTable(settings_) ? &eclipsed_ : nullptr, finer * halfViews, finer * 2 * halfTurn + 1);
}

ViewTable Scene::glow() const
{
    if (!settings_.layers.lightPollution || settings_.lightPollutionLuminance <= 0)
        return {};
    ViewTable result =
        settings_.source == Source::textures ? glow_->fromTextures(settings_.altitude) : glow_->fromMoments(settings_.altitude);
    for (Texel& texel : result.texels)
        for (float& value : texel)
            value *= static_cast<float>(settings_.lightPollutionLuminance);
    return result;
}

/// Has cities lit in the background, while others go on drawing the scene before; false once their light is there.
bool Scene::lightCities()
{
    const bool shown = settings_.layers.lightPollution && !settings_.cities.empty();
    if (!shown) {
        cityView_ = {};
        return false;
    }
    if (cityView_.altitude == settings_.altitude && cityView_.cities == settings_.cities)
        return false;
    if (!citiesLit_.valid())
        citiesLit_ = std::async(std::launch::async,
                                [this, &lamps = std::as_const(*cities_), cities = settings_.cities, altitude = settings_.altitude] {
                                    return lamps.light(cities, altitude, [this] { return ending_.load(); });
                                });
    if (citiesLit_.wait_for(cityPatience) == std::future_status::ready)
        cityView_ = citiesLit_.get(); // of settings that may have changed since: then the next step begins with the new ones
    return true;
}

/// Light of higher orders at the nodes of aerial perspective, as the textures have it.
ViewTable Scene::multipleOfLines() const
{
    LayersUsed layers = layersUsed();
    std::fill(layers.single.begin(), layers.single.end(), false);
    OrdinarySky sky;
    sky.view = lookup_->slice(settings_.altitude, std::cos(settings_.sun.zenithAngle), layers,
                              atmosphere_->luminanceWeights(settings_.solarSpectrumFactors));
    return atLines(view_.eclipse && !sky.view.whole.empty() ? eclipsedView(sky).whole : sky.view.whole);
}

/// A table as SkyView::whole has it, at the nodes of aerial perspective.
ViewTable Scene::atLines(const ViewTable& table) const
{
    if (table.empty() || !view_.eclipse)
        return resampled(table, Aerial::halfViews, Aerial::azimuths);
    const SkyAxes axes = skyAxes();
    const auto sines = viewSines(atmosphere_->planet(), settings_.altitude, Aerial::halfViews);
    const int columns = Aerial::columns(true);
    ViewTable result(Aerial::halfViews, columns);
    for (int v = 0; v < 2 * Aerial::halfViews; ++v) {
        const int half = v / Aerial::halfViews;
        const double view = axes.viewCoordinate(std::asin(sines[static_cast<std::size_t>(v)]), half);
        for (int a = 0; a < columns; ++a)
            result.at(v, a) = sampled(table, view, half, axes.azimuthCoordinate(pi * (2. * a / (columns - 1) - 1)));
    }
    return result;
}

bool Scene::aerialStep()
{
    if (!aerial_)
        aerial_ = std::make_unique<Aerial>(*atmosphere_, *phases_, moments_ ? &*moments_ : nullptr, *sun_);
    const bool eclipse = settings_.eclipse == EclipseMode::on;
    const bool higherOrders = eclipse && !onceAtMost() && settings_.layers.multipleScattering;
    if (higherOrders && !eclipse_->followField())
        return false;
    if (!aerialSettings_ || !sameTables(settings_, *aerialSettings_) || !sameEclipse(settings_, *aerialSettings_)) {
        AerialScene scene{settings_.altitude,   std::cos(settings_.sun.zenithAngle),
                          layersUsed(),         atmosphere_->luminanceWeights(settings_.solarSpectrumFactors),
                          atLines(view_.whole), settings_.layers.lightPollution};
        if (!moments_)
            scene.multiple = multipleOfLines();
        if (eclipse) {
            const auto sun = directionOf(settings_.sun.azimuth, settings_.sun.zenithAngle);
            scene.eclipse = {std::atan2(sun[1], sun[0]),
                             [this](const auto& direction, const auto& node) { return eclipse_->sunAt(direction, node); },
                             {}};
            if (higherOrders)
                scene.eclipse->higherOrders = [this](const auto& lines, const auto& sines, const auto& relative) {
                    return eclipse_->nodeRatios(lines, sines, relative);
                };
        }
        aerial_->set(std::move(scene));
        aerialSettings_ = settings_;
    }
    return aerial_->step(linesPerStep);
}

SkyAxes Scene::skyAxes() const
{
    return {physics::horizonElevation(atmosphere_->planet(), settings_.altitude), view_.eclipse, pi / 2 - settings_.sun.zenithAngle};
}

Illuminance Scene::illuminance() const
{
    const SceneGeometry scene = geometry();
    const double elevation = pi / 2 - settings_.sun.zenithAngle;
    Illuminance result;
    const auto colours = sunColours(illuminanceSamples);
    if (scene.eclipse)
        addCrescentIlluminance(colours, elevation, crescent(), scene.horizon, result);
    else
        addSunIlluminance(colours, elevation, sunRadius(), scene.horizon, result);
    result.skyHorizontal = skyIlluminance(view_, skyAxes(), *phases_);
    return result;
}

Crescent Scene::crescent() const
{
    const EclipseState state = eclipseState(settings_);
    const auto sun = directionOf(settings_.sun.azimuth, settings_.sun.zenithAngle);
    const auto moon = directionOf(settings_.moon.azimuth, settings_.moon.zenithAngle);
    // From the Moon to the Sun and upwards, both square to the Sun's direction.
    const double along = sun[0] * moon[0] + sun[1] * moon[1] + sun[2] * moon[2];
    const double size = std::sqrt(std::max(0., (1 - along * along) * (1 - sun[2] * sun[2])));
    const double up = size > 0 ? std::clamp((along * sun[2] - moon[2]) / size, -1., 1.) : 1;
    return {{state.sunAngularRadius, state.moonAngularRadius, state.separation}, up, settings_.limbDarkening ? limbExponents() : Texel{}};
}

SceneGeometry Scene::geometry() const
{
    SceneGeometry result;
    result.sunDirection = directionOf(settings_.sun.azimuth, settings_.sun.zenithAngle);
    result.horizon = physics::horizonElevation(atmosphere_->planet(), settings_.altitude);
    result.dipTangent = physics::horizonDistance(atmosphere_->planet(), settings_.altitude) / atmosphere_->planet().radius;
    result.mirror = settings_.pseudoMirror;
    result.filter = settings_.textureFiltering;
    result.showSun = settings_.layers.solarDisc && settings_.layers.zeroOrder;
    result.sunRadius = sunRadius();
    const auto colours = sunColours(sunColourCount);
    std::copy(colours.begin(), colours.end(), result.sunColours.begin());
    result.eclipse = settings_.eclipse == EclipseMode::on;
    if (result.eclipse) {
        result.moonDirection = directionOf(settings_.moon.azimuth, settings_.moon.zenithAngle);
        result.moonRadius = eclipseState(settings_).moonAngularRadius;
    }
    if (settings_.limbDarkening && result.eclipse)
        result.limbExponents = limbExponents();
    return result;
}

Texel Scene::limbExponents() const
{
    // Of each colour: the mean over its wavelengths.
    const auto weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
    Texel sums{}, result{};
    for (std::size_t w = 0; w < weights.size(); ++w)
        for (std::size_t c = 0; c < 4; ++c) {
            sums[c] += weights[w][c];
            result[c] += weights[w][c] * static_cast<float>(physics::LimbDarkening::exponent(atmosphere_->medium.wavelengthsNm[w]));
        }
    for (std::size_t c = 0; c < 4; ++c)
        result[c] = sums[c] > 0 ? result[c] / sums[c] : 0;
    return result;
}

std::vector<Texel> Scene::sunColours(int count) const
{
    // Radiance of a uniform disc: irradiance over its solid angle, seen through the air without scaling of sharp peaks.
    const auto& medium = atmosphere_->medium;
    const double radius = sunRadius(), solidAngle = 2 * pi * (1 - std::cos(radius)), centre = pi / 2 - settings_.sun.zenithAngle;
    const double horizon = physics::horizonElevation(atmosphere_->planet(), settings_.altitude);
    const auto weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
    physics::RayTracer tracer(atmosphere_->profile, atmosphere_->optics, 2);
    std::vector<double> columns(medium.species.size());
    std::vector<Texel> result(static_cast<std::size_t>(count), Texel{});
    for (int k = 0; k < count; ++k) {
        const double elevation = std::max(horizon, centre + radius * (2. * k / (count - 1) - 1));
        const auto entry = enterAir(atmosphere_->planet(), settings_.altitude, std::sin(std::min(elevation, pi / 2)));
        std::fill(columns.begin(), columns.end(), 0.);
        if (entry)
            tracer.columns(entry->altitude, entry->mu, columns.data());
        for (std::size_t w = 0; w < weights.size(); ++w) {
            double depth = 0;
            for (std::size_t s = 0; s < columns.size(); ++s)
                depth += columns[s] * medium.species[s].extinctionCrossSection[w];
            for (std::size_t c = 0; c < 4; ++c)
                result[static_cast<std::size_t>(k)][c] += weights[w][c] * static_cast<float>(std::exp(-depth) / solidAngle);
        }
    }
    return result;
}

} // namespace showmysky
