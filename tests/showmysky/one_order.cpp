// A model of one scattering order is a model like any other: no moments are missing, for there is nothing that they could hold.

#include "../calcmysky/process.hpp"
#include "showmysky/photometry.hpp"
#include "sky_for_tests.hpp"
#include <catch2/catch.hpp>

using namespace showmysky;
using namespace showmysky::testing;

namespace {

std::vector<double> spectrum(const Photometer& photometer, const Photometer::View& view, unsigned layers)
{
    std::vector<double> result(photometer.wavelengthsNm().size());
    photometer.radiance(view, layers, result.data());
    return result;
}

/// The share of a sum that may be rounding.
constexpr double rounding = 1e-5;

} // namespace

TEST_CASE("one order: the photometer answers all layers; multiple scattering is zero, single that of a model of many orders")
{
    const Photometer::View up{1000, 60 * degree, 0, 50 * degree, 2}, down{1000, 60 * degree, 0, 130 * degree, 2};
    for (const auto method : {Photometer::Method::fast, Photometer::Method::reference}) {
        const Photometer one(SHOWMYSKY_ONE_ORDER, method), many(SHOWMYSKY_TEST_MODEL, method);
        for (const auto& view : {up, down}) {
            for (const double value : spectrum(one, view, Photometer::multipleScattering))
                CHECK(value == 0);
            const auto single = spectrum(one, view, Photometer::singleScattering),
                       expected = spectrum(many, view, Photometer::singleScattering);
            for (std::size_t w = 0; w < single.size(); ++w)
                CHECK(single[w] == Approx(expected[w]).epsilon(0.01)); // rays are split as the model's quality asks
        }
        // The ground: sunlight alone, less than with the light of the sky.
        const auto ground = spectrum(one, down, Photometer::zeroOrder), lit = spectrum(many, down, Photometer::zeroOrder);
        for (std::size_t w = 0; w < ground.size(); ++w) {
            CHECK(ground[w] > 0.5 * lit[w]);
            CHECK(ground[w] < lit[w]);
        }
        std::vector<double> direct(ground.size()), diffuse(ground.size());
        one.horizontalIrradiance(0, 1, direct.data(), diffuse.data());
        for (const double value : diffuse)
            CHECK(value > 0);
        const Moon moon{0, 60.1 * degree, 371925e3};
        std::vector<double> eclipsed(ground.size());
        one.eclipsedRadiance(&down, &moon, 1, Photometer::wholeSky, eclipsed.data());
        const auto whole = spectrum(one, down, Photometer::wholeSky);
        for (std::size_t w = 0; w < whole.size(); ++w) {
            CHECK(eclipsed[w] > 0);
            CHECK(eclipsed[w] < whole[w]);
        }
    }
}

TEST_CASE("one order: drawn from moments, from textures and in an eclipse", "[gl]")
{
    const sky::gl::HeadlessContext context(desktop());
    Sky sky(SHOWMYSKY_ONE_ORDER, context.loader());
    sky.loadAll();
    CHECK(sky.hasSource(Source::moments));
    CHECK(sky.hasSource(Source::textures));
    const auto drawn = [&](const SceneSettings& settings) {
        sky.setSettings(settings);
        sky.draw(panorama(), 64, 32);
        return sky.readLuminance();
    };
    auto settings = scene(0, 50);
    const auto whole = drawn(settings);
    const double spectral = luminanceOf(sky.pixelSpectralRadiance(20, 24), sky.wavelengths());
    CHECK(spectral == Approx(double(whole[24 * 64 + 20].y)).epsilon(0.01));
    settings.layers.multipleScattering = false;
    CHECK(differences(drawn(settings), whole).back() < rounding);
    settings.layers.multipleScattering = true;
    settings.source = Source::textures;
    CHECK(quantile(differences(drawn(settings), whole), 0.5) < 0.02); // four altitudes are no fine table
    settings.eclipse = EclipseMode::on;
    settings.moon = {settings.sun.azimuth, settings.sun.zenithAngle, 371925e3};
    for (const auto source : {Source::moments, Source::textures}) {
        settings.source = source;
        const auto dark = drawn(settings);
        for (std::size_t i = 0; i < dark.size(); ++i) {
            CHECK(std::isfinite(dark[i].y));
            CHECK(dark[i].y <= whole[i].y * 1.05f);
        }
        CHECK(luminanceOf(sky.pixelSpectralRadiance(20, 24), sky.wavelengths()) < 0.1 * spectral);
    }
}

TEST_CASE("one order: probe answers from each source")
{
    for (const std::string source : {"moments", "textures", "cpu"}) {
        sky::test::Run what;
        what.arguments = {SHOWMYSKY, "probe", SHOWMYSKY_ONE_ORDER, "-", "--source", source};
        what.input = "altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg\n0,40,0,60,120\n0,40,0,120,120\n";
        const auto outcome = sky::test::run(what);
        INFO(source + ": " + outcome.error);
        CHECK(outcome.exitCode == 0);
    }
}
