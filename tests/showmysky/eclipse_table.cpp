// The model's table of an eclipse's higher orders against the same light followed on the fly.

#include "model/eclipse_table.hpp"
#include "../calcmysky/process.hpp"
#include "showmysky/photometry.hpp"
#include "showmysky/sky.h"
#include "sky_for_tests.hpp"
#include <catch2/catch.hpp>
#include <sstream>

using namespace showmysky;
using namespace showmysky::testing;

namespace {

struct Fixture {
    sky::gl::HeadlessContext context{desktop()};
    Sky sky{SHOWMYSKY_ECLIPSE, context.loader()};

    Fixture() { sky.loadAll(); }

    /// Higher orders alone; the Moon as far from the Sun's centre as `share` of the difference of their radii.
    SceneSettings settings(double sunZenithDeg, double share = 0) const
    {
        SceneSettings result = scene(0, sunZenithDeg, Source::textures);
        result.eclipse = EclipseMode::on;
        result.precomputedEclipse = true;
        result.layers = {false, false, false, true, false, {}};
        result.moon = {result.sun.azimuth, result.sun.zenithAngle, sky.moonDistance()};
        const auto state = sky.eclipseState(result);
        result.moon.zenithAngle -= share * (state.moonAngularRadius - state.sunAngularRadius);
        return result;
    }
    std::vector<Luminance> drawn(const SceneSettings& settings)
    {
        sky.setSettings(settings);
        sky.draw(panorama(), 120, 60);
        return sky.readLuminance();
    }
};

double meanOf(const std::vector<Luminance>& picture)
{
    double sum = 0;
    for (const auto& pixel : picture)
        sum += static_cast<double>(pixel.y);
    return sum / static_cast<double>(picture.size());
}

/// rms of the difference over the mean.
double rms(const std::vector<Luminance>& one, const std::vector<Luminance>& other)
{
    double sum = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
        sum += std::pow(static_cast<double>(one[i].y - other[i].y), 2);
    return std::sqrt(sum / static_cast<double>(one.size())) / meanOf(other);
}

} // namespace

TEST_CASE("eclipse table: in concentric totality and near it, the light that is followed on the fly", "[gl]")
{
    Fixture with;
    // Of the table's 8 Suns the highest stand 30 and 90 degrees high: at 60 degrees the horizon, bright beyond the umbra, is interpolated worst
    // (three times as badly by a reader that does not know what lies beyond the zenith).
    struct Case {
        double zenith, rms, mean, median;
    };
    for (const auto& [zenith, mostRms, mostMean, mostMedian] :
         {Case{30, 0.065, 0.015, 0.015}, Case{55, 0.05, 0.015, 0.015}, Case{80, 0.03, 0.015, 0.015}})
        for (const double share : {0., 0.028}) {
            CAPTURE(zenith, share);
            auto settings = with.settings(zenith, share);
            REQUIRE(with.sky.usesEclipseTable(settings));
            const auto looked = with.drawn(settings);
            settings.precomputedEclipse = false;
            REQUIRE_FALSE(with.sky.usesEclipseTable(settings));
            const auto followed = with.drawn(settings);
            CHECK(rms(looked, followed) < mostRms);
            CHECK(std::abs(meanOf(looked) / meanOf(followed) - 1) < mostMean);
            CHECK(quantile(differences(looked, followed), 0.5) < mostMedian);
            settings.eclipse = EclipseMode::off;
            CHECK(meanOf(looked) < 0.01 * meanOf(with.drawn(settings)));
        }
}

TEST_CASE("eclipse table: elsewhere the light is followed on the fly, and the picture says so", "[gl]")
{
    Fixture with;
    const auto concentric = with.settings(55);
    auto aside = with.settings(55, 0.04), farther = concentric, orders = concentric, limb = concentric, moments = concentric;
    farther.moon.distance *= 1.02;
    orders.eclipseOrders = 2;
    limb.limbDarkening = true;
    moments.source = Source::moments;
    for (auto settings : {aside, farther, orders, limb, moments}) {
        CHECK_FALSE(with.sky.usesEclipseTable(settings));
        const auto asked = with.drawn(settings);
        settings.precomputedEclipse = false;
        CHECK(differences(asked, with.drawn(settings)).back() == 0);
    }
    // The table's edge is no seam that one sees.
    CHECK(rms(with.drawn(with.settings(55, 0.0299)), with.drawn(with.settings(55, 0.0301))) < 0.05);
}

TEST_CASE("eclipse table: the ground and spectra of single directions are followed on the fly, the Moon may come and go", "[gl]")
{
    Fixture with;
    auto settings = with.settings(55);
    settings.layers = {};
    auto onTheFly = settings;
    onTheFly.precomputedEclipse = false;
    const auto followed = with.drawn(onTheFly);
    const auto pixel = [&] { return luminanceOf(with.sky.pixelSpectralRadiance(40, 45), with.sky.wavelengths()); };
    const double expected = pixel();
    CHECK(rms(with.drawn(settings), followed) < 0.05);
    auto mirror = settings; // no ground: nothing is followed until it is asked for
    mirror.pseudoMirror = true;
    with.drawn(mirror);
    CHECK(pixel() == Approx(expected).epsilon(1e-6));
    CHECK(rms(with.drawn(settings), followed) < 0.05);
    CHECK(differences(with.drawn(onTheFly), followed).back() == 0);
}

TEST_CASE("eclipse table: a model without it refuses with a sentence", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky = loadedSky(context);
    auto settings = scene(0, 50, Source::textures);
    settings.precomputedEclipse = true;
    CHECK(sky.whyUnsupported(settings).empty()); // not asked for yet
    settings.eclipse = EclipseMode::on;
    CHECK(sky.whyUnsupported(settings).find("holds no table of eclipses") != std::string::npos);
    CHECK_THROWS_AS(sky.setSettings(settings), Error);
    settings.source = Source::moments;
    CHECK(sky.whyUnsupported(settings).empty());
}

TEST_CASE("eclipse table: probe looks it up where it holds")
{
    const auto ask = [](const std::vector<std::string>& options, const char* moonZenith) {
        sky::test::Run what;
        what.arguments = {SHOWMYSKY, "probe", SHOWMYSKY_ECLIPSE, "-", "--layers", "multiple"};
        what.arguments.insert(what.arguments.end(), options.begin(), options.end());
        what.input =
            std::string("altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg,moon_zenith_deg,moon_azimuth_deg,"
                        "earth_moon_distance_m\n0,55,10,60,120,") +
            moonZenith + ",10,371925000\n";
        return sky::test::run(what);
    };
    const auto luminance = [](const sky::test::Outcome& outcome) {
        INFO(outcome.error);
        REQUIRE(outcome.exitCode == 0);
        std::istringstream text(outcome.output);
        std::string header, row;
        std::getline(text, header);
        std::getline(text, row);
        std::vector<double> values;
        std::istringstream cells(row);
        for (std::string cell; std::getline(cells, cell, ',');)
            values.push_back(std::stod(cell));
        if (header.ends_with(",X,Y,Z,scotopic"))
            return values.at(values.size() - 3);
        const Photometer photometer(SHOWMYSKY_ECLIPSE);
        return photometer.colourOf(&values.at(values.size() - photometer.wavelengthsNm().size())).Y;
    };
    const std::vector<std::string> table{"--source", "textures", "--precomputed-eclipse"};
    const double looked = luminance(ask(table, "55")), followed = luminance(ask({}, "55"));
    CHECK(looked == Approx(followed).epsilon(0.05));
    CHECK(looked != Approx(followed).epsilon(1e-6));
    CHECK(luminance(ask(table, "54.9")) == Approx(luminance(ask({}, "54.9"))).epsilon(1e-5)); // partial: on the fly
    CHECK(ask({"--source", "textures"}, "55").error.find("--precomputed-eclipse") != std::string::npos);
}

TEST_CASE("eclipse table: in plain C", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    auto loader = context.loader();
    showmysky_sky* sky = showmysky_open(
        SHOWMYSKY_ECLIPSE, [](const char* name, void* user) { return (*static_cast<decltype(loader)*>(user))(name); }, &loader, nullptr);
    REQUIRE(sky);
    REQUIRE(showmysky_load_all(sky));
    showmysky_scene scene;
    showmysky_default_scene(&scene);
    scene.source = SHOWMYSKY_TEXTURES;
    scene.eclipse = scene.precomputed_eclipse = 1;
    scene.moon_zenith_angle = scene.sun_zenith_angle;
    scene.moon_distance = 371925e3;
    CHECK(showmysky_uses_eclipse_table(sky, &scene) == 1);
    scene.moon_distance *= 1.1;
    CHECK(showmysky_uses_eclipse_table(sky, &scene) == 0);
    showmysky_close(sky);
}
