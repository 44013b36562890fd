// The GLSL functions in a host's own shader, against the picture, against their limits, and against integrals in double precision.

#include "model/moment_tables.hpp"
#include "shader_host.hpp"
#include "showmysky/photometry.hpp"

using namespace showmysky;
using namespace showmysky::testing;

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
