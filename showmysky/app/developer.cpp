#include "developer.hpp"

#include "blue_noise.hpp"
#include "sky_shaders.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky::app {

namespace gl = sky::gl;

namespace {

constexpr int sampleWidth = 96, sampleHeight = 64, noiseSide = 64;
constexpr GLuint luminanceUnit = 0, veilUnit = 1, noiseUnit = 2;
/// Stiles and Holladay: a glare source of illuminance E gives a veil of 10 E / angle^2 (degrees), the same light in
/// each octave of angle: 2 pi ln 2 * 10 * (pi / 180)^2.
constexpr float sharePerOctave = 0.013267f;
constexpr float largestShare = 0.9f;
constexpr int fewestTexels = 4; // of the smallest level's shorter side

gl::Program program(const gl::Api& api, const char* label, const char* fragmentPath)
{
    return gl::ProgramBuilder(api, sky::shaders::source).graphics(label, "render/triangle.vert", fragmentPath);
}

/// Half floats where the driver need not draw into or filter others.
gl::TextureFormat format(const gl::Api& api) { return api.isEs() ? gl::TextureFormat::rgba16f : gl::TextureFormat::rgba32f; }

std::array<float, 3> stepsOf(Depth depth)
{
    switch (depth) {
    case Depth::bits565: return {31, 63, 31};
    case Depth::bits666: return {63, 63, 63};
    case Depth::bits101010: return {1023, 1023, 1023};
    case Depth::bits888: break;
    }
    return {255, 255, 255};
}

std::array<float, 2> floats(int width, int height) { return {static_cast<float>(width), static_cast<float>(height)}; }

} // namespace

Developer::Target::Target(const gl::Api& api, const char* label, gl::TextureFormat format, int width, int height)
    : texture(api, label, format, width, height), framebuffer(api, label)
{
    framebuffer.attach(0, texture);
}

Developer::Developer(const gl::Api& api)
    : api_(api), triangle_(api, "developing triangle"), develop_(program(api, "develop", "render/develop.frag")),
      shrink_(program(api, "shrink", "render/shrink.frag")), gather_(program(api, "gather", "render/gather.frag")),
      sample_(program(api, "sample", "render/sample.frag")), samples_(api, "samples", format(api), sampleWidth, sampleHeight)
{
}

void Developer::makeVeil(unsigned luminance, const Area& area, float factor)
{
    const int width = std::max(1, area.width / 2), height = std::max(1, area.height / 2);
    if (shrunk_.empty() || !(shrunk_[0].texture.size() == gl::TextureSize{width, height, 1})) {
        shrunk_.clear();
        veils_.clear();
        for (int w = width, h = height; shrunk_.empty() || std::min(w, h) >= fewestTexels; w /= 2, h /= 2) {
            shrunk_.emplace_back(api_, "shrunk light", format(api_), w, h);
            veils_.emplace_back(api_, "veil", format(api_), w, h);
        }
    }
    const auto levels = shrunk_.size();
    for (std::size_t i = 0; i < levels; ++i) {
        const gl::Bound target(shrunk_[i].framebuffer);
        const gl::Bound pass(shrink_);
        api_->ActiveTexture(GL_TEXTURE0);
        api_->BindTexture(GL_TEXTURE_2D, i == 0 ? luminance : shrunk_[i - 1].texture.name());
        shrink_.set("larger", 0);
        shrink_.set("size", floats(shrunk_[i].texture.size().width, shrunk_[i].texture.size().height));
        shrink_.set("factor", i == 0 ? factor : 1.f);
        shrink_.set("largest", api_.isEs() ? 65504.f : 1e30f);
        triangle_.drawFullScreenTriangle();
    }
    // Every octave of angle scatters the same: the mean over all levels.
    for (std::size_t i = levels; i-- > 0;) {
        const bool coarsest = i + 1 == levels;
        const float ownWeight = 1.f / static_cast<float>(levels - i);
        const gl::Bound target(veils_[i].framebuffer);
        const gl::Bound pass(gather_);
        gather_.setTexture("own", 0, shrunk_[i].texture);
        gather_.setTexture("coarser", 1, coarsest ? shrunk_[i].texture : veils_[i + 1].texture);
        gather_.set("size", floats(veils_[i].texture.size().width, veils_[i].texture.size().height));
        gather_.set("ownWeight", ownWeight);
        gather_.set("coarserWeight", 1.f - ownWeight);
        triangle_.drawFullScreenTriangle();
    }
}

void Developer::draw(unsigned luminance, const Development& development, double exposure, const Area& area)
{
    const auto factor = static_cast<float>(std::pow(10., exposure));
    const bool glare = development.glare > 0;
    if (glare)
        makeVeil(luminance, area, factor);
    if (development.dithering == Dithering::blueNoise && !noise_) {
        noise_.emplace(api_, "blue noise", gl::TextureFormat::r16f, noiseSide, noiseSide);
        noise_->upload(blueNoise(noiseSide));
    }
    api_->Viewport(area.x, area.y, area.width, area.height);
    const gl::Bound pass(develop_);
    const auto bind = [&](const char* sampler, GLuint unit, GLuint texture) {
        api_->ActiveTexture(GL_TEXTURE0 + unit);
        api_->BindTexture(GL_TEXTURE_2D, texture);
        develop_.set(sampler, static_cast<int>(unit));
    };
    bind("noise", noiseUnit, noise_ ? noise_->name() : 0);
    bind("veil", veilUnit, glare ? veils_[0].texture.name() : 0);
    bind("luminance", luminanceUnit, luminance);
    develop_.set("pictureOrigin", floats(area.x, area.y));
    develop_.set("pictureSize", floats(area.width, area.height));
    develop_.set("exposure", factor);
    const float share = glare ? sharePerOctave * static_cast<float>(veils_.size() * development.glare) : 0.f;
    develop_.set("scatteredShare", std::min(largestShare, share));
    develop_.set("colourMode", static_cast<int>(development.colours));
    develop_.set("curve", static_cast<int>(development.curve));
    develop_.set("gradual", development.gradualClipping ? 1 : 0);
    develop_.set("dithering", static_cast<int>(development.dithering));
    develop_.set("steps", stepsOf(development.depth));
    triangle_.drawFullScreenTriangle();
    api_->BindTexture(GL_TEXTURE_2D, 0);
    gl::checkErrors(api_, "developing a picture");
}

Levels Developer::levels(unsigned luminance, int width, int height, const Development& development, double exposure)
{
    Target target(api_, "developed picture", gl::TextureFormat::rgba8, width, height);
    const gl::Bound bound(target.framebuffer);
    draw(luminance, development, exposure, {0, 0, width, height});
    const auto values = target.framebuffer.readPixels(0, true);
    Levels result{width, height, {}};
    result.rgb.reserve(values.size() / 4 * 3);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (i % 4 != 3)
            result.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * values[i])));
    return result;
}

Picture Developer::sample(unsigned luminance)
{
    {
        const gl::Bound target(samples_.framebuffer);
        const gl::Bound pass(sample_);
        api_->ActiveTexture(GL_TEXTURE0);
        api_->BindTexture(GL_TEXTURE_2D, luminance);
        sample_.set("picture", 0);
        sample_.set("size", floats(sampleWidth, sampleHeight));
        triangle_.drawFullScreenTriangle();
    }
    const auto values = samples_.framebuffer.readPixels(0);
    Picture picture{sampleWidth, sampleHeight, {}};
    for (std::size_t i = 0; i < values.size(); i += 4)
        picture.pixels.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
    return picture;
}

} // namespace showmysky::app
