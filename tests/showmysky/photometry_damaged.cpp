// Light that is no number, or far less than none, is an error with a sentence and never darkness.

#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "photometry_gather.hpp"
#include "photometry_model.hpp"
#include "physics/harmonics.hpp"
#include "showmysky/photometry.h"
#include "showmysky/photometry.hpp"
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <limits>

namespace {

using Catch::Contains;
using showmysky::Error;
using showmysky::ErrorKind;
using showmysky::Photometer;
using showmysky::PhotometryModel;
using sky::physics::Moments;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// Changes one harmonic of the field, in the first wavelength, at all its places.
void spoil(Moments& moments, const int harmonic, const double value)
{
    for (int a = 0; a < moments.grid.altitudeCount(); ++a)
        for (int j = 0; j < moments.grid.sunCount(); ++j)
            moments.at(a, j)[harmonic * moments.wavelengths] = value;
}

/// The sentence of an error that no other question would mend; empty if there is none.
std::string complaint(const std::function<void()>& question)
{
    try {
        question();
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::other);
        return error.what();
    }
    return {};
}

/// Light of all orders at the ground, finished and checked as answers are.
std::string complaintOf(const PhotometryModel& sky, const bool fast)
{
    std::vector<double> light(static_cast<std::size_t>(sky.medium.wavelengthCount()));
    constexpr double mu = 0.4, muSun = 0.5, nu = 0.3;
    if (fast) {
        showmysky::FastScratch scratch;
        showmysky::FastGather(sky.medium, sky.optics, sky.sun, &*sky.moments, {}, &sky.aureole)
            .radiance(scratch, 0, mu, muSun, nu, {true, true, true}, light.data());
    } else {
        sky::physics::RayTracer tracer(sky.profile, sky.optics);
        sky.evaluator.radiance(tracer, &*sky.moments, 0, mu, muSun, nu, {}, light.data());
    }
    return complaint([&] {
        sky.finishRadiance(light.data());
        sky.checkAnswer("The radiance", light.data());
    });
}

/// The model of the tests with a field that no air has and single precision can't hold, as files that nothing is wrong with.
std::filesystem::path damagedModel()
{
    const auto directory = std::filesystem::temp_directory_path() / "showmysky-damaged-model";
    PhotometryModel sky(SHOWMYSKY_TEST_MODEL);
    spoil(*sky.moments, 0, 80);
    spoil(*sky.moments, sky::physics::harmonicIndex(2, 0), 1e6);
    sky::model::ModelWriter writer(directory);
    sky::model::writeMedium(writer, sky.medium);
    sky::model::writeMoments(writer, "moments", *sky.moments);
    auto manifest = sky.model.manifest();
    manifest.tables.clear();
    manifest.files.clear();
    writer.commit(manifest);
    return directory;
}

} // namespace

TEST_CASE("photometry: a field that is no number, or far less than none, is reported and not taken for darkness")
{
    const bool fast = GENERATE(true, false);
    INFO("fast " << fast);
    PhotometryModel sky(SHOWMYSKY_TEST_MODEL);
    CHECK(complaintOf(sky, fast) == "");
    const Moments sound = *sky.moments;
    for (int harmonic = 0; harmonic < sky::physics::harmonicCount(sound.degree); ++harmonic) {
        INFO("harmonic " << harmonic);
        spoil(*sky.moments, harmonic, notANumber);
        CHECK_THAT(complaintOf(sky, fast), Contains("The radiance at 360 nm came out as nan") && Contains("compute it anew"));
        *sky.moments = sound;
    }
    spoil(*sky.moments, sky::physics::harmonicIndex(2, 0), 1000); // light from above and below, none from the sides
    CHECK_THAT(complaintOf(sky, fast), Contains("The radiance at 360 nm came out as -"));
}

TEST_CASE("photometry: every question to a model whose numbers are beyond all bounds ends with a sentence")
{
    const auto directory = damagedModel();
    const Photometer sky(directory.string());
    std::vector<double> light(sky.wavelengthsNm().size());
    const Photometer::View view{0, 1, 0, 1.2, 0.5};
    CHECK_THAT(complaint([&] { sky.radiance(view, Photometer::wholeSky, light.data()); }), Contains("The radiance at 360 nm came out as "));
    CHECK_THAT(complaint([&] { sky.luminance(view); }), Contains("The radiance at 360 nm came out as "));
    CHECK_THAT(complaint([&] { sky.horizontalIrradiance(0, 1, nullptr, light.data()); }), Contains("The irradiance by the sky at 360 nm"));
    CHECK(complaint([&] { sky.radiance(view, Photometer::singleScattering, light.data()); }) == ""); // which has no part in it
    showmysky_photometer* handle = nullptr;
    REQUIRE(showmysky_photometer_open(directory.c_str(), 0, &handle) == SHOWMYSKY_PHOTOMETRY_OK);
    const showmysky_view same{0, 1, 0, 1.2, 0.5};
    CHECK(showmysky_photometer_radiance(handle, &same, 1, SHOWMYSKY_WHOLE_SKY, light.data()) == SHOWMYSKY_PHOTOMETRY_FAILED);
    CHECK_THAT(showmysky_photometry_error(), Contains("360 nm"));
    showmysky_photometer_close(handle);
    std::filesystem::remove_all(directory);
}
