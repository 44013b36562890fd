#include "scene.hpp"

#include "air_entry.hpp"
#include "bodies.hpp"
#include "model/moment_tables.hpp"
#include "physics/sky.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

namespace {

constexpr double pi = 3.14159265358979323846;
/// The table of sunlight: coarser than the solver's, error below 1e-3 (tests/showmysky/scene.cpp).
constexpr int sunAltitudes = 64, sunElevations = 96;
/// Rays that a step of preparation follows.
constexpr int raysPerStep = 16;

bool same(const Layers& a, const Layers& b)
{
    return a.zeroOrder == b.zeroOrder && a.singleScattering == b.singleScattering &&
           a.multipleScattering == b.multipleScattering && a.lightPollution == b.lightPollution &&
           a.hiddenScatterers == b.hiddenScatterers;
}

/// True if both ask for the same sky tables.
bool sameTables(const SceneSettings& a, const SceneSettings& b)
{
    return a.altitude == b.altitude && a.sun.zenithAngle == b.sun.zenithAngle &&
           a.sun.angularRadius == b.sun.angularRadius && same(a.layers, b.layers) &&
           a.lightPollutionLuminance == b.lightPollutionLuminance && a.source == b.source &&
           a.onTheFlySingleScattering == b.onTheFlySingleScattering && a.solarSpectrumFactors == b.solarSpectrumFactors;
}

void require(bool fine, const std::string& message)
{
    if (!fine)
        throw Error(ErrorKind::settings, message);
}

} // namespace

const char* Scene::loadActivity(int step)
{
    static constexpr const char* names[loadSteps] = {"Reading the medium", "Reading the moments",
                                                     "Tabulating phase functions", "Following sunlight"};
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

double Scene::sunRadius() const
{
    return settings_.sun.angularRadius.value_or(atmosphere_->medium.sunAngularRadius);
}

void Scene::followSunlight()
{
    gather_.reset();
    tabulatedSunRadius_ = sunRadius();
    sun_ = std::make_unique<physics::SunTable>(atmosphere_->profile, atmosphere_->optics, tabulatedSunRadius_,
                                               sunAltitudes, sunElevations);
    gather_ = std::make_unique<MomentGather>(*atmosphere_, *phases_, moments_ ? &*moments_ : nullptr, *sun_,
                                             tabulatedSunRadius_);
}

bool Scene::hasSource(Source source) const
{
    return source == Source::moments ? atmosphere_->model.hasTable("moments")
                                     : TextureLookup::missingTable(*atmosphere_).empty();
}

std::string Scene::whyUnsupported(const SceneSettings& settings) const
{
    if (settings.eclipse == EclipseMode::on)
        return "Solar eclipses can't be drawn by this version.";
    if (settings.layers.lightPollution)
        if (const std::string why = Glow::whyMissing(atmosphere_->model); !why.empty())
            return why;
    if (!hasSource(settings.source))
        return settings.source == Source::moments
                   ? "The model holds no moments; compute it anew, or choose the 4D textures as source."
                   : "The model lacks the table `" + TextureLookup::missingTable(*atmosphere_) +
                         "`; compute it with all textures, or choose the moments as source.";
    if (settings.source == Source::textures) {
        if (settings.altitude > atmosphere_->planet().topOfAtmosphere)
            return "The 4D textures end at the top of the atmosphere; above it, choose the moments as source.";
        if (!settings.solarSpectrumFactors.empty() && TextureLookup::anyLuminance(*atmosphere_))
            return "The 4D textures of this model hold luminance, on which another solar spectrum can't act; compute "
                   "it with "
                   "--radiance, or choose the moments as source.";
    }
    return {};
}

void Scene::setSettings(const SceneSettings& settings)
{
    require(std::isfinite(settings.altitude) && settings.altitude >= 0,
            "The altitude must be a number of metres, at least 0.");
    require(std::isfinite(settings.sun.azimuth) && std::isfinite(settings.moon.azimuth),
            "An azimuth must be a number.");
    require(settings.sun.zenithAngle >= 0 && settings.sun.zenithAngle <= pi + 1e-9,
            "The zenith angle of the Sun must be between 0 and 180 degrees.");
    require(settings.moon.zenithAngle >= 0 && settings.moon.zenithAngle <= pi + 1e-9,
            "The zenith angle of the Moon must be between 0 and 180 degrees.");
    require(!settings.sun.angularRadius || (*settings.sun.angularRadius > 0 && *settings.sun.angularRadius < 0.5),
            "The angular radius of the Sun must be above 0 and below 0.5 radians.");
    require(std::isfinite(settings.lightPollutionLuminance) && settings.lightPollutionLuminance >= 0,
            "The luminance of the ground must be a number of cd/m^2, at least 0.");
    const auto& factors = settings.solarSpectrumFactors;
    require(factors.empty() || factors.size() == static_cast<std::size_t>(atmosphere_->wavelengths()),
            "The solar spectrum needs one factor for each of the " + std::to_string(atmosphere_->wavelengths()) +
                " wavelengths.");
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
            throw Error(ErrorKind::settings, "There is no scatterer `" + name + "` in the model; it has " +
                                                 (all.empty() ? "none" : all) + ".");
        }
    }
    const std::string why = whyUnsupported(settings);
    if (!why.empty())
        throw Error(ErrorKind::unsupported, why);
    if (settings.layers.lightPollution && !glow_)
        glow_ = std::make_unique<Glow>(atmosphere_->model, atmosphere_->medium);
    if (!sameTables(settings, settings_))
        ready_ = false;
    settings_ = settings;
    ++version_;
}

EclipseState Scene::eclipseState(const SceneSettings& settings) const
{
    const double radius = settings.sun.angularRadius.value_or(atmosphere_->medium.sunAngularRadius);
    return stateOf(bodiesOf(atmosphere_->model.manifest(), settings.altitude, settings.sun, settings.moon, radius));
}

LayersUsed Scene::layersUsed() const
{
    LayersUsed used;
    used.ground = settings_.layers.zeroOrder;
    used.multiple = settings_.layers.multipleScattering;
    const auto& hidden = settings_.layers.hiddenScatterers;
    for (const int s : atmosphere_->optics.scatterers) {
        const auto& name = atmosphere_->medium.species[static_cast<std::size_t>(s)].name;
        used.single.push_back(settings_.layers.singleScattering &&
                              std::find(hidden.begin(), hidden.end(), name) == hidden.end());
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
    const LayersUsed layers = layersUsed();
    LayersUsed gathered = layers;
    if (settings_.source == Source::textures) {
        gathered.multiple = false;
        if (!settings_.onTheFlySingleScattering)
            gathered.single.assign(gathered.single.size(), false);
    }
    const bool anySingle = std::find(gathered.single.begin(), gathered.single.end(), true) != gathered.single.end();
    const bool gathers = gathered.ground || gathered.multiple || anySingle;
    if (gathers) {
        gather_->setAltitude(settings_.altitude);
        if (gather_->fractionDone() < 1) {
            const bool done = gather_->step(raysPerStep);
            return {false, 0.1 + 0.7 * gather_->fractionDone(), done ? "Gathering light" : "Following rays"};
        }
    }
    const double muSun = std::cos(settings_.sun.zenithAngle);
    const auto weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
    if (settings_.source == Source::moments) {
        view_ = gathers ? gather_->gather(muSun, gathered, weights) : SkyView{{}, std::vector<ViewTable>(layers.single.size())};
    } else {
        LayersUsed looked = layers;
        if (settings_.onTheFlySingleScattering)
            looked.single = std::vector<bool>(looked.single.size(), false);
        view_ = lookup_->slice(settings_.altitude, muSun, looked, weights);
        if (gathers) {
            SkyView own = gather_->gather(muSun, gathered, weights);
            view_.whole = sum(resampled(view_.whole, drawnHalfViews, drawnAzimuths),
                              resampled(own.whole, drawnHalfViews, drawnAzimuths));
            for (std::size_t i = 0; i < own.scattered.size(); ++i)
                if (!own.scattered[i].empty())
                    view_.scattered[i] = std::move(own.scattered[i]);
        }
    }
    addGlow();
    ready_ = true;
    ++version_;
    return {true, 1, {}};
}

void Scene::addGlow()
{
    if (!settings_.layers.lightPollution || settings_.lightPollutionLuminance <= 0)
        return;
    ViewTable glow = settings_.source == Source::textures ? glow_->fromTextures(settings_.altitude)
                                                          : glow_->fromMoments(settings_.altitude);
    for (Texel& texel : glow.texels)
        for (float& value : texel)
            value *= static_cast<float>(settings_.lightPollutionLuminance);
    view_.whole = sum(resampled(view_.whole, drawnHalfViews, drawnAzimuths), resampled(glow, drawnHalfViews, drawnAzimuths));
}

SceneGeometry Scene::geometry() const
{
    SceneGeometry result;
    result.sunDirection = directionOf(settings_.sun.azimuth, settings_.sun.zenithAngle);
    result.horizon = physics::horizonElevation(atmosphere_->planet(), settings_.altitude);
    result.mirror = settings_.pseudoMirror;
    result.filter = settings_.textureFiltering;
    if (settings_.layers.solarDisc && settings_.layers.zeroOrder) {
        result.sunRadius = sunRadius();
        result.sunColours = sunColours();
    }
    return result;
}

std::array<Texel, sunColourCount> Scene::sunColours() const
{
    // Radiance of a uniform disc: irradiance over its solid angle, seen through the air without scaling of sharp peaks.
    const auto& medium = atmosphere_->medium;
    const double radius = sunRadius(), solidAngle = 2 * pi * (1 - std::cos(radius)),
                 centre = pi / 2 - settings_.sun.zenithAngle;
    const double horizon = physics::horizonElevation(atmosphere_->planet(), settings_.altitude);
    const auto weights = atmosphere_->luminanceWeights(settings_.solarSpectrumFactors);
    physics::RayTracer tracer(atmosphere_->profile, atmosphere_->optics, 2);
    std::vector<double> columns(medium.species.size());
    std::array<Texel, sunColourCount> result{};
    for (int k = 0; k < sunColourCount; ++k) {
        const double elevation = std::max(horizon, centre + radius * (2. * k / (sunColourCount - 1) - 1));
        const auto entry = enterAir(atmosphere_->planet(), settings_.altitude, std::sin(std::min(elevation, pi / 2)));
        std::fill(columns.begin(), columns.end(), 0.);
        if (entry)
            tracer.columns(entry->altitude, entry->mu, columns.data());
        for (std::size_t w = 0; w < weights.size(); ++w) {
            double depth = 0;
            for (std::size_t s = 0; s < columns.size(); ++s)
                depth += columns[s] * medium.species[s].extinctionCrossSection[w];
            for (std::size_t c = 0; c < 4; ++c)
                result[static_cast<std::size_t>(k)][c] +=
                    weights[w][c] * static_cast<float>(std::exp(-depth) / solidAngle);
        }
    }
    return result;
}

std::vector<double> Scene::spectralRadiance(const std::array<double, 3>& direction) const
{
    const auto& medium = atmosphere_->medium;
    const auto& optics = atmosphere_->optics;
    const auto wavelengths = static_cast<std::size_t>(atmosphere_->wavelengths());
    std::vector<double> result(wavelengths, 0.);
    const double size = std::hypot(direction[0], direction[1], direction[2]);
    if (!(size > 0))
        return result;
    std::array<double, 3> view{direction[0] / size, direction[1] / size, direction[2] / size};
    const double horizon = physics::horizonElevation(atmosphere_->planet(), settings_.altitude);
    const double elevation = std::asin(std::clamp(view[2], -1., 1.));
    bool ground = elevation < horizon;
    if (ground && settings_.pseudoMirror) {
        const double mirrored = 2 * horizon - elevation, flat = std::max(std::hypot(view[0], view[1]), 1e-12);
        view = {view[0] / flat * std::cos(mirrored), view[1] / flat * std::cos(mirrored), std::sin(mirrored)};
        ground = false;
    }
    const auto entry = enterAir(atmosphere_->planet(), settings_.altitude, view[2]);
    if (!entry)
        return result;
    const auto sunDirection = directionOf(settings_.sun.azimuth, settings_.sun.zenithAngle);
    const double muSun = sunDirection[2];
    const double nu =
        std::clamp(view[0] * sunDirection[0] + view[1] * sunDirection[1] + view[2] * sunDirection[2], -1., 1.);
    const LayersUsed layers = layersUsed();
    physics::RayTracer tracer(atmosphere_->profile, optics);
    const physics::SkyEvaluator evaluator(medium, atmosphere_->profile, optics, *sun_);
    const physics::SkyEvaluator::Parts parts;

    auto ray = tracer.trace(entry->altitude, entry->mu, parts.singleNodes, ground);
    for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
        ray.nodes[k] = entry->node(ray.nodes[k]);
        for (std::size_t i = 0; i < layers.single.size(); ++i)
            if (!layers.single[i])
                std::fill_n(&ray.weights[(k * layers.single.size() + i) * wavelengths], wavelengths, 0.);
    }
    evaluator.singleAlong(ray, muSun, nu, true, result.data());
    if (layers.ground && ground) {
        const auto there = entry->node(ray.ground);
        const double muSunThere = std::clamp(there.sunScale * muSun + there.nuScale * nu, -1., 1.);
        std::vector<double> direct(wavelengths), diffuse(wavelengths, 0.);
        sun_->horizontalIrradiance(0, muSunThere, direct.data());
        if (moments_)
            moments_->interpolateGround(muSunThere, diffuse.data());
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] += ray.groundTransmittance[w] * medium.groundAlbedo[w] / pi * (direct[w] + diffuse[w]);
    }
    if (layers.multiple && moments_) {
        auto coarse = tracer.trace(entry->altitude, entry->mu, parts.multipleNodes, ground);
        for (auto& node : coarse.nodes)
            node = entry->node(node);
        evaluator.multipleAlong(coarse, *moments_, muSun, nu, result.data());
    }
    for (std::size_t w = 0; w < wavelengths; ++w)
        result[w] = std::max(0., result[w]) * medium.solarIrradiance[w] *
                    (settings_.solarSpectrumFactors.empty() ? 1 : settings_.solarSpectrumFactors[w]);
    if (settings_.layers.lightPollution) {
        std::vector<double> glow(wavelengths);
        glow_->radiance(settings_.altitude, view[2], glow.data());
        for (std::size_t w = 0; w < wavelengths; ++w)
            result[w] += glow[w] * settings_.lightPollutionLuminance;
    }
    return result;
}

} // namespace showmysky
