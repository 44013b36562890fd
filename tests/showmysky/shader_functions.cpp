// The GLSL functions in a host's own shader, against the picture, against their limits, and against integrals in double precision.

#include "sky_for_tests.hpp"

#include "atmosphere.hpp"
#include "bodies.hpp"
#include "eclipse_view.hpp"
#include "gl/framebuffer.hpp"
#include "gl/program.hpp"
#include "model/moment_tables.hpp"
#include "physics/sky.hpp"
#include "showmysky/photometry.hpp"
#include "sky_shaders.hpp"

using namespace showmysky;
using namespace showmysky::testing;
namespace gl = sky::gl;
namespace physics = sky::physics;

namespace {

/// A host program with names that the library uses inside: whatever `expression` says, at direction `d`.
class Host
{
public:
    Host(const gl::Api& api, const Sky& sky, const std::string& expression, int width, int height)
        : picture_(api, "host's", api.isEs() ? gl::TextureFormat::rgba16f : gl::TextureFormat::rgba32f, width, height),
          target_(api, "host's"), triangle_(api, "host's"), program_(build(api, sky, expression))
    {
        target_.attach(0, picture_);
        program_.set("size", std::array<float, 2>{static_cast<float>(width), static_cast<float>(height)});
    }

    std::vector<Luminance> draw(Sky& sky)
    {
        sky.bindShaderFunctions(program_.name(), 4);
        const gl::Bound target(target_);
        const gl::Bound pass(program_);
        triangle_.drawFullScreenTriangle();
        const auto values = target_.readPixels(0);
        std::vector<Luminance> result;
        for (std::size_t i = 0; i < values.size(); i += 4)
            result.push_back({values[i], values[i + 1], values[i + 2], values[i + 3]});
        return result;
    }
    /// At one direction.
    Luminance ask(Sky& sky, const std::array<double, 3>& direction, double distance)
    {
        program_.set("wanted", std::array<float, 3>{static_cast<float>(direction[0]), static_cast<float>(direction[1]),
                                                    static_cast<float>(direction[2])});
        program_.set("metres", static_cast<float>(distance));
        return draw(sky).front();
    }

private:
    static gl::Program build(const gl::Api& api, const Sky& sky, const std::string& expression)
    {
        const std::string fragment = sky.shaderFunctions() + R"(
const float halfPi = 3.0; // the host's own names
uniform vec3 horizon, wanted;
uniform float metres;
uniform vec2 size;
out vec4 colour;
float elevationOf(vec2 p) { return p.y; }
void main()
{
    vec2 p = (gl_FragCoord.xy / size - 0.5) * vec2(6.28318531, 3.14159265);
    vec3 d = vec3(cos(p.y) * cos(p.x), -cos(p.y) * sin(p.x), sin(elevationOf(p)));
    if (dot(wanted, wanted) > 0.0)
        d = wanted;
    colour = )" + expression + ";\n}\n";
        return gl::ProgramBuilder(api,
                                  [&](std::string_view path) -> std::string_view {
                                      return path == "host.frag" ? std::string_view(fragment)
                                                                 : sky::shaders::source("render/triangle.vert");
                                  })
            .graphics("host", "host.vert", "host.frag");
    }

    gl::Texture2D picture_;
    gl::Framebuffer target_;
    gl::VertexArray triangle_;
    gl::Program program_;
};

/// What the air lets through between a camera and a point of its line of sight, [wavelength].
///   mu, muThere  cosines of the line's zenith angle at both
std::vector<double> transmittanceBetween(const Atmosphere& atmosphere, double altitude, double mu, double altitudeThere, double muThere)
{
    // Columns of a line that misses the ground, in the sense in which it does.
    const auto species = static_cast<std::size_t>(atmosphere.optics.species);
    const auto wavelengths = static_cast<std::size_t>(atmosphere.wavelengths());
    physics::RayTracer tracer(atmosphere.profile, atmosphere.optics);
    std::vector<double> outer(species), inner(species), result;
    const bool up = !physics::hitsGround(atmosphere.planet(), altitude, mu) && muThere > 0 && mu > 0;
    tracer.columns(up ? altitude : altitudeThere, up ? mu : -muThere, outer.data());
    tracer.columns(up ? altitudeThere : altitude, up ? muThere : -mu, inner.data());
    for (std::size_t w = 0; w < wavelengths; ++w) {
        double depth = 0;
        for (std::size_t s = 0; s < species; ++s)
            depth += (outer[s] - inner[s]) * atmosphere.optics.extinction[s * wavelengths + w];
        result.push_back(std::exp(-depth));
    }
    return result;
}

double relative(float a, float b) { return std::abs(static_cast<double>(a) / static_cast<double>(b) - 1); }

} // namespace

TEST_CASE("shader functions: a host's picture of the sky is the library's, in OpenGL and OpenGL ES", "[gl]")
{
    for (const auto& options : {desktop(), embedded()}) {
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        CAPTURE(context->api().versionText());
        Sky sky = loadedSky(*context);
        Host host(context->api(), sky, "showmyskyRadiance(3.0 * d)", 64, 32);
        for (const double zenith : {40., 93.}) {
            sky.setSettings(scene(1500, zenith));
            sky.draw(panorama(), 64, 32);
            // Half floats round the stored picture; a whole one differs by the directions' last bits.
            CHECK(quantile(differences(host.draw(sky), sky.readLuminance()), 1) < (context->api().isEs() ? 2e-3 : 1e-4));
        }
        auto mirrored = scene(1500, 60);
        mirrored.pseudoMirror = true;
        sky.setSettings(mirrored);
        sky.draw(panorama(), 64, 32);
        CHECK(quantile(differences(host.draw(sky), sky.readLuminance()), 0.99) < 2e-3);
    }
}

TEST_CASE("shader functions: cities, the solar disc and an eclipse are the picture's too", "[gl]")
{
    for (const auto& options : {desktop(), embedded()}) {
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        const bool halves = context->api().isEs();
        CAPTURE(context->api().versionText());
        Sky sky = loadedSky(*context);
        Host host(context->api(), sky, "showmyskyRadiance(d) + showmyskySolarDisc(d, length(dFdx(d)))", 256, 128);
        Host disc(context->api(), sky, "showmyskySolarDisc(d, 1e-4)", 256, 128);
        Host air(context->api(), sky, "showmyskyRadianceTo(d, 1e9)", 256, 128);
        Host none(context->api(), sky, "showmyskyRadianceTo(d, 0.0)", 256, 128);
        auto night = scene(500, 120);
        night.layers.lightPollution = true;
        night.cities = {{9e3, 0.5, 3e3, 2, {}}, {40e3, 2, 3e3, 5, {}}}; // of one radius: each takes seconds to prepare
        auto day = scene(0, 40);
        day.sun.angularRadius = 3 * degree; // some pixels wide
        auto partial = day;
        partial.eclipse = EclipseMode::on;
        partial.moon = {partial.sun.azimuth + 2 * degree, partial.sun.zenithAngle, 60e6};
        for (auto settings : {night, day, partial}) {
            CAPTURE(settings.cities.size());
            settings.layers.solarDisc = true;
            sky.setSettings(settings);
            sky.draw(panorama(), 256, 128);
            const auto picture = sky.readLuminance();
            CHECK(quantile(differences(host.draw(sky), picture), 0.999) < (halves ? 3e-3 : 1e-3));
            double most = 0, whole = 0;
            for (const auto& pixel : disc.draw(sky))
                most = std::max(most, static_cast<double>(pixel.y));
            for (const auto& pixel : picture)
                whole = std::max(whole, static_cast<double>(pixel.y));
            if (settings.cities.empty()) {
                CHECK(most > 0.5 * whole);
                settings.layers.solarDisc = false; // hosts ask for it by name
                sky.setSettings(settings);
                double again = 0;
                for (const auto& pixel : disc.draw(sky))
                    again = std::max(again, static_cast<double>(pixel.y));
                CHECK(again == most);
                continue;
            }
            CHECK(most == 0);
            // Above the horizon all light of a night with cities comes from the air.
            const auto all = air.draw(sky), nothing = none.draw(sky);
            for (std::size_t i = 66 * 256; i < picture.size(); i += 97) {
                CHECK(all[i].y == Approx(double(picture[i].y)).epsilon(halves ? 5e-3 : 1e-3));
                CHECK(nothing[i].y == 0);
            }
        }
    }
}

TEST_CASE("shader functions: no air at no distance, all of the sky at any great one", "[gl]")
{
    for (const auto& options : {desktop(), embedded()}) {
        const auto context = gl::testing::context(options);
        if (!context)
            continue;
        Sky sky = loadedSky(*context);
        Host radiance(context->api(), sky, "showmyskyRadiance(d)", 48, 24);
        Host none(context->api(), sky, "showmyskyRadianceTo(d, 0.0)", 48, 24);
        Host all(context->api(), sky, "showmyskyRadianceTo(d, 1e9)", 48, 24);
        Host clear(context->api(), sky, "showmyskyTransmittance(d, 0.0)", 48, 24);
        Host through(context->api(), sky, "showmyskyTransmittance(d, 1e9)", 48, 24);
        struct Case {
            double altitude, zenith;
        };
        for (const auto& [altitude, zenith] : {Case{0, 30}, Case{900, 95}, Case{15e3, 60}, Case{400e3, 70}}) {
            CAPTURE(context->api().versionText(), altitude, zenith);
            sky.setSettings(scene(altitude, zenith));
            const auto sees = radiance.draw(sky), nothing = none.draw(sky), everything = all.draw(sky);
            const auto one = clear.draw(sky), some = through.draw(sky);
            double worst = 0;
            std::size_t right = 0;
            for (std::size_t i = 0; i < sees.size(); ++i) {
                // The ground adds to what the air before it scatters.
                right += nothing[i].y == 0 && one[i].y == 1 && some[i].y >= 0 && some[i].y <= 1 &&
                         everything[i].y <= sees[i].y * 1.002f + 1e-12f;
                const double elevation = (static_cast<double>(i / 48) + 0.5) / 24 * 180 - 90;
                const double horizon = physics::horizonElevation({sky.planetRadius(), sky.topOfAtmosphere()}, altitude) / degree;
                if (elevation > horizon && sees[i].y > 1e-6f)
                    worst = std::max(worst, relative(everything[i].y, sees[i].y));
            }
            CHECK(right == sees.size());
            CHECK(worst < 2e-3); // half floats of ES; desktop shares are 1 exactly
        }
    }
}

TEST_CASE("shader functions: light of the air up to a point, and what it lets through, agree with double precision", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    Host radiance(context->api(), sky, "showmyskyRadianceTo(d, metres)", 1, 1);
    Host transmittance(context->api(), sky, "showmyskyTransmittance(d, metres)", 1, 1);

    const Atmosphere atmosphere(SHOWMYSKY_TEST_MODEL);
    const auto moments = sky::model::readMoments(atmosphere.model);
    const physics::SunTable sun(atmosphere.profile, atmosphere.optics, atmosphere.medium.sunAngularRadius);
    const physics::SkyEvaluator evaluator(atmosphere.medium, atmosphere.profile, atmosphere.optics, sun);
    physics::RayTracer tracer(atmosphere.profile, atmosphere.optics);
    const auto weights = atmosphere.luminanceWeights({});
    const auto wavelengths = weights.size();
    const auto& planet = atmosphere.planet();

    struct Case {
        double altitude, sunZenithDeg, viewZenithDeg, azimuthDeg, distance;
    };
    std::vector<double> errors, depthErrors;
    for (const auto& [altitude, sunZenithDeg, viewZenithDeg, azimuthDeg, distance] :
         {Case{2, 50, 89, 40, 3e3}, Case{2, 50, 89, 40, 30e3}, Case{2, 50, 85, 170, 200}, Case{2, 50, 60, 90, 5e3},
          Case{300, 75, 92, 20, 5e3}, Case{300, 88, 90.2, 100, 20e3}, Case{2, 92, 88, 10, 60e3}, Case{2, 94, 80, 5, 100e3},
          Case{2, 94, 80, 120, 40e3}, Case{3000, 60, 100, 60, 10e3}, Case{3000, 60, 94, 150, 30e3}, Case{11e3, 70, 130, 30, 15e3},
          Case{11e3, 85, 93, 80, 100e3}, Case{11e3, 91, 89, 0.5, 200e3}, Case{11e3, 40, 178, 0, 9e3}}) {
        CAPTURE(altitude, sunZenithDeg, viewZenithDeg, azimuthDeg, distance);
        auto settings = scene(altitude, sunZenithDeg);
        settings.layers.zeroOrder = viewZenithDeg < 95; // the answer must not depend on it
        sky.setSettings(settings);
        const auto direction = directionOf(settings.sun.azimuth + azimuthDeg * degree, viewZenithDeg * degree);
        const auto towardsSun = directionOf(settings.sun.azimuth, settings.sun.zenithAngle);
        const double mu = direction[2], muSun = towardsSun[2];
        const double nu = direction[0] * towardsSun[0] + direction[1] * towardsSun[1] + mu * muSun;
        // What the whole line sends, less what the line from the point sends and the air lets through.
        const double r = planet.radius + altitude, h = physics::altitudeAlong(planet, altitude, mu, distance), there = planet.radius + h;
        const double muThere = (r * mu + distance) / there, muSunThere = (r * muSun + distance * nu) / there;
        std::vector<double> whole(wavelengths), beyond(wavelengths);
        evaluator.radiance(tracer, &moments, altitude, mu, muSun, nu, {}, whole.data());
        evaluator.radiance(tracer, &moments, h, muThere, muSunThere, nu, {}, beyond.data());
        const auto transmittances = transmittanceBetween(atmosphere, altitude, mu, h, muThere);
        double expected = 0, all = 0, through = 0, light = 0;
        for (std::size_t w = 0; w < wavelengths; ++w) {
            const auto weight = static_cast<double>(weights[w][1]);
            expected += weight * (whole[w] - transmittances[w] * beyond[w]);
            all += weight * whole[w];
            through += weight * transmittances[w];
            light += weight;
        }
        const double drawn = static_cast<double>(radiance.ask(sky, direction, distance).y);
        const double seen = static_cast<double>(transmittance.ask(sky, direction, distance).y);
        CAPTURE(drawn, expected, all, seen, through / light);
        CHECK(std::abs(drawn - expected) < 0.015 * all);
        CHECK(seen == Approx(through / light).epsilon(0.02).margin(2e-3));
        errors.push_back(std::abs(drawn / expected - 1));
        depthErrors.push_back(std::abs(std::log(seen) / std::log(through / light) - 1));
    }
    std::sort(errors.begin(), errors.end());
    std::sort(depthErrors.begin(), depthErrors.end());
    CAPTURE(errors, depthErrors);
    CHECK(quantile(errors, 0.5) < 0.006);
    CHECK(quantile(errors, 1) < 0.03);
    CHECK(quantile(depthErrors, 0.5) < 0.01);
}

TEST_CASE("shader functions: in an eclipse light scattered once begins where the shadow ends", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    Host radiance(context->api(), sky, "showmyskyRadianceTo(d, metres)", 1, 1);
    const Atmosphere atmosphere(SHOWMYSKY_TEST_MODEL);
    const physics::SunTable sun(atmosphere.profile, atmosphere.optics, atmosphere.medium.sunAngularRadius);
    const physics::SkyEvaluator evaluator(atmosphere.medium, atmosphere.profile, atmosphere.optics, sun);
    physics::RayTracer tracer(atmosphere.profile, atmosphere.optics);
    const auto weights = atmosphere.luminanceWeights({});
    const auto wavelengths = weights.size(), row = wavelengths * atmosphere.optics.scatterers.size();
    struct Case {
        double apartDeg, asideDeg, viewZenithDeg, azimuthDeg, distance, sunZenithDeg = 50;
    };
    int inTheDark = 0;
    for (const auto& [apartDeg, asideDeg, viewZenithDeg, azimuthDeg, distance, sunZenithDeg] :
         {Case{0, 0, 80, 90, 20e3}, Case{0, 0, 80, 90, 150e3}, Case{0, 0, 70, 250, 60e3}, Case{0.2, 0, 75, 30, 20e3},
          Case{0.05, 0.1, 85, 60, 60e3}, Case{0.05, 0.1, 85, -60, 60e3}, Case{0.05, -0.1, 88, 120, 100e3},
          Case{0.25, 0, 89.5, 20, 60e3, 88}, Case{-0.25, 0, 89.5, 150, 30e3, 88}, Case{0.25, 0, 92, 20, 4e3, 88}}) {
        CAPTURE(apartDeg, asideDeg, viewZenithDeg, azimuthDeg, distance, sunZenithDeg);
        auto settings = scene(viewZenithDeg > 90 ? 300 : 2, sunZenithDeg);
        settings.layers.multipleScattering = settings.layers.zeroOrder = false;
        settings.eclipse = EclipseMode::on;
        settings.moon = {settings.sun.azimuth + asideDeg * degree, settings.sun.zenithAngle - apartDeg * degree, 371925e3};
        sky.setSettings(settings);
        const auto direction = directionOf(settings.sun.azimuth + azimuthDeg * degree, viewZenithDeg * degree);
        const auto shadow = physics::makeShadow(
            bodiesOf(atmosphere.model.manifest(), settings.altitude, settings.sun, settings.moon, sky.sunAngularRadius()));
        const auto towardsSun = directionOf(settings.sun.azimuth, settings.sun.zenithAngle);
        const double nu = physics::Shadow::dot(direction, towardsSun);
        const auto upTo = [&](double end) {
            auto ray = tracer.trace(settings.altitude, direction[2], 2000, viewZenithDeg > 90.6);
            std::vector<physics::MiddleOfLight> middles(ray.nodes.size());
            for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
                const double s = (atmosphere.planet().radius + settings.altitude) * ray.nodes[k].nuScale / ray.nodes[k].sunScale;
                const auto seen = sunSeen(shadow, atmosphere.planet(), settings.altitude, direction, ray.nodes[k]);
                for (std::size_t i = 0; i < row; ++i)
                    ray.weights[k * row + i] *= s > end ? 0 : seen.share;
                middles[k] = seen.middle;
            }
            std::vector<double> light(wavelengths, 0.);
            evaluator.singleAlong(ray, towardsSun[2], nu, true, light.data(), middles);
            double sum = 0;
            for (std::size_t w = 0; w < wavelengths; ++w)
                sum += static_cast<double>(weights[w][1]) * light[w];
            return sum;
        };
        const double expected = upTo(distance), all = upTo(1e9), drawn = static_cast<double>(radiance.ask(sky, direction, distance).y);
        CAPTURE(expected, all, drawn);
        CHECK(std::abs(drawn - expected) < (apartDeg == 0 ? 0.02 : 0.0045) * all); // an umbra has an edge
        inTheDark += expected < 1e-3 * all;
    }
    CHECK(inTheDark > 0);
    CHECK(inTheDark < 4);
}

namespace {

/// A place of Moon, camera and line of sight.
struct LineInEclipse {
    double apartDeg, asideDeg, altitude, viewZenithDeg, azimuthDeg, distance;
};

/// Light of higher orders up to a point is what the whole line sends, less what the line from the point sends there and the air lets through.
/// Returns the least share of the line's light up to the point, of the share without an eclipse.
double compareUpToPoint(const gl::HeadlessContext& context, const std::vector<LineInEclipse>& lines)
{
    using Vector = std::array<double, 3>;
    Sky sky = loadedSky(context);
    Host radiance(context.api(), sky, "showmyskyRadianceTo(d, metres)", 1, 1);
    const Atmosphere atmosphere(SHOWMYSKY_TEST_MODEL);
    const Photometer photometer(SHOWMYSKY_TEST_MODEL, Photometer::Method::reference);
    const auto& planet = atmosphere.planet();
    double nearest = 1;
    for (const auto& [apartDeg, asideDeg, altitude, viewZenithDeg, azimuthDeg, distance] : lines) {
        CAPTURE(apartDeg, asideDeg, altitude, viewZenithDeg, azimuthDeg, distance);
        auto settings = scene(altitude, 50);
        settings.layers.singleScattering = false;
        settings.layers.zeroOrder = viewZenithDeg < 95; // the ground is no part of the air, whether it is shown or not
        sky.setSettings(settings);
        const Vector direction = directionOf(settings.sun.azimuth + azimuthDeg * degree, viewZenithDeg * degree);
        const double before =
            static_cast<double>(radiance.ask(sky, direction, distance).y) / static_cast<double>(radiance.ask(sky, direction, 1e9).y);
        settings.eclipse = EclipseMode::on;
        settings.moon = {settings.sun.azimuth + asideDeg * degree, settings.sun.zenithAngle - apartDeg * degree, 371925e3};
        sky.setSettings(settings);
        const double drawn = static_cast<double>(radiance.ask(sky, direction, distance).y),
                     all = static_cast<double>(radiance.ask(sky, direction, 1e9).y);

        // Sun, Moon and line of sight as they stand at the point.
        const double r = planet.radius + altitude;
        const auto placeOf = [&](const Vector& towards, double fromCentre) {
            const double t = -r * towards[2] + std::sqrt(fromCentre * fromCentre - r * r * (1 - towards[2] * towards[2]));
            return Vector{t * towards[0], t * towards[1], t * towards[2]};
        };
        const Vector point{distance * direction[0], distance * direction[1], distance * direction[2]};
        const double there = std::hypot(point[0], point[1], point[2] + r);
        const Vector up{point[0] / there, point[1] / there, (point[2] + r) / there};
        const double flat = std::hypot(up[0], up[2]);
        const Vector north{up[2] / flat, 0, -up[0] / flat};
        const Vector west{up[1] * north[2] - up[2] * north[1], up[2] * north[0] - up[0] * north[2], up[0] * north[1] - up[1] * north[0]};
        const auto anglesTo = [&](const Vector& target) {
            const Vector to{target[0] - point[0], target[1] - point[1], target[2] - point[2]};
            const double x = physics::Shadow::dot(to, north), y = physics::Shadow::dot(to, west), z = physics::Shadow::dot(to, up);
            return std::pair{std::atan2(-y, x), std::atan2(std::hypot(x, y), z)};
        };
        const auto sunThere = anglesTo(placeOf(directionOf(settings.sun.azimuth, settings.sun.zenithAngle), 149597870700.));
        const auto moonThere = anglesTo(placeOf(directionOf(settings.moon.azimuth, settings.moon.zenithAngle), settings.moon.distance));
        const auto lineThere = anglesTo({2 * point[0], 2 * point[1], 2 * point[2]});
        const double h = physics::altitudeAlong(planet, altitude, direction[2], distance);
        const Photometer::View view{h, sunThere.second, sunThere.first, lineThere.second, lineThere.first};
        const Moon moon{moonThere.first, moonThere.second, settings.moon.distance};
        const auto light = sky.spectralRadiance(direction);
        std::vector<double> beyond(light.size()), upTo(light);
        photometer.eclipsedRadiance(&view, &moon, 1, Photometer::multipleScattering, beyond.data());
        const auto through = transmittanceBetween(atmosphere, altitude, direction[2], h, std::cos(lineThere.second));
        for (std::size_t w = 0; w < light.size(); ++w)
            upTo[w] -= through[w] * beyond[w];
        const double expected = photometer.colourOf(upTo.data()).Y, whole = photometer.colourOf(light.data()).Y;
        CAPTURE(drawn, expected, all, whole, before);
        CHECK(std::abs(drawn - expected) < 0.01 * whole);
        CHECK(all == Approx(whole).epsilon(0.01));
        nearest = std::min(nearest, drawn / all / before);
    }
    return nearest;
}

} // namespace

TEST_CASE("shader functions: in an eclipse light of higher orders up to a point is what the point's own sky leaves", "[gl]")
{
    if (const auto context = gl::testing::context(desktop()))
        CHECK(compareUpToPoint(*context, {{0, 0, 2, 85, 90, 40e3}, {0, 0, 3000, 97, 30, 15e3}}) < 0.5); // it comes from beyond the umbra
}

TEST_CASE("shader functions: in an eclipse light of higher orders up to a point, partial phase", "[gl]")
{
    if (const auto context = gl::testing::context(desktop()))
        CHECK(compareUpToPoint(*context, {{0.05, 0.1, 2, 80, 60, 30e3}}) > 0.1);
}

TEST_CASE("shader functions: in an eclipse from the model's table light grows with distance as on the fly", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky(SHOWMYSKY_ECLIPSE, context->loader());
    sky.loadAll();
    Host radiance(context->api(), sky, "showmyskyRadianceTo(d, metres)", 1, 1);
    auto settings = scene(0, 80, Source::textures);
    settings.eclipse = EclipseMode::on;
    settings.layers.zeroOrder = settings.layers.singleScattering = false; // so that pictures need no field of their own
    settings.moon = {settings.sun.azimuth, settings.sun.zenithAngle, sky.moonDistance()};
    const auto direction = directionOf(settings.sun.azimuth + 1, 80 * degree);
    double shares[2];
    for (const bool precomputed : {false, true}) {
        settings.precomputedEclipse = precomputed;
        sky.setSettings(settings);
        REQUIRE(sky.usesEclipseTable(settings) == precomputed);
        shares[precomputed] =
            static_cast<double>(radiance.ask(sky, direction, 30e3).y) / static_cast<double>(radiance.ask(sky, direction, 1e9).y);
    }
    CHECK(shares[1] == Approx(shares[0]).epsilon(1e-3));
    CHECK(shares[0] > 0.02);
    CHECK(shares[0] < 0.5);
}

TEST_CASE("shader functions: without moments light of higher orders up to a point is nearly the same, in an eclipse too", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky with(SHOWMYSKY_TEXTURE_MODEL, context->loader()), without(SHOWMYSKY_TEXTURE_MODEL "-alone", context->loader());
    with.loadAll();
    without.loadAll();
    Host ofWith(context->api(), with, "showmyskyRadianceTo(d, metres)", 1, 1),
        ofWithout(context->api(), without, "showmyskyRadianceTo(d, metres)", 1, 1);
    struct Case {
        double altitude, viewZenithDeg, distance;
        bool eclipse;
    };
    for (const auto& [altitude, viewZenithDeg, distance, eclipse] :
         {Case{0, 85, 30e3, false}, Case{0, 85, 30e3, true}, Case{2000, 100, 5e3, false}, Case{2000, 100, 5e3, true},
          Case{2000, 100, 1e9, true}}) {
        CAPTURE(altitude, viewZenithDeg, distance, eclipse);
        auto settings = scene(altitude, 50, Source::textures);
        settings.layers.singleScattering = settings.layers.zeroOrder = false;
        settings.eclipse = eclipse ? EclipseMode::on : EclipseMode::off;
        settings.moon = {settings.sun.azimuth, settings.sun.zenithAngle, 371925e3};
        with.setSettings(settings);
        without.setSettings(settings);
        const auto direction = directionOf(settings.sun.azimuth + 1.5, viewZenithDeg * degree);
        const auto expected = static_cast<double>(ofWith.ask(with, direction, distance).y),
                   all = static_cast<double>(ofWith.ask(with, direction, 1e9).y),
                   got = static_cast<double>(ofWithout.ask(without, direction, distance).y);
        CAPTURE(expected, all, got);
        CHECK(std::abs(got - expected) < 0.07 * all); // not all air is lit alike
    }
}

TEST_CASE("shader functions: in an eclipse sky and illuminance are those of single directions", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    Host radiance(context->api(), sky, "showmyskyRadiance(d)", 1, 1);
    Host skylight(context->api(), sky, "showmyskySkyIlluminance()", 1, 1);
    for (const double apartDeg : {0., 0.1}) {
        auto settings = scene(1500, 50);
        settings.eclipse = EclipseMode::on;
        settings.moon = {settings.sun.azimuth, settings.sun.zenithAngle - apartDeg * degree, 371925e3};
        sky.setSettings(settings);
        for (const auto& [zenithDeg, azimuthDeg] : {std::pair{10., 200.}, {50., 5.}, {88., 90.}, {93., 20.}, {140., 300.}}) {
            CAPTURE(apartDeg, zenithDeg, azimuthDeg);
            const auto direction = directionOf(azimuthDeg * degree, zenithDeg * degree);
            const double expected = luminanceOf(sky.spectralRadiance(direction), sky.wavelengths());
            CHECK(static_cast<double>(radiance.ask(sky, direction, 0).y) == Approx(expected).epsilon(0.02));
        }
        constexpr int width = 256, height = 128;
        sky.draw(panorama(), width, height);
        const auto picture = sky.readLuminance();
        double expected = 0;
        for (int row = height / 2; row < height; ++row) {
            const double elevation = 180 * degree * ((row + 0.5) / height - 0.5);
            for (int x = 0; x < width; ++x)
                expected += static_cast<double>(picture[static_cast<std::size_t>(row * width + x)].y) * std::sin(elevation) *
                            std::cos(elevation) * (180 * degree / height) * (360 * degree / width);
        }
        CHECK(static_cast<double>(skylight.draw(sky)[0].y) == Approx(expected).epsilon(0.01));
    }
}

TEST_CASE("shader functions: what a Moon leaves of a low Sun lights a surface as the disc in the picture does", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    Host horizontal(context->api(), sky, "showmyskySunIlluminance()", 1, 1);
    struct Case {
        double sunZenithDeg, apartDeg;
        bool darkened;
    };
    for (const auto& [sunZenithDeg, apartDeg, darkened] :
         {Case{60, 0.2, false}, {89, 0.3, false}, {89, -0.3, false}, {89, -0.3, true}, {89.9, 0.2, false}, {89.9, -0.2, false}}) {
        CAPTURE(sunZenithDeg, apartDeg, darkened);
        auto settings = scene(0, sunZenithDeg);
        settings.layers = {true, true, false, false, false, {}};
        settings.eclipse = EclipseMode::on;
        settings.limbDarkening = darkened;
        settings.pseudoMirror = true; // no ground, so no field to follow
        settings.moon = {settings.sun.azimuth + 0.1 * degree, settings.sun.zenithAngle - apartDeg * degree, 371925e3};
        sky.setSettings(settings);
        constexpr int size = 256;
        const double side = 2 * std::tan(0.35 * degree) / size, elevation = 90 - sunZenithDeg; // of a pixel
        sky.draw({Projection::perspective, 0.7 * degree, settings.sun.azimuth, elevation * degree, 0}, size, size);
        const auto picture = sky.readLuminance();
        double expected = 0;
        for (int y = 0; y < size; ++y) {
            const double sine = std::sin(elevation * degree + side * (y + 0.5 - size / 2));
            for (int x = 0; x < size && sine > 0; ++x)
                expected += static_cast<double>(picture[static_cast<std::size_t>(y * size + x)].y) * side * side * sine;
        }
        CHECK(static_cast<double>(horizontal.draw(sky)[0].y) == Approx(expected).epsilon(0.01)); // a limb's pixels
    }
}

TEST_CASE("shader functions: light is followed to distances once a program asks for it", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    Host far(context->api(), sky, "showmyskyRadiance(d) + showmyskySkyIlluminance()", 8, 8);
    Host near(context->api(), sky, "showmyskyRadianceTo(d, 5e3)", 8, 8);
    const auto follows = [&](double zenith) {
        sky.setSettings(scene(0, zenith));
        bool result = false;
        for (Progress progress = sky.prepareStep(); !progress.done; progress = sky.prepareStep())
            result = result || progress.activity.find("distances") != std::string::npos;
        return result;
    };
    const auto before = far.draw(sky);
    CHECK_FALSE(follows(60));
    far.draw(sky);
    CHECK(near.draw(sky)[40].y > 0);
    CHECK(follows(70));
    const auto later = near.draw(sky)[40].y;
    sky.setSettings(scene(0, 60));
    CHECK(near.draw(sky)[40].y != later);
    CHECK(far.draw(sky)[40].y != before[40].y);
}

TEST_CASE("shader functions: Sun and sky light a surface as photometry says", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    Sky sky = loadedSky(*context);
    Host sunlight(context->api(), sky, "showmyskySunIlluminance()", 1, 1);
    Host facing(context->api(), sky, "showmyskySunIlluminance(normalize(d))", 1, 1);
    Host skylight(context->api(), sky, "showmyskySkyIlluminance()", 1, 1);
    const Photometer photometer(SHOWMYSKY_TEST_MODEL, Photometer::Method::reference);
    std::vector<double> direct(sky.wavelengths().size()), diffuse(direct.size());
    struct Case {
        double altitude, sunZenithDeg;
    };
    for (const auto& [altitude, sunZenithDeg] : {Case{0, 20}, Case{0, 75}, Case{0, 89.9}, Case{0, 95}, Case{4000, 60}, Case{10e3, 91}}) {
        CAPTURE(altitude, sunZenithDeg);
        const auto settings = scene(altitude, sunZenithDeg);
        sky.setSettings(settings);
        photometer.horizontalIrradiance(altitude, settings.sun.zenithAngle, direct.data(), diffuse.data());
        const double sun = photometer.colourOf(direct.data()).Y, rest = photometer.colourOf(diffuse.data()).Y;
        CHECK(static_cast<double>(sunlight.draw(sky)[0].y) == Approx(sun).epsilon(0.01).margin(1e-3));
        CHECK(static_cast<double>(skylight.draw(sky)[0].y) == Approx(rest).epsilon(0.01));
        const auto towardsSun = directionOf(settings.sun.azimuth, settings.sun.zenithAngle);
        photometer.sunIrradiance(altitude, settings.sun.zenithAngle, direct.data());
        CHECK(static_cast<double>(facing.ask(sky, towardsSun, 0).y) ==
              Approx(photometer.colourOf(direct.data()).Y).epsilon(std::abs(sunZenithDeg - 90) < 0.3 ? 0.03 : 0.01).margin(1e-3));
        CHECK(facing.ask(sky, {-towardsSun[0], -towardsSun[1], -towardsSun[2]}, 0).y == 0);
    }
    auto eclipsed = scene(0, 40);
    eclipsed.moon.azimuth = eclipsed.sun.azimuth;
    eclipsed.moon.zenithAngle = eclipsed.sun.zenithAngle;
    eclipsed.moon.distance = 360e6;
    eclipsed.eclipse = EclipseMode::on;
    sky.setSettings(eclipsed);
    REQUIRE(sky.eclipseState(eclipsed).phase == EclipseState::Phase::total);
    CHECK(sunlight.draw(sky)[0].y == 0);
    CHECK(skylight.draw(sky)[0].y > 0);
    CHECK(skylight.draw(sky)[0].y < 100);
}

TEST_CASE("shader functions: binding touches three texture units and nothing else", "[gl]")
{
    const auto context = gl::testing::context(desktop());
    if (!context)
        return;
    const gl::Api& api = context->api();
    Sky sky = loadedSky(*context);
    Host host(api, sky, "showmyskyRadianceTo(d, 5e3)", 8, 8);
    sky.setSettings(scene(0, 50));
    sky.bindShaderFunctions(sky.program(), 1); // a program without the functions: nothing to set
    const gl::Texture2D own(api, "host's", gl::TextureFormat::rgba8, 1, 1);
    const gl::Texture3D own3d(api, "host's", gl::TextureFormat::rgba8, 1, 1, 1);
    for (GLuint unit = 0; unit < 12; ++unit) {
        own.bindUnit(unit);
        own3d.bindUnit(unit);
    }
    api->ActiveTexture(GL_TEXTURE7);
    const auto first = host.draw(sky);
    GLint active = 0, program = -1;
    api->GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    api->GetIntegerv(GL_CURRENT_PROGRAM, &program);
    CHECK(active == GL_TEXTURE7);
    CHECK(program == 0);
    for (GLenum unit = 0; unit < 12; ++unit) {
        CAPTURE(unit);
        GLint flat = 0, deep = 0;
        api->ActiveTexture(GL_TEXTURE0 + unit);
        api->GetIntegerv(GL_TEXTURE_BINDING_2D, &flat);
        api->GetIntegerv(GL_TEXTURE_BINDING_3D, &deep);
        CHECK((flat != static_cast<GLint>(own.name())) == (unit == 4 || unit == 5));
        CHECK((deep != static_cast<GLint>(own3d.name())) == (unit == 6));
    }
    CHECK(api->GetError() == GL_NO_ERROR);

    // A new scene is prepared in steps, and the functions follow it.
    sky.setSettings(scene(0, 85));
    int steps = 0;
    while (!sky.prepareStep().done)
        ++steps;
    CHECK(steps >= 2);
    CHECK(host.draw(sky)[40].y < 0.9f * first[40].y);
    CHECK_THROWS_AS(sky.bindShaderFunctions(123456, 0), Error);
    CHECK_THROWS_AS(sky.bindShaderFunctions(sky.program(), 100000), Error);
    CHECK(api->GetError() == GL_NO_ERROR);
}
