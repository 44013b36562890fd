#include "scene_fields.hpp"

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "number_text.hpp"
#include <algorithm>

namespace showmysky::app {

namespace {

using Names = const std::vector<std::string>&;

std::string quotedList(Names words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "`" : i + 1 == words.size() ? " or `" : ", `") + words[i] + "`";
    return text;
}

std::string joined(Names words)
{
    std::string text;
    for (const auto& word : words)
        text += (text.empty() ? "" : ",") + word;
    return text;
}

std::size_t indexOf(std::string_view word, Names words)
{
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
        throw sky::UsageError("`" + std::string(word) + "` is not understood; expected " + quotedList(words) + "." +
                              sky::suggestion(word, words));
    return static_cast<std::size_t>(found - words.begin());
}

double numberFrom(std::string_view text)
{
    const auto value = parseNumber(text);
    if (!value)
        throw sky::UsageError("`" + std::string(text) + "` is not a number.");
    return *value;
}

bool switchFrom(std::string_view text)
{
    static const std::vector<std::string> words{"no", "yes", "false", "true"};
    return indexOf(text, words) % 2 == 1;
}

template<class Get>
SceneField number(const char* name, const char* group, const char* help, Get get)
{
    return {name,
            group,
            help,
            SceneField::Kind::value,
            [get](SceneOptions& scene, std::string_view text) { get(scene) = numberFrom(text); },
            [get](const SceneOptions& scene) { return toText(double(get(scene))); },
            [get](SceneOptions& scene) -> double& { return get(scene); }};
}

template<class Get>
SceneField flag(const char* name, const char* group, const char* help, Get get)
{
    return {name,
            group,
            help,
            SceneField::Kind::flag,
            [get](SceneOptions& scene, std::string_view text) { get(scene) = switchFrom(text); },
            [get](const SceneOptions& scene) { return get(scene) ? "yes" : "no"; }};
}

/// One of an enumeration whose names are `words`, in its order.
template<class Get>
SceneField choice(const char* name, const char* group, const std::string& help, Names words, Get get)
{
    return {name,
            group,
            help + quotedList(words),
            SceneField::Kind::value,
            [get, &words](SceneOptions& scene, std::string_view text) {
                auto& value = get(scene);
                value = static_cast<std::decay_t<decltype(value)>>(indexOf(text, words));
            },
            [get, &words](const SceneOptions& scene) { return words[static_cast<std::size_t>(get(scene))]; }};
}

template<class Get>
SceneField list(const char* name, const char* group, const char* help, const std::vector<std::string>* allowed, Get get)
{
    return {name,
            group,
            help,
            SceneField::Kind::list,
            [get, allowed](SceneOptions& scene, std::string_view text) {
                auto words = splitAtCommas(text);
                if (allowed)
                    for (const auto& word : words)
                        indexOf(word, *allowed);
                get(scene) = std::move(words);
            },
            [get](const SceneOptions& scene) { return joined(get(scene)); }};
}

const std::vector<std::string>& sourceNames()
{
    static const std::vector<std::string> names{"moments", "textures"};
    return names;
}

const std::vector<std::string>& layerNames()
{
    static const std::vector<std::string> names{"zero", "sun", "single", "multiple"};
    return names;
}

/// A member of a scene, which may be const.
template<class T>
auto of(T SceneOptions::*member)
{
    return [member](auto& scene) -> auto& { return scene.*member; };
}

template<class T>
auto of(T Development::*member)
{
    return [member](auto& scene) -> auto& { return scene.development.*member; };
}

std::vector<SceneField> makeFields()
{
    constexpr const char *scene = "Scene", *picture = "Picture";
    SceneField exposure =
        number("exposure", picture, "log10 of the factor on luminance in cd/m^2, or `auto`, the default", of(&Development::exposure));
    exposure.read = [](SceneOptions& options, std::string_view text) {
        options.development.automatic = text == "auto";
        if (text != "auto")
            options.development.exposure = numberFrom(text);
    };
    exposure.write = [](const SceneOptions& options) {
        return options.development.automatic ? "auto" : toText(options.development.exposure);
    };
    exposure.number = [](SceneOptions& options) -> double& {
        options.development.automatic = false;
        return options.development.exposure;
    };
    const SceneField solarSpectrum{"solar-spectrum",
                                   scene,
                                   "`model`, `flat`, `black-body:TEMPERATURE`, or factors on the model's, one per wavelength",
                                   SceneField::Kind::value,
                                   [](SceneOptions& options, std::string_view text) { options.solarSpectrum = parseSolarSpectrum(text); },
                                   [](const SceneOptions& options) { return toText(options.solarSpectrum); }};
    const SceneField cities{
        "city",
        scene,
        "distance=M,azimuth=DEGREES,radius=M,luminance=CD/M2[,spectrum=A:B:...]: a glowing disc on the ground; lengths may "
        "end in km; more after semicolons, or more options",
        SceneField::Kind::repeated,
        [](SceneOptions& options, std::string_view text) { options.cities = parseCities(text); },
        [](const SceneOptions& options) { return toText(options.cities); }};
    return {
        number("altitude", scene, "of the camera, m", of(&SceneOptions::altitude)),
        number("sun-zenith", scene, "zenith angle of the Sun, degrees", of(&SceneOptions::sunZenith)),
        number("sun-azimuth", scene, "from North over East, degrees", of(&SceneOptions::sunAzimuth)),
        number("sun-radius", scene, "angular radius, degrees; 0: as the model says", of(&SceneOptions::sunRadius)),
        number("moon-zenith", scene, "zenith angle of the Moon, degrees", of(&SceneOptions::moonZenith)),
        number("moon-azimuth", scene, "degrees", of(&SceneOptions::moonAzimuth)),
        number("moon-distance", scene, "from the planet's centre, m", of(&SceneOptions::moonDistance)),
        flag("eclipse", scene, "let the Moon hide the Sun", of(&SceneOptions::eclipse)),
        number("eclipse-orders", scene, "scatterings followed through the shadow; 0: as many as the model has",
               of(&SceneOptions::eclipseOrders)),
        flag("precomputed-eclipse", scene, "with textures: where Sun and Moon stand concentric, take higher orders from the model's table",
             of(&SceneOptions::precomputedEclipse)),
        flag("eclipse-fine", scene, "finer tables in an eclipse, for stills", of(&SceneOptions::eclipseFine)),
        flag("limb-darkening", scene, "in an eclipse, let the Sun be darker towards its limb", of(&SceneOptions::limbDarkening)),
        number("light-pollution", scene, "luminance of the ground, cd/m^2", of(&SceneOptions::lightPollution)),
        cities,
        choice("source", scene, "tables that the light comes from: ", sourceNames(), of(&SceneOptions::source)),
        flag("on-the-fly", scene, "with textures: gather single scattering instead of looking it up", of(&SceneOptions::onTheFly)),
        list("layers", scene, "of zero (the ground), sun, single, multiple", &layerNames(), of(&SceneOptions::layers)),
        list("hide-scatterer", scene, "leave out single scattering of these, separated by commas", nullptr,
             of(&SceneOptions::hiddenScatterers)),
        solarSpectrum,
        flag("mirror", scene, "mirror the sky below the horizon instead of showing the ground", of(&SceneOptions::mirror)),
        flag("unfiltered", scene, "show the texels of the sky tables", of(&SceneOptions::unfiltered)),
        choice("projection", picture, "", projectionNames(), of(&SceneOptions::projection)),
        number("fov", picture, "field of view over the width, degrees", of(&SceneOptions::fieldOfView)),
        number("yaw", picture, "azimuth of the picture's middle, degrees", of(&SceneOptions::yaw)),
        number("pitch", picture, "elevation of the picture's middle, degrees", of(&SceneOptions::pitch)),
        exposure,
        choice("tone-mapping", picture, "", toneCurveNames(), of(&Development::curve)),
        choice("colours", picture, "", colourModeNames(), of(&Development::colours)),
        flag("gradual-clipping", picture, "fade too bright colours to white instead of cutting off each channel",
             of(&Development::gradualClipping)),
        number("glare", picture, "light scattered in the eye; 0: none, 1: as in a healthy one", of(&Development::glare)),
        choice("dithering", picture, "", ditheringNames(), of(&Development::dithering)),
        choice("depth", picture, "bits of red, green and blue: ", depthNames(), of(&Development::depth)),
    };
}

} // namespace

const std::vector<std::string>& projectionNames()
{
    static const std::vector<std::string> names{"equirectangular", "perspective", "fisheye"};
    return names;
}

const std::vector<std::string>& toneCurveNames()
{
    static const std::vector<std::string> names{"exponential", "reinhard", "linear"};
    return names;
}

const std::vector<std::string>& colourModeNames()
{
    static const std::vector<std::string> names{
        "srgb",
        "photopic",
        "scotopic",
        "xyz-chromaticity-smooth",
        "xyz-chromaticity-bright",
        "srgb-chromaticity-smooth",
        "srgb-chromaticity-bright",
        "hue",
        "x",
        "z",
        "red",
        "green",
        "blue",
    };
    return names;
}

const std::vector<std::string>& ditheringNames()
{
    static const std::vector<std::string> names{"none", "ordered", "blue-noise"};
    return names;
}

const std::vector<std::string>& depthNames()
{
    static const std::vector<std::string> names{"5/6/5", "6/6/6", "8/8/8", "10/10/10"};
    return names;
}

const std::vector<SceneField>& sceneFields()
{
    static const std::vector<SceneField> fields = makeFields();
    return fields;
}

} // namespace showmysky::app
