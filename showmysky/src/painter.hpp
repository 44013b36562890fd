#pragma once
// The full-resolution pass: what OpenGL holds and does.

#include "cities.hpp"
#include "gl/framebuffer.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"
#include "showmysky/sky.hpp"
#include "sky_view.hpp"
#include "uniforms.hpp"
#include <optional>

namespace showmysky {

constexpr int sunColourCount = 8; ///< samples of the disc's luminance from its lower to its upper edge

/// What the picture depends on beside the tables.
struct SceneGeometry {
    std::array<double, 3> sunDirection{};
    double horizon = 0;    ///< elevation, rad
    double dipTangent = 0; ///< of its angle below the horizontal
    double sunRadius = 0;  ///< rad
    bool showSun = false;
    std::array<Texel, sunColourCount> sunColours{};
    bool eclipse = false;
    std::array<double, 3> moonDirection{};
    double moonRadius = 0; ///< rad
    Texel limbExponents{}; ///< of the disc's darkening towards its limb
    bool mirror = false;
    bool filter = true;
};

class Painter
{
public:
    /// Must be made, used and destroyed with the context current; does not guard the host's state, the caller does.
    ///   phases   Phases::texels(phaseWidth)
    Painter(const sky::gl::Api& api, int scatterers, const std::vector<Texel>& phases, const Options& options);
    static constexpr int phaseWidth = 2048;

    /// Others of as many scatterers.
    void setPhases(const std::vector<Texel>& phases);
    void setSky(const SkyView& view, const SceneGeometry& geometry);
    void setCities(const CityLight& light);
    void draw(const Camera& camera, int width, int height, int reduction);
    /// Direction of the middle of a drawn pixel, drawn by the shader itself: for directions that only the host knows.
    std::array<double, 3> drawDirection(const Camera& camera, int x, int y);

    const sky::gl::Texture2D& luminance() const { return *luminance_; }
    bool hasPicture() const { return luminance_.has_value(); }
    std::vector<float> read() const { return target_.readPixels(0); }
    Texel readPixel(int x, int y) const;
    int pictureWidth() const { return pictureWidth_; } ///< as asked for, before the reduction
    int pictureHeight() const { return pictureHeight_; }
    int reduction() const { return reduction_; }
    unsigned program() const { return program_.name(); }
    /// What the functions of shaders/render/sky_light.glsl, city_light.glsl and sun_disc.glsl read.
    const Uniforms& lightUniforms() const { return light_; }
    const sky::gl::Texture2D& skyTables() const { return tables_; }
    const sky::gl::Texture2D& phases() const { return phases_; }
    bool hasCities() const { return cities_ > 0; }
    const sky::gl::Texture2D& cityAir() const { return cityAir_; }
    const sky::gl::Texture2D& cityDiscs() const { return cityDiscs_; }
    /// What these functions need defined.
    static std::vector<sky::gl::Define> lightDefines(int scatterers);
    std::size_t textureBytes() const;
    int fetchesPerPixel() const;

private:
    /// Remakes the program where the sky now needs another one. Uniforms keep their values.
    void makeFor(bool eclipse, bool cities);
    void set(const std::string& name, const UniformValue& value);
    void setLight(const std::string& name, const UniformValue& value);
    void setAxes(const SkyView& view, const SceneGeometry& geometry);
    void setCamera(const Camera& camera, int width, int height);

    sky::gl::Api api_;
    bool half_, hostProjection_;
    int scatterers_;
    sky::gl::Program program_;
    Uniforms light_, own_; // what the program's uniforms are set to
    Options options_;
    bool eclipse_ = false, withCities_ = false; // what the program is made for
    sky::gl::VertexArray triangle_;
    sky::gl::Texture2D phases_, tables_, cityAir_, cityDiscs_;
    int cities_ = 0;
    sky::gl::Texture2D direction_;
    std::optional<sky::gl::Texture2D> luminance_;
    sky::gl::Framebuffer target_, directionTarget_;
    int pictureWidth_ = 0, pictureHeight_ = 0, reduction_ = 1;
};

} // namespace showmysky
