// The GLSL functions in a host's own shader during an eclipse, against light that is followed in double precision.

#include "bodies.hpp"
#include "eclipse_view.hpp"
#include "shader_host.hpp"
#include "showmysky/photometry.hpp"

using namespace showmysky;
using namespace showmysky::testing;

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
