// The public face: OpenGL around a Scene, state guarded, errors translated.

#include "showmysky/sky.hpp"

#include "gl/context.hpp"
#include "gl/state_guard.hpp"
#include "host_functions.hpp"
#include "scene.hpp"
#include "translate.hpp"
#include "view_direction.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace gl = sky::gl;

struct Sky::Inside {
    /// What a picture was drawn with.
    struct Drawn {
        int version = -1, width = 0, height = 0, reduction = 0;
        Camera camera;

        bool operator==(const Drawn& other) const
        {
            return version == other.version && width == other.width && height == other.height && reduction == other.reduction &&
                   camera.projection == other.camera.projection && camera.fieldOfView == other.camera.fieldOfView &&
                   camera.yaw == other.camera.yaw && camera.pitch == other.camera.pitch &&
                   camera.directionTexture == other.camera.directionTexture;
        }
    };

    Inside(const std::string& directory, const GlLoader& loader, Options options_)
        : options(std::move(options_)), context(loader), scene(directory)
    {
    }

    void requireLoaded() const
    {
        if (!loaded)
            throw Error(ErrorKind::other, "The model isn't loaded yet.");
    }
    void requireContext() const
    {
        if (!context.api().alive())
            throw Error(ErrorKind::openGl, "The OpenGL context of this sky was given up.");
    }
    void requirePixel(int x, int y) const
    {
        requireLoaded();
        if (!painter->hasPicture())
            throw Error(ErrorKind::other, "Nothing has been drawn yet.");
        const auto& size = painter->luminance().size();
        if (x < 0 || y < 0 || x >= size.width || y >= size.height)
            throw Error(ErrorKind::settings, "There is no pixel " + std::to_string(x) + ", " + std::to_string(y) + " in a picture of " +
                                                 std::to_string(size.width) + " x " + std::to_string(size.height) + ".");
    }
    void requireDrawable(const Camera& camera, int width, int height, int reduction) const
    {
        requireLoaded();
        requireContext();
        const int most = context.api().limits().textureSize;
        if (width < 1 || height < 1 || width > most || height > most || reduction < 1)
            throw Error(ErrorKind::settings, "A picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                                 " pixels can't be drawn: sides must be 1 to " + std::to_string(most) +
                                                 ", the reduction at least 1.");
        if (camera.directionTexture == 0)
            projectionScale(camera, width, height);
    }
    /// True if there was something to draw.
    bool draw(const Drawn& wanted)
    {
        // What a host's function or texture returns may have changed without our knowing.
        const bool known = options.viewDirectionFunction.empty() && wanted.camera.directionTexture == 0;
        if (known && wanted == drawn)
            return false;
        drawn = {};
        const gl::StateGuard guard(context.api());
        if (wanted.version == scene.version())
            uploadIfReady();
        painter->draw(wanted.camera, wanted.width, wanted.height, wanted.reduction);
        drawn = wanted;
        return true;
    }
    /// Puts the tables on the GPU once they are there.
    void uploadIfReady()
    {
        if (!scene.ready() || uploaded == scene.version())
            return;
        if (phasesUploaded != scene.phases().version())
            painter->setPhases(scene.phases().texels(Painter::phaseWidth));
        phasesUploaded = scene.phases().version();
        painter->setSky(scene.view(), scene.geometry());
        painter->setCities(scene.cityLight());
        uploaded = scene.version();
    }
    /// Does a part of the work; true once all is done.
    bool prepareHostFunctions()
    {
        if (hostVersion == scene.version())
            return true;
        if (distancesAsked && !scene.aerialStep())
            return false;
        hostFunctions->set(distancesAsked ? &scene.aerial() : nullptr, scene.atmosphere().planet(), scene.settings().altitude,
                           scene.illuminance());
        hostVersion = scene.version();
        return true;
    }
    std::array<double, 3> direction(int x, int y)
    {
        requirePixel(x, y);
        if (!options.viewDirectionFunction.empty() || drawn.camera.directionTexture != 0) {
            requireContext();
            const gl::StateGuard guard(context.api());
            return painter->drawDirection(drawn.camera, x, y);
        }
        const auto& size = painter->luminance().size();
        const double scale = double(painter->pictureWidth()) / size.width;
        return builtInDirection(drawn.camera, painter->pictureWidth(), painter->pictureHeight(), (x + 0.5) * scale, (y + 0.5) * scale);
    }

    Options options;
    gl::BorrowedContext context;
    Scene scene;
    std::unique_ptr<Painter> painter;
    std::unique_ptr<HostFunctions> hostFunctions; ///< once a host has bound them
    bool distancesAsked = false;                  ///< by one of its programs
    int hostVersion = -1;                         ///< of the scene that they have
    Drawn drawn;
    int nextStep = 0;
    int phasesUploaded = 0; ///< version that the painter has
    int uploaded = -1;
    bool loaded = false;
};

Sky::Sky(const std::string& modelDirectory, GlLoader loader, Options options)
    : inside_(translated([&] { return std::make_unique<Inside>(modelDirectory, loader, std::move(options)); }))
{
}

Sky::~Sky() = default;
Sky::Sky(Sky&&) noexcept = default;
Sky& Sky::operator=(Sky&&) noexcept = default;

Progress Sky::loadStep()
{
    return translated([&]() -> Progress {
        auto& in = *inside_;
        constexpr int steps = Scene::loadSteps + 1;
        if (in.loaded)
            return {true, 1, {}};
        in.requireContext();
        if (in.nextStep < Scene::loadSteps) {
            in.scene.load(in.nextStep);
        } else {
            const gl::StateGuard guard(in.context.api());
            const auto& phases = in.scene.phases();
            in.painter = std::make_unique<Painter>(in.context.api(), in.scene.atmosphere().scatterers(), phases.texels(Painter::phaseWidth),
                                                   in.options);
            in.loaded = true;
            if (in.options.log) {
                for (const auto& warning : in.scene.atmosphere().model.manifest().warnings)
                    in.options.log("The model warns: " + warning);
                if (in.scene.skyLeavesGroundDark())
                    in.options.log("The model has no moments, so that the sky doesn't light the ground: only the Sun does.");
            }
            return {true, 1, {}};
        }
        ++in.nextStep;
        return {false, double(in.nextStep) / steps,
                in.nextStep < Scene::loadSteps ? Scene::loadActivity(in.nextStep) : "Compiling shaders"};
    });
}

void Sky::loadAll()
{
    while (!loadStep().done) {
    }
}

bool Sky::loaded() const { return inside_->loaded; }

const std::vector<double>& Sky::wavelengths() const
{
    inside_->requireLoaded();
    return inside_->scene.atmosphere().medium.wavelengthsNm;
}

const std::vector<double>& Sky::solarIrradiance() const
{
    inside_->requireLoaded();
    return inside_->scene.atmosphere().medium.solarIrradiance;
}

std::vector<std::string> Sky::scatterers() const
{
    inside_->requireLoaded();
    const auto& atmosphere = inside_->scene.atmosphere();
    std::vector<std::string> names;
    for (const int s : atmosphere.optics.scatterers)
        names.push_back(atmosphere.medium.species[static_cast<std::size_t>(s)].name);
    return names;
}

bool Sky::hasSource(Source source) const
{
    inside_->requireLoaded();
    return inside_->scene.hasSource(source);
}

std::string Sky::whyUnsupported(const SceneSettings& settings) const
{
    inside_->requireLoaded();
    return inside_->scene.whyUnsupported(settings);
}

double Sky::topOfAtmosphere() const
{
    inside_->requireLoaded();
    return inside_->scene.atmosphere().planet().topOfAtmosphere;
}

double Sky::planetRadius() const
{
    inside_->requireLoaded();
    return inside_->scene.atmosphere().planet().radius;
}

double Sky::sunAngularRadius() const
{
    inside_->requireLoaded();
    return inside_->scene.atmosphere().medium.sunAngularRadius;
}

double Sky::moonDistance() const
{
    inside_->requireLoaded();
    return inside_->scene.atmosphere().model.manifest().moonDistance;
}

void Sky::setSettings(const SceneSettings& settings)
{
    translated([&] {
        inside_->requireLoaded();
        inside_->scene.setSettings(settings);
    });
}

const SceneSettings& Sky::settings() const { return inside_->scene.settings(); }

EclipseState Sky::eclipseState(const SceneSettings& settings) const
{
    return translated([&] {
        inside_->requireLoaded();
        return inside_->scene.eclipseState(settings);
    });
}

bool Sky::usesEclipseTable(const SceneSettings& settings) const
{
    return translated([&] {
        inside_->requireLoaded();
        return inside_->scene.usesEclipseTable(settings);
    });
}

Progress Sky::prepareStep()
{
    return translated([&]() -> Progress {
        auto& in = *inside_;
        in.requireLoaded();
        in.requireContext();
        const Progress progress = in.scene.step();
        if (!progress.done)
            return progress;
        const gl::StateGuard guard(in.context.api());
        in.uploadIfReady();
        if (in.hostFunctions && !in.prepareHostFunctions())
            return {false, 0.95, "Following light to distances"};
        return progress;
    });
}

bool Sky::draw(const Camera& camera, int width, int height, int reduction)
{
    return translated([&] {
        auto& in = *inside_;
        in.requireDrawable(camera, width, height, reduction);
        while (!in.scene.step().done) {
        }
        return in.draw({in.scene.version(), width, height, reduction, camera});
    });
}

bool Sky::drawPrepared(const Camera& camera, int width, int height, int reduction)
{
    return translated([&] {
        auto& in = *inside_;
        in.requireDrawable(camera, width, height, reduction);
        return in.uploaded >= 0 && in.draw({in.uploaded, width, height, reduction, camera});
    });
}

unsigned Sky::luminanceTexture() const
{
    return inside_->painter && inside_->painter->hasPicture() ? inside_->painter->luminance().name() : 0;
}

int Sky::width() const { return luminanceTexture() ? inside_->painter->luminance().size().width : 0; }
int Sky::height() const { return luminanceTexture() ? inside_->painter->luminance().size().height : 0; }

std::vector<Luminance> Sky::readLuminance() const
{
    return translated([&] {
        inside_->requirePixel(0, 0);
        inside_->requireContext();
        const gl::StateGuard guard(inside_->context.api());
        const auto values = inside_->painter->read();
        std::vector<Luminance> result(values.size() / 4);
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
        return result;
    });
}

Luminance Sky::pixelLuminance(int x, int y) const
{
    return translated([&]() -> Luminance {
        inside_->requirePixel(x, y);
        inside_->requireContext();
        const gl::StateGuard guard(inside_->context.api());
        const Texel texel = inside_->painter->readPixel(x, y);
        return {texel[0], texel[1], texel[2], texel[3]};
    });
}

std::array<double, 3> Sky::viewDirection(int x, int y)
{
    return translated([&] { return inside_->direction(x, y); });
}

std::vector<double> Sky::pixelSpectralRadiance(int x, int y)
{
    return translated([&] { return inside_->scene.spectralRadiance(inside_->direction(x, y)); });
}

std::vector<double> Sky::spectralRadiance(const std::array<double, 3>& direction)
{
    return translated([&] {
        inside_->requireLoaded();
        return inside_->scene.spectralRadiance(direction);
    });
}

std::string Sky::shaderFunctions() const
{
    return translated([&] {
        inside_->requireLoaded();
        return HostFunctions::source(inside_->scene.atmosphere().scatterers());
    });
}

void Sky::bindShaderFunctions(unsigned program, unsigned firstTextureUnit)
{
    translated([&] {
        auto& in = *inside_;
        in.requireLoaded();
        in.requireContext();
        while (!in.scene.step().done) {
        }
        {
            const gl::StateGuard guard(in.context.api());
            in.uploadIfReady();
            if (!in.hostFunctions)
                in.hostFunctions =
                    std::make_unique<HostFunctions>(in.context.api(), in.scene.atmosphere().scatterers(), in.painter->skyTables().format());
            if (in.hostFunctions->asksForDistances(program) && !in.distancesAsked) {
                in.distancesAsked = true;
                in.hostVersion = -1;
            }
            while (!in.prepareHostFunctions()) {
            }
        }
        in.hostFunctions->bind(program, firstTextureUnit, *in.painter);
    });
}

unsigned Sky::program() const { return inside_->painter ? inside_->painter->program() : 0; }
std::size_t Sky::textureBytes() const
{
    const auto& in = *inside_;
    return (in.painter ? in.painter->textureBytes() : 0) + (in.hostFunctions ? in.hostFunctions->textureBytes() : 0);
}
int Sky::fetchesPerPixel() const { return inside_->painter ? inside_->painter->fetchesPerPixel() : 0; }

void Sky::abandonContext() { inside_->context.abandon(); }

} // namespace showmysky
