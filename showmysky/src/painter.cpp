#include "painter.hpp"

#include "base/angles.hpp"
#include "gl/pixel_store.hpp"
#include "physics/table_axes.hpp"
#include "sky_axes.hpp"
#include "sky_shaders.hpp"
#include "view_direction.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace gl = sky::gl;

namespace {

constexpr GLuint tablesUnit = 0, phasesUnit = 1, directionsUnit = 2, cityAirUnit = 3, cityDiscsUnit = 4;
using sky::base::pi;

gl::Program buildProgram(const gl::Api& api, int scatterers, const Options& options, bool eclipse, bool cities)
{
    std::vector<gl::Define> defines = Painter::lightDefines(scatterers);
    defines.push_back({"WHOLE_TURN", eclipse ? "true" : "false"});
    if (cities)
        defines.push_back({"CITIES", "1"});
    const bool host = !options.viewDirectionFunction.empty();
    const std::string builtIn = "render/projections.glsl";
    const gl::Snippet projection{"viewDirection", host ? options.viewDirectionFunction : std::string(sky::shaders::source(builtIn)),
                                 host ? "viewDirectionFunction" : builtIn, 1, false};
    return gl::ProgramBuilder(api, sky::shaders::source).graphics("sky", "render/triangle.vert", "render/sky.frag", defines, {projection});
}

gl::TextureFormat formatOf(bool half) { return half ? gl::TextureFormat::rgba16f : gl::TextureFormat::rgba32f; }

std::vector<float> flat(const std::vector<Texel>& texels)
{
    std::vector<float> result;
    result.reserve(texels.size() * 4);
    for (const Texel& texel : texels)
        result.insert(result.end(), texel.begin(), texel.end());
    return result;
}

std::array<float, 3> asFloats(const std::array<double, 3>& v)
{
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

void apply(gl::Program& program, const std::string& name, const UniformValue& value)
{
    std::visit(
        [&](const auto& v) {
            if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::vector<Texel>>)
                program.setVec4s(name, v);
            else
                program.set(name, v);
        },
        value);
}

std::size_t bytesOf(const gl::Texture& texture)
{
    const bool half = texture.format() == gl::TextureFormat::rgba16f;
    return texture.size().texels() * (half ? 8 : 16);
}

} // namespace

std::vector<gl::Define> Painter::lightDefines(int scatterers)
{
    return {{"SCATTERERS", std::to_string(scatterers)},
            {"PHASE_ROWS", std::to_string(std::max(1, (scatterers + 3) / 4))},
            {"SUN_COLOURS", std::to_string(sunColourCount)},
            {"CITY_COLOURS", std::to_string(cityColourCount)}};
}

Painter::Painter(const gl::Api& api, int scatterers, const std::vector<Texel>& phases, const Options& options)
    : api_(api), half_(options.halfFloats || api.isEs()), hostProjection_(!options.viewDirectionFunction.empty()), scatterers_(scatterers),
      program_(buildProgram(api, scatterers, options, false, false)), options_(options), triangle_(api, "sky triangle"),
      phases_(api, "phase functions", formatOf(half_), phaseWidth, static_cast<int>(phases.size()) / phaseWidth),
      tables_(api, "sky tables", formatOf(half_), drawnAzimuths, 2 * drawnHalfViews * (scatterers + 1)),
      cityAir_(api, "air above cities", formatOf(half_), 1, 1), cityDiscs_(api, "cities", gl::TextureFormat::rgba32f, 1, 1),
      direction_(api, "direction of a pixel", formatOf(half_), 1, 1), target_(api, "luminance"),
      directionTarget_(api, "direction of a pixel")
{
    setPhases(phases);
    directionTarget_.attach(0, direction_);
    light_["phaseWidth"] = static_cast<float>(phaseWidth);
    set("largest", half_ ? 65504.f : 3e38f);
    gl::checkErrors(api_, "preparing to draw the sky");
}

void Painter::makeFor(bool eclipse, bool cities)
{
    if (eclipse == eclipse_ && cities == withCities_)
        return;
    program_ = buildProgram(api_, scatterers_, options_, eclipse, cities);
    eclipse_ = eclipse;
    withCities_ = cities;
    for (const auto* uniforms : {&light_, &own_})
        for (const auto& [name, value] : *uniforms)
            apply(program_, name, value);
}

void Painter::set(const std::string& name, const UniformValue& value)
{
    own_[name] = value;
    apply(program_, name, value);
}

void Painter::setLight(const std::string& name, const UniformValue& value)
{
    light_[name] = value;
    apply(program_, name, value);
}

void Painter::setPhases(const std::vector<Texel>& phases) { phases_.upload(flat(phases)); }

void Painter::setSky(const SkyView& view, const SceneGeometry& geometry)
{
    makeFor(view.eclipse, withCities_);
    // Each table is stored over its largest value: half floats then serve noon and night alike.
    std::vector<float> texels;
    std::vector<std::array<float, 4>> scales;
    // An eclipse's tables come as they are drawn: SkyAxes.
    const int halfViews = view.eclipse ? view.whole.halfViews : drawnHalfViews;
    const int azimuths = view.eclipse ? view.whole.azimuths : drawnAzimuths;
    const std::size_t texelsOfTable = std::size_t(2) * static_cast<std::size_t>(halfViews * azimuths);
    for (int i = -1; i < scatterers_; ++i) {
        const ViewTable table = resampled(i < 0 ? view.whole : view.scattered[static_cast<std::size_t>(i)], halfViews, azimuths);
        float largest = 0;
        for (const Texel& texel : table.texels)
            largest = std::max({largest, texel[0], texel[1], texel[2], texel[3]});
        scales.push_back({largest, largest, largest, largest});
        if (largest > 0)
            for (const Texel& texel : table.texels)
                for (const float value : texel)
                    texels.push_back(std::max(0.f, value / largest));
        texels.resize(static_cast<std::size_t>(i + 2) * texelsOfTable * 4, 0.f);
    }
    const int rows = 2 * halfViews * (scatterers_ + 1);
    if (tables_.size().width != azimuths || tables_.size().height != rows)
        tables_ = gl::Texture2D(api_, "sky tables", formatOf(half_), azimuths, rows);
    tables_.upload(texels);
    light_["tableSize"] = std::array<float, 2>{static_cast<float>(azimuths), static_cast<float>(halfViews)};
    setAxes(view, geometry);
    tables_.setFilter(geometry.filter ? gl::Filter::linear : gl::Filter::nearest);
    light_["tableScales"] = scales;
    light_["sunDirection"] = asFloats(geometry.sunDirection);
    light_["horizon"] = static_cast<float>(geometry.horizon);
    const auto inverseRange = [](double range) { return static_cast<float>(1 / std::asinh(range / sky::physics::horizonAngleScale)); };
    light_["inverseRanges"] = std::array<float, 2>{inverseRange(pi / 2 - geometry.horizon), inverseRange(pi / 2 + geometry.horizon)};
    light_["mirror"] = geometry.mirror ? 1 : 0;
    light_["dipTangent"] = static_cast<float>(geometry.dipTangent);
    light_["sunColours"] = std::vector<Texel>(geometry.sunColours.begin(), geometry.sunColours.end());
    light_["sunRadius"] = static_cast<float>(geometry.sunRadius);
    light_["moonDirection"] = asFloats(geometry.moonDirection);
    light_["moonRadius"] = static_cast<float>(geometry.eclipse ? geometry.moonRadius : 0);
    light_["limbExponents"] = geometry.limbExponents;
    for (const auto& [name, value] : light_)
        apply(program_, name, value);
    set("showSun", geometry.showSun ? 1 : 0);
}

void Painter::setCities(const CityLight& light)
{
    cities_ = static_cast<int>(light.discs.size());
    makeFor(eclipse_, cities_ > 0);
    setLight("cityCount", cities_);
    if (cities_ == 0)
        return;
    float largest = 1e-30f;
    for (const Texel& texel : light.air.texels)
        largest = std::max({largest, texel[0], texel[1], texel[2], texel[3]});
    std::vector<float> air = flat(light.air.texels), discs;
    for (float& value : air)
        value /= largest;
    for (const auto& disc : light.discs) {
        for (const double value : {disc.angle, disc.azimuth, disc.radius, 0.})
            discs.push_back(static_cast<float>(value));
        for (const Texel& colour : disc.colours)
            discs.insert(discs.end(), colour.begin(), colour.end());
    }
    if (cityAir_.size().width != light.air.azimuths)
        cityAir_ = gl::Texture2D(api_, "air above cities", formatOf(half_), light.air.azimuths, 2 * light.air.halfViews);
    if (cityDiscs_.size().width != 1 + cityColourCount || cityDiscs_.size().height != cities_)
        cityDiscs_ = gl::Texture2D(api_, "cities", gl::TextureFormat::rgba32f, 1 + cityColourCount, cities_);
    cityDiscs_.setFilter(gl::Filter::nearest);
    cityAir_.upload(air);
    cityDiscs_.upload(discs);
    setLight("cityScale", largest);
    setLight("cityTableSize", std::array<float, 2>{static_cast<float>(light.air.azimuths), static_cast<float>(light.air.halfViews)});
}

void Painter::setAxes(const SkyView& view, const SceneGeometry& geometry)
{
    const double sunElevation = std::asin(std::clamp(geometry.sunDirection[2], -1., 1.));
    const SkyAxes axes{geometry.horizon, view.eclipse, sunElevation};
    const auto focus = axes.focus(0);
    const auto columns = axes.azimuthFocus();
    light_["wholeTurn"] = view.eclipse ? 1 : 0; // hosts have one program for both
    light_["viewFocus"] = std::array<float, 4>{static_cast<float>(focus.share), static_cast<float>(focus.sun),
                                               static_cast<float>(focus.offset), static_cast<float>(focus.scale)};
    light_["azimuthFocus"] =
        std::array<float, 3>{static_cast<float>(columns[0]), static_cast<float>(columns[1]), static_cast<float>(columns[2])};
}

void Painter::setCamera(const Camera& camera, int width, int height)
{
    program_.setTexture("skyTables", tablesUnit, tables_);
    program_.setTexture("phases", phasesUnit, phases_);
    program_.setTexture("cityAir", cityAirUnit, cityAir_);
    program_.setTexture("cityDiscs", cityDiscsUnit, cityDiscs_);
    if (hostProjection_)
        return;
    program_.set("pictureSize", std::array<float, 2>{static_cast<float>(width), static_cast<float>(height)});
    program_.set("directions", static_cast<int>(directionsUnit));
    if (camera.directionTexture != 0) {
        api_->ActiveTexture(GL_TEXTURE0 + directionsUnit);
        api_->BindTexture(GL_TEXTURE_2D, camera.directionTexture);
        program_.set("projection", 3);
        return;
    }
    const auto scale = projectionScale(camera, width, height);
    const auto axes = cameraAxes(camera);
    std::array<float, 9> columns{};
    for (std::size_t i = 0; i < 9; ++i)
        columns[i] = static_cast<float>(axes[i / 3][i % 3]);
    program_.set("projection", static_cast<int>(camera.projection));
    program_.set("projectionScale", std::array<float, 2>{static_cast<float>(scale[0]), static_cast<float>(scale[1])});
    program_.setMat3("cameraAxes", columns);
}

void Painter::draw(const Camera& camera, int width, int height, int reduction)
{
    const int w = std::max(1, width / reduction), h = std::max(1, height / reduction);
    if (!luminance_ || luminance_->size().width != w || luminance_->size().height != h) {
        luminance_.emplace(api_, "luminance", formatOf(half_), w, h);
        target_.attach(0, *luminance_);
    }
    pictureWidth_ = width;
    pictureHeight_ = height;
    reduction_ = reduction;
    const gl::Bound target(target_);
    const gl::Bound pass(program_);
    setCamera(camera, width, height);
    program_.set("showDirection", 0);
    program_.set("pixelScale", static_cast<float>(width) / static_cast<float>(w));
    program_.set("pixelOffset", std::array<float, 2>{0, 0});
    triangle_.drawFullScreenTriangle();
    gl::checkErrors(api_, "drawing the sky");
}

std::array<double, 3> Painter::drawDirection(const Camera& camera, int x, int y)
{
    const gl::Bound target(directionTarget_);
    const gl::Bound pass(program_);
    setCamera(camera, pictureWidth_, pictureHeight_);
    program_.set("showDirection", 1);
    const float scale = static_cast<float>(pictureWidth_) / static_cast<float>(luminance_->size().width);
    program_.set("pixelScale", scale);
    program_.set("pixelOffset", std::array<float, 2>{static_cast<float>(x) * scale, static_cast<float>(y) * scale});
    triangle_.drawFullScreenTriangle();
    const auto values = directionTarget_.readPixels(0);
    gl::checkErrors(api_, "asking for the direction of a pixel");
    const double size = std::hypot(static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2]));
    if (!(size > 0))
        return {};
    return {static_cast<double>(values[0]) / size, static_cast<double>(values[1]) / size, static_cast<double>(values[2]) / size};
}

Texel Painter::readPixel(int x, int y) const
{
    GLint before = 0;
    api_->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    const gl::PixelStoreScope pixelStore(api_, gl::PixelTransfer::pack);
    api_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.name());
    api_->ReadBuffer(GL_COLOR_ATTACHMENT0);
    Texel texel{};
    api_->ReadPixels(x, y, 1, 1, GL_RGBA, GL_FLOAT, texel.data());
    api_->BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
    gl::checkErrors(api_, "reading a pixel of the sky");
    return texel;
}

std::size_t Painter::textureBytes() const
{
    return bytesOf(phases_) + bytesOf(tables_) + bytesOf(cityAir_) + bytesOf(cityDiscs_) + bytesOf(direction_) +
           (luminance_ ? bytesOf(*luminance_) : 0);
}

int Painter::fetchesPerPixel() const { return 1 + (cities_ > 0 ? 1 : 0) + scatterers_ + (scatterers_ + 3) / 4; }

} // namespace showmysky
