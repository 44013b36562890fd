#pragma once
// Draws the sky of a model into a luminance texture, in the OpenGL context of a host program (3.3 core or ES 3.0, newer
// too).
//
// Rules for hosts
// - The context given at the start is current whenever a function of Sky is called, and while a Sky dies. If the
// context was
//   lost or is gone, call Sky::abandonContext() first; then only the destructor and the questions about the model are
//   allowed.
// - Every call leaves all OpenGL state as it was. Errors that the host left unread are dropped.
// - One thread at a time for one Sky. Several may live in one context, or in several.
// - Everything throws showmysky::Error and nothing else.

#include "showmysky/error.hpp"
#include "showmysky/export.h"
#include "showmysky/settings.hpp"
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace showmysky {

/// Finds an OpenGL function by its name; null where there is none.
using GlLoader = std::function<void*(const char* name)>;

enum class Projection {
    equirectangular, ///< `fieldOfView` wide, half as much high where the picture is twice as wide as high
    perspective,
    fisheye ///< equidistant: the angle from the axis is proportional to the distance from the middle
};

/// Where the camera looks. Angles in rad.
struct Camera {
    Projection projection = Projection::perspective;
    double fieldOfView = 1.5707963268; ///< over the width of the picture; perspective: < pi, others: <= 2 pi
    double yaw = 0;                    ///< azimuth of the middle of the picture, from North over East
    double pitch = 0;                  ///< elevation of the middle of the picture
    /// A texture of the host, width x height: x, y, z of the direction of each pixel, of any length; 0, 0, 0 draws
    /// nothing. If not 0 it takes the place of all above.
    unsigned directionTexture = 0;
};

/// X, Y, Z (CIE 1931, 2 degrees) and scotopic luminance, cd m^-2.
struct Luminance {
    float x = 0, y = 0, z = 0, scotopic = 0;
};

/// What a step of loading or preparing is about.
struct Progress {
    bool done = false;
    double fraction = 0;  ///< 0..1 of the whole
    std::string activity; ///< "Reading the medium", for instance; what comes next
};

struct Options {
    /// GLSL of the host, in place of the built-in projections: `vec3 viewDirection(vec2 position)`. `position` is in
    /// pixels from the lower left corner; the vector is in the frame of settings.hpp, of any length; vec3(0.0) draws
    /// nothing. It may declare uniforms of its own, set through Sky::program.
    std::string viewDirectionFunction{};
    bool halfFloats = false;                       ///< 16-bit luminance texture and tables; on OpenGL ES always
    std::function<void(const std::string&)> log{}; ///< takes warnings; without it there are none
};

/// How Sun and Moon stand to each other for a camera. Angles in rad. The horizon isn't counted.
struct EclipseState {
    enum class Phase { none, partial, annular, total };
    Phase phase = Phase::none;
    double obscuration = 0; ///< share of the disc's area that the Moon hides, 0..1
    double magnitude = 0;   ///< share of the disc's diameter that is hidden; when central, the ratio of the diameters
    double separation = 0;  ///< of the centres
    double sunAngularRadius = 0, moonAngularRadius = 0;
};

/// The sky of one model.
class SHOWMYSKY_API Sky
{
public:
    /// Prepares to load; nothing is read yet.
    Sky(const std::string& modelDirectory, GlLoader loader, Options options = {});
    ~Sky();
    Sky(Sky&&) noexcept;
    Sky& operator=(Sky&&) noexcept;

    // Loading: in steps of some tens of milliseconds, or at once. To cancel, destroy the Sky.
    Progress loadStep();
    void loadAll();
    bool loaded() const;

    // The model.
    const std::vector<double>& wavelengths() const;     ///< nm
    const std::vector<double>& solarIrradiance() const; ///< W m^-2 nm^-1, settings' factors not applied
    std::vector<std::string> scatterers() const;
    bool hasSource(Source source) const;
    /// Empty if these settings can be drawn; otherwise a sentence that says why not.
    std::string whyUnsupported(const SceneSettings& settings) const;
    double topOfAtmosphere() const;  ///< m
    double planetRadius() const;     ///< m
    double sunAngularRadius() const; ///< rad
    double moonDistance() const;     ///< m, from the planet's centre, of the model's eclipse table

    // The scene.
    /// Keeps the settings; nothing is computed until they are needed.   throws settings, unsupported: the former scene
    /// stays
    void setSettings(const SceneSettings& settings);
    const SceneSettings& settings() const;
    /// Sun and Moon of any settings, whether they ask for an eclipse or not.   throws settings: the Moon can't be there
    EclipseState eclipseState(const SceneSettings& settings) const;
    /// True if these settings are drawn from the model's eclipse table: SceneSettings::precomputedEclipse asks for it, and Sun and Moon
    /// stand concentric before the camera, of the radii that the table was made for, up to 3 % of their difference.
    bool usesEclipseTable(const SceneSettings& settings) const;
    /// Computes a part of what the settings changed, some tens of milliseconds: call until done, then draw() doesn't wait. draw() does
    /// what is left. Light of cities is computed by threads that go on between the calls.
    Progress prepareStep();

    // Drawing.
    /// Draws width x height / reduction pixels into luminanceTexture(). Nothing happens if nothing changed since the
    /// last time.
    ///   reduction  >= 1: pixels per drawn pixel, both ways, for scenes in motion
    ///   returns    true if it was drawn anew
    bool draw(const Camera& camera, int width, int height, int reduction = 1);
    /// The same of the last scene that was prepared to the end, and never waits: for a camera that turns while prepareStep() is at
    /// work on the next. False before the first such scene.
    bool drawPrepared(const Camera& camera, int width, int height, int reduction = 1);
    /// RGBA: X, Y, Z, scotopic in cd m^-2, bottom row first. Belongs to the Sky; a new one after a change of size.
    unsigned luminanceTexture() const;
    int width() const; ///< of the luminance texture
    int height() const;
    /// All of luminanceTexture(): [height][width], bottom row first. Waits for the GPU.
    std::vector<Luminance> readLuminance() const;

    // Questions about a pixel of the last picture, counted from its lower left corner.
    Luminance pixelLuminance(int x, int y) const;
    /// W m^-2 sr^-1 nm^-1 at wavelengths(), computed in double precision from the moments for this direction alone.
    std::vector<double> pixelSpectralRadiance(int x, int y);
    /// Unit vector; 0, 0, 0 where nothing is drawn.
    std::array<double, 3> viewDirection(int x, int y);
    /// The same for any direction, without a picture: layers as the settings say, but for the solar disc.
    std::vector<double> spectralRadiance(const std::array<double, 3>& direction);

    // For shaders of the host.
    /// GLSL to put into a fragment shader of the host, after #version and before its own code; of this model, any scene. It
    /// declares uniforms, all with names that begin with showmysky, and, for OpenGL ES, highp as the default precision.
    /// Results are X, Y, Z (cd m^-2, lx) and scotopic; directions, of any length, stand in the frame of settings.hpp.
    ///     vec4 showmyskyRadiance(vec3 direction)                       sky or ground, with cities, without the solar disc
    ///     vec4 showmyskySolarDisc(vec3 direction, float pixelAngle)    the disc, what the Moon leaves of it, its edge smoothed over rad;
    ///                                                                  to be added. Layers::solarDisc plays no part
    ///     vec4 showmyskyRadianceTo(vec3 direction, float distance)     the air up to a point at a distance, m
    ///     vec4 showmyskyTransmittance(vec3 direction, float distance)  of that air, 0..1, for light of the Sun's spectrum
    ///     vec4 showmyskySunIlluminance(vec3 normal)                    by the Sun's disc, through the air: of a surface
    ///     vec4 showmyskySunIlluminance()                               of a horizontal one
    ///     vec4 showmyskySkyIlluminance()                               of a horizontal one by the sky
    /// A point in the scene is seen with showmyskyTransmittance times its own light plus showmyskyRadianceTo. docs/library.md
    /// has an example, and what they leave out.
    std::string shaderFunctions() const;
    /// Gives a program that contains them what they need of the present scene: sets its uniforms, and leaves textures bound
    /// to three units from `firstTextureUnit` on, five where the scene has cities, without sampler objects. To be repeated after setSettings(), and where the
    /// host has bound other textures there. Computes what is missing; the first call makes prepareStep() do so from then on, the first
    /// program that asks for light up to a point adds that.
    ///   throws  settings: `program` isn't linked, or the context has fewer units
    void bindShaderFunctions(unsigned program, unsigned firstTextureUnit);

    /// The OpenGL program that draws, for uniforms of the host's viewDirection().
    unsigned program() const;
    /// Bytes of textures that this Sky holds on the GPU, and texture fetches for one pixel of the last picture.
    std::size_t textureBytes() const;
    int fetchesPerPixel() const;

    /// The context is lost or gone: no OpenGL is called any more, and the destructor leaves it alone.
    void abandonContext();

private:
    struct Inside;
    std::unique_ptr<Inside> inside_;
};

/// Unit vector of an azimuth and a zenith angle (rad) in the frame of settings.hpp.
SHOWMYSKY_API std::array<double, 3> directionOf(double azimuth, double zenithAngle);

} // namespace showmysky
