// The renderer in eclipses.

#include "base/angles.hpp"
#include "shadow_light.hpp"
#include "showmysky/photometry.h"
#include "showmysky/photometry.hpp"
#include "sky_axes.hpp"
#include "sky_for_tests.hpp"
#include <catch2/catch.hpp>
#include <numeric>

using namespace showmysky;
using namespace showmysky::testing;

namespace {

using sky::base::pi;

/// The eclipse of the sample descriptions, the Moon `apart` degrees above the Sun.
SceneSettings eclipse(double sunZenithDeg, double apartDeg, double moonDistance = 371925e3)
{
    SceneSettings settings = scene(0, sunZenithDeg);
    settings.eclipse = EclipseMode::on;
    settings.moon = {settings.sun.azimuth, settings.sun.zenithAngle - apartDeg * degree, moonDistance};
    return settings;
}

std::vector<Luminance> drawn(Sky& sky, const SceneSettings& settings, const Camera& camera = panorama(), int width = 120)
{
    sky.setSettings(settings);
    sky.draw(camera, width, width / 2);
    return sky.readLuminance();
}

/// Luminance of a direction, computed for it alone.
double alone(Sky& sky, double azimuth, double zenithAngle)
{
    return luminanceOf(sky.spectralRadiance(directionOf(azimuth, zenithAngle)), sky.wavelengths());
}

} // namespace

TEST_CASE("eclipse: a Moon that hides nothing leaves the ordinary sky", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    for (const double zenith : {40., 91.}) {
        CAPTURE(zenith);
        auto settings = eclipse(zenith, 30);
        const auto with = drawn(sky, settings);
        settings.eclipse = EclipseMode::off;
        const auto without = drawn(sky, settings);
        const auto apart = differences(with, without);
        CHECK(quantile(apart, 0.5) < 1e-3);
        CHECK(apart.back() < 5e-3);
    }
}

TEST_CASE("eclipse: no jump at first and at last contact", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    auto settings = eclipse(50, 0);
    const double contact = sky.eclipseState(settings).sunAngularRadius + sky.eclipseState(settings).moonAngularRadius;
    for (const double side : {-1., 1.}) {
        settings.moon.zenithAngle = settings.sun.zenithAngle + side * contact;
        const auto at = drawn(sky, settings);
        settings.moon.zenithAngle += side * 1e-5;
        const auto outside = drawn(sky, settings);
        settings.moon.zenithAngle -= side * 2e-5;
        const auto inside = drawn(sky, settings);
        settings.eclipse = EclipseMode::off;
        // What is seen of the sky lies within some hundred kilometres, the penumbra has thousands.
        CHECK(differences(at, drawn(sky, settings)).back() < 2e-2);
        settings.eclipse = EclipseMode::on;
        CHECK(differences(inside, outside).back() < 2e-3);
    }
}

TEST_CASE("eclipse: a pixel has the luminance of its spectrum, computed for it alone", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    struct Case {
        const char* what;
        SceneSettings settings;
    };
    auto aside = eclipse(50, 0.2);
    aside.moon.azimuth += 0.2 * degree;
    auto darkened = eclipse(60, 0.25);
    darkened.limbDarkening = true;
    auto high = eclipse(35, 0);
    high.altitude = 300e3;
    for (const auto& [what, settings] : {Case{"total", eclipse(50, 0)},
                                         {"partial, beside", aside},
                                         {"annular", eclipse(40, 0, 400000e3)},
                                         {"low", eclipse(85, 0.05)},
                                         {"darker limb", darkened},
                                         {"from above", high}}) {
        CAPTURE(what);
        const auto picture = drawn(sky, settings, panorama(), 60);
        std::vector<double> apart;
        double largest = 0;
        for (const auto& pixel : picture)
            largest = std::max(largest, static_cast<double>(pixel.y));
        for (int y = 1; y < 30; y += 5)
            for (int x = 2; x < 60; x += 11) {
                const double expected = luminanceOf(sky.pixelSpectralRadiance(x, y), sky.wavelengths());
                const double got = static_cast<double>(picture[static_cast<std::size_t>(y * 60 + x)].y);
                CHECK(std::isfinite(got));
                if (expected > 1e-4 * largest)
                    apart.push_back(std::abs(got / expected - 1));
            }
        std::sort(apart.begin(), apart.end());
        CHECK(quantile(apart, 0.5) < 0.01);
        CHECK(quantile(apart, 0.9) < 0.05);
    }
}

TEST_CASE("eclipse: no rings around the Sun in a totality of two seconds", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    // The shadow runs 0.6 to 1 km/s: an umbra of 0.7 km radius.
    auto settings = eclipse(45, 0);
    double near = 371925e3, far = 400000e3;
    const auto excess = [&](double distance) {
        settings.moon.distance = distance;
        const auto state = sky.eclipseState(settings);
        return (state.moonAngularRadius - state.sunAngularRadius) * (distance - 6371e3);
    };
    for (int i = 0; i < 50; ++i)
        (excess(0.5 * (near + far)) > 700 ? near : far) = 0.5 * (near + far);
    settings.moon.distance = near;
    REQUIRE(sky.eclipseState(settings).phase == EclipseState::Phase::total);
    settings.layers.multipleScattering = settings.layers.zeroOrder = false;
    settings.layers.hiddenScatterers = {"aerosols"};
    sky.setSettings(settings);

    // Molecules alone: their phase function is flat here, so that the shadow makes the profile, and it brightens
    // outwards as lines of sight leave the umbra sooner. From 0.5 to 15 degrees, towards four sides.
    const int width = 400;
    const Camera camera{Projection::perspective, 40 * degree, settings.sun.azimuth, 45 * degree, 0};
    const auto picture = drawn(sky, settings, camera, width);
    const auto at = [&](double x, double y) {
        const int i = static_cast<int>(x), k = static_cast<int>(y);
        const auto pixel = [&](int a, int b) { return static_cast<double>(picture[static_cast<std::size_t>(b * width + a)].y); };
        const double u = x - i, v = y - k;
        return (1 - v) * ((1 - u) * pixel(i, k) + u * pixel(i + 1, k)) + v * ((1 - u) * pixel(i, k + 1) + u * pixel(i + 1, k + 1));
    };
    for (const auto& [dx, dy] : {std::pair{1., 0.}, {-1., 0.}, {0.707, 0.4}, {-0.6, -0.45}}) {
        CAPTURE(dx, dy);
        double before = 0;
        for (double pixels = 6; pixels < 150; pixels += 2) {
            const double now = at(199.5 + pixels * dx, 99.5 + pixels * dy * 0.6);
            REQUIRE(now > before);
            before = now;
        }
    }
}

TEST_CASE("eclipse: the crescent gives the light that is left, totality none", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    const auto disc = [&](const SceneSettings& from) {
        auto settings = from;
        settings.layers = {true, true, false, false, false, {}};
        const Camera camera{Projection::perspective, 1 * degree, settings.sun.azimuth, 50 * degree, 0};
        double sum = 0;
        for (const auto& pixel : drawn(sky, settings, camera, 200))
            sum += static_cast<double>(pixel.y);
        return sum;
    };
    auto settings = eclipse(40, 0.1);
    const double left = disc(settings), share = 1 - sky.eclipseState(settings).obscuration;
    settings.limbDarkening = true;
    const double darkened = disc(settings);
    settings.eclipse = EclipseMode::off;
    const double whole = disc(settings);
    CHECK(left / whole == Approx(share).epsilon(0.03)); // pixels that both limbs cross
    CHECK(darkened < left);
    CHECK(disc(eclipse(40, 0)) == 0);
}

TEST_CASE("eclipse: twice symmetric, continuous while the Moon passes, the shadow seen from above", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    auto settings = eclipse(50, 0);
    settings.moon.azimuth = settings.sun.azimuth + 0.3 * degree;
    sky.setSettings(settings);
    const double right = alone(sky, settings.sun.azimuth + 1, 1.2);
    settings.moon.azimuth = settings.sun.azimuth - 0.3 * degree;
    sky.setSettings(settings);
    CHECK(alone(sky, settings.sun.azimuth - 1, 1.2) == Approx(right).epsilon(1e-3));

    // Second contact: the Moon moves by 2e-7 rad, its shadow by 80 m.
    const auto state = sky.eclipseState(eclipse(50, 0));
    settings.moon.azimuth = settings.sun.azimuth;
    settings.moon.zenithAngle = settings.sun.zenithAngle + state.moonAngularRadius - state.sunAngularRadius - 1e-7;
    sky.setSettings(settings);
    const double before = alone(sky, settings.sun.azimuth + 1, 1.2);
    REQUIRE(sky.eclipseState(settings).phase == EclipseState::Phase::total);
    settings.moon.zenithAngle += 2e-7;
    sky.setSettings(settings);
    REQUIRE(sky.eclipseState(settings).phase == EclipseState::Phase::partial);
    CHECK(alone(sky, settings.sun.azimuth + 1, 1.2) == Approx(before).epsilon(0.01));

    settings = eclipse(30, 0);
    settings.altitude = 400e3;
    sky.setSettings(settings);
    const double inShadow = alone(sky, settings.sun.azimuth + pi, pi - 30 * degree), outside = alone(sky, settings.sun.azimuth, 2.0);
    CHECK(inShadow < 0.05 * outside);
}

TEST_CASE("eclipse: light from the table is that of the discs")
{
    sky::physics::EclipseBodies bodies;
    bodies.planet = {6371e3, 120e3};
    bodies.sunDirection = bodies.moonDirection = directionOf(0.3, 0.8);
    bodies.sunDistance = 1.514e11;
    bodies.sunAngularRadius = 695700e3 / bodies.sunDistance;
    const std::vector<double> wavelengths{400, 500, 600, 700};
    const std::vector<Texel> weights{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}; // a colour for each wavelength
    const sky::physics::LimbDarkening law(wavelengths);
    for (const double distance : {371925e3, 380200e3, 400000e3})
        for (const bool darkened : {false, true}) {
            bodies.moonDistance = distance;
            const auto shadow = sky::physics::makeShadow(bodies);
            const ShadowLight light(shadow, 3e6, darkened ? &law : nullptr, weights);
            double worst = 0;
            for (int i = -300; i <= 300; ++i)
                for (int k = 0; k < 5; ++k) {
                    const double x = 3e6 * std::pow(i / 300., 3), z = 3e4 * k;
                    const std::array<double, 3> p{x, 0.2 * x, z};
                    const Texel got = light.at({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
                    const auto discs = shadow.discs(p);
                    std::vector<double> expected(4, sky::physics::visibleFraction(discs));
                    if (darkened)
                        law.visible(discs, expected.data());
                    for (std::size_t c = 0; c < 4; ++c) {
                        worst = std::max(worst, std::abs(static_cast<double>(got[c]) - expected[c]));
                        if (discs.separation < discs.moonRadius - discs.sunRadius - 1e-8)
                            REQUIRE(got[c] == 0.f);
                    }
                }
            CAPTURE(distance, darkened);
            CHECK(worst < 2e-4);
        }
}

TEST_CASE("eclipse: rows and columns go there and back, and gather at the Sun")
{
    for (const SkyAxes& axes : {SkyAxes{-0.01, true, 0.7}, {0, true, 0.01}, {-0.3, true, 1.5}, {0, false, 0.7}}) {
        for (int i = 0; i <= 40; ++i) {
            const double x = i / 40.;
            for (const int half : {0, 1})
                CHECK(axes.viewCoordinate(axes.elevationAt(x, half), half) == Approx(x).margin(1e-9));
            CHECK(axes.azimuthCoordinate(axes.azimuthAt(x)) == Approx(x).margin(1e-9));
        }
    }
    const SkyAxes axes{0, true, 0.7};
    const double step = 1. / (eclipseHalfViews - 1), sun = axes.viewCoordinate(0.7, 0);
    CHECK(axes.elevationAt(sun + step, 0) - 0.7 < 0.5 * degree * 2);
    CHECK(axes.azimuthAt(0.5 + 1. / (eclipseAzimuths - 1)) < 0.5 * degree * 2);
}

TEST_CASE("eclipse: what hosts are told of Sun and Moon", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    using Phase = EclipseState::Phase;
    CHECK(sky.eclipseState(eclipse(50, 0)).phase == Phase::total);
    CHECK(sky.eclipseState(eclipse(50, 0)).obscuration == 1);
    CHECK(sky.eclipseState(eclipse(50, 0)).magnitude > 1.02);
    CHECK(sky.eclipseState(eclipse(50, 0, 400000e3)).phase == Phase::annular);
    CHECK(sky.eclipseState(eclipse(50, 0.3)).phase == Phase::partial);
    CHECK(sky.eclipseState(eclipse(50, 0.3)).separation == Approx(0.3 * degree));
    CHECK(sky.eclipseState(eclipse(50, 3)).phase == Phase::none);
    CHECK(sky.eclipseState(eclipse(50, 3)).obscuration == 0);
    CHECK_THROWS_AS(sky.eclipseState(eclipse(50, 0, 6400e3)), Error);
}

TEST_CASE("eclipse: around a Sun that is half hidden light comes from the middle of what is left", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    const Photometer photometer(SHOWMYSKY_TEST_MODEL);
    std::vector<double> spectrum(photometer.wavelengthsNm().size());
    constexpr int width = 64;
    for (const double zenithDeg : {50., 85.})
        for (const auto& [apartDeg, asideDeg] : {std::pair{0.25, 0.}, {-0.2, 0.1}}) {
            auto settings = eclipse(zenithDeg, apartDeg);
            settings.moon.azimuth += asideDeg * degree;
            settings.layers.multipleScattering = settings.layers.zeroOrder = settings.layers.solarDisc = false;
            const Camera camera{Projection::perspective, 10 * degree, settings.sun.azimuth, (90 - zenithDeg) * degree, 0};
            const auto picture = drawn(sky, settings, camera, width);
            double worst = 0, sum = 0;
            int count = 0;
            for (int y = 1; y < width / 2; y += 5)
                for (int x = 1; x < width; x += 5) {
                    const double right = (x + 0.5) / width * 2 - 1, up = ((y + 0.5) / (width / 2) * 2 - 1) / 2;
                    const double slope = std::tan(5 * degree), tilt = (90 - zenithDeg) * degree;
                    const double ahead = std::cos(tilt) - slope * up * std::sin(tilt), high = std::sin(tilt) + slope * up * std::cos(tilt);
                    const double zenithAngle = std::atan2(std::hypot(ahead, slope * right), high);
                    const double azimuth = settings.sun.azimuth + std::atan2(slope * right, ahead);
                    if (std::hypot(right, up) < 0.15) // the disc is 0.05 wide, and the sky's light is that of its middle there
                        continue;
                    const Photometer::View view{0, settings.sun.zenithAngle, settings.sun.azimuth, zenithAngle, azimuth};
                    photometer.eclipsedRadiance(&view, &settings.moon, 1, Photometer::singleScattering, spectrum.data());
                    const double error =
                        static_cast<double>(picture[static_cast<std::size_t>(y * width + x)].y) / photometer.colourOf(spectrum.data()).Y -
                        1;
                    worst = std::max(worst, std::abs(error));
                    sum += error * error;
                    ++count;
                }
            CAPTURE(zenithDeg, apartDeg, worst, std::sqrt(sum / count));
            CHECK(worst < 0.008); // tables; with the phase angle of the whole disc 0.07 and 0.09
        }
}

TEST_CASE("eclipse: the photometer answers as the renderer's pixel does", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    const Photometer photometer(SHOWMYSKY_TEST_MODEL);
    auto settings = eclipse(50, 0.05);
    settings.moon.azimuth += 0.03 * degree;
    sky.setSettings(settings);
    std::vector<double> answer(photometer.wavelengthsNm().size());
    for (const double zenithAngle : {0.4, 1.4}) {
        const Photometer::View view{0, settings.sun.zenithAngle, settings.sun.azimuth, zenithAngle, 2};
        photometer.eclipsedRadiance(&view, &settings.moon, 1, Photometer::wholeSky, answer.data());
        const auto expected = sky.spectralRadiance(directionOf(2, zenithAngle));
        for (std::size_t w = 0; w < answer.size(); ++w)
            CHECK(answer[w] == Approx(expected[w]).epsilon(5e-3)); // tables of sunlight of two sizes
        CHECK(photometer.obscuration(view, settings.moon) == Approx(sky.eclipseState(settings).obscuration).epsilon(1e-12));
    }
    // The same in C.
    showmysky_photometer* plain = nullptr;
    REQUIRE(showmysky_photometer_open(SHOWMYSKY_TEST_MODEL, 0, &plain) == SHOWMYSKY_PHOTOMETRY_OK);
    const showmysky_view view{0, settings.sun.zenithAngle, settings.sun.azimuth, 1.4, 2};
    showmysky_moon place{settings.moon.azimuth, settings.moon.zenithAngle, settings.moon.distance};
    std::vector<double> inC(answer.size());
    double share = 0;
    CHECK(showmysky_photometer_eclipsed_radiance(plain, &view, &place, 1, SHOWMYSKY_WHOLE_SKY, inC.data()) == SHOWMYSKY_PHOTOMETRY_OK);
    CHECK(inC == answer);
    CHECK(showmysky_photometer_obscuration(plain, &view, &place, &share) == SHOWMYSKY_PHOTOMETRY_OK);
    CHECK(share == Approx(sky.eclipseState(settings).obscuration).epsilon(1e-12));
    place.distance = 6400e3;
    CHECK(showmysky_photometer_obscuration(plain, &view, &place, &share) == SHOWMYSKY_PHOTOMETRY_BAD_ARGUMENT);
    showmysky_photometer_close(plain);
    auto moon = settings.moon;
    moon.distance = 6400e3;
    CHECK_THROWS_AS(photometer.obscuration({0, 1, 0, 1, 0}, moon), Error);
}
