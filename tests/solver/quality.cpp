// What a tolerance picks: by the kind of air, never cheaper for less error, and said in the manifest.
#include "solver/quality.hpp"
#include "hard_air.hpp"
#include "support.hpp"

#include <catch2/catch.hpp>

using namespace sky;
using namespace sky::solver;
using namespace sky::solver::test;
using sky::test::Aerosol, sky::test::cloud, sky::test::henyeyGreenstein, sky::test::molecules, sky::test::sampleEarth;

namespace {

/// The sample Earth with its aerosols so many times as thick.
physics::Medium hazyEarth(const double factor)
{
    physics::Medium medium = sampleEarth(Aerosol::Yes);
    for (double& sigma : medium.species[1].extinctionCrossSection)
        sigma *= factor;
    return medium;
}

/// The Earth's air with particles whose peak is beyond all harmonics, so many times as many as its aerosols.
physics::Medium sharpPeaks(const double factor)
{
    physics::Medium medium = hazyEarth(factor);
    for (std::size_t k = 0; k < medium.scatteringAngles.size(); ++k)
        for (int w = 0; w < medium.wavelengthCount(); ++w)
            medium.species[1].phaseFunction[k * medium.wavelengthCount() + w] = henyeyGreenstein(0.97, medium.scatteringAngles[k]);
    return medium;
}

physics::Medium denseAir()
{
    physics::Medium medium = molecules(6371e3, 60e3, 8e3); // of optical depth 0.25
    medium.species.front().extinctionCrossSection.front() *= 20;
    return medium;
}

std::vector<physics::Medium> oneOfEachKind()
{
    return {molecules(6371e3, 60e3, 8e3), sampleEarth(Aerosol::Yes), denseAir(), hazyEarth(100), sharpPeaks(1), cloud(10)};
}

std::size_t rank(const std::string& quality)
{
    const auto& names = qualityNames();
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), quality) - names.begin());
}

} // namespace

TEST_CASE("quality: the kind of air follows from optical depth and peaks")
{
    CHECK(airOf(molecules(6371e3, 60e3, 8e3)) == Air::Clear);
    CHECK(airOf(sampleEarth(Aerosol::No)) == Air::Clear);
    CHECK(airOf(sampleEarth(Aerosol::Yes)) == Air::Dusty);
    CHECK(airOf(denseAir()) == Air::Dense);
    CHECK(airOf(hazyEarth(100)) == Air::Hazy);
    CHECK(airOf(cloud(0.5)) == Air::Hazy);
    CHECK(airOf(cloud(10)) == Air::Cloudy);
    for (const double factor : {1., 1.4, 10.}) // truncated or not
        CHECK(airOf(sharpPeaks(factor)) == Air::Sharp);
    CHECK(airOf(sharpPeaks(0.01)) == Air::Dusty); // too few to be seen
    CHECK(airOf(sharpPeaks(1000)) == Air::Cloudy);
    auto smoke = cloud(10); // it absorbs: no light is scattered many times
    smoke.species[1].singleScatteringAlbedo = {0};
    CHECK(airOf(smoke) == Air::Clear);
    auto vacuum = smoke;
    vacuum.species.clear();
    CHECK(airOf(vacuum) == Air::Clear);
}

TEST_CASE("quality: scatterers of which no quality resolves the peak are named, where air consists of them and scatters more than sunlight")
{
    const auto withPeak = [](physics::Medium medium, double g) { // of the last species
        for (std::size_t k = 0; k < medium.scatteringAngles.size(); ++k)
            for (int w = 0; w < medium.wavelengthCount(); ++w)
                medium.species.back().phaseFunction[k * medium.wavelengthCount() + w] = henyeyGreenstein(g, medium.scatteringAngles[k]);
        return medium;
    };
    for (const auto& medium : oneOfEachKind())
        CHECK(unresolvedPeaks(medium).empty());
    const auto narrow = unresolvedPeaks(withPeak(cloud(10), 0.99));
    REQUIRE(narrow.size() == 1);
    CHECK_THAT(narrow.front(), Catch::StartsWith("Scatterer `drops` throws 86 %")); // 0.99^15
    CHECK(unresolvedPeaks(withPeak(cloud(10), 0.98)).empty());
    CHECK(unresolvedPeaks(withPeak(cloud(0.1), 0.99)).empty()); // molecules do most of the scattering

    const auto dust = [&](double opticalDepth, double groundAlbedo) { // the horizontal ray is 35 times as deep
        auto medium = withPeak(molecules(6371e3, 60e3, 8e3), 0.99);
        for (double& sigma : medium.species.front().extinctionCrossSection)
            sigma *= opticalDepth / 0.25;
        medium.groundAlbedo = {groundAlbedo};
        return medium;
    };
    CHECK(unresolvedPeaks(dust(0.1, 0)).size() == 1);
    CHECK(unresolvedPeaks(dust(0.01, 0)).empty());
    CHECK(unresolvedPeaks(dust(1e-6, 0.3)).size() == 1);
    // Of two alike neither does most of the scattering, of three even less.
    auto several = dust(0.1, 0.3);
    for (std::size_t count = 2; count <= 3; ++count) {
        several.species.push_back(several.species.front());
        CHECK(unresolvedPeaks(several).size() == count);
    }
    for (auto& species : several.species)
        species.phaseFunction = oneOfEachKind().front().species.front().phaseFunction;
    CHECK(unresolvedPeaks(several).empty());
}

TEST_CASE("quality: each point of the front takes longer than the one before it, and computes more finely")
{
    const auto air = sampleEarth(Aerosol::Yes);
    REQUIRE(qualityNames().size() >= 4);
    for (std::size_t i = 1; i < qualityNames().size(); ++i) {
        const auto &cheaper = qualityNames()[i - 1], &dearer = qualityNames()[i];
        CAPTURE(cheaper, dearer);
        CHECK(relativeWork(dearer) > relativeWork(cheaper));
        const auto a = qualityFor(cheaper, air).moments, b = qualityFor(dearer, air).moments;
        for (const auto count : {&physics::MomentSettings::altitudes, &physics::MomentSettings::suns, &physics::MomentSettings::degree,
                                 &physics::MomentSettings::directNodes, &physics::MomentSettings::nodes})
            CHECK(b.*count >= a.*count);
    }
    CHECK(relativeWork("normal") == 1);
}

TEST_CASE("tolerance: a smaller one never picks a cheaper quality, and what is picked is the cheapest that reaches it")
{
    for (const auto& medium : oneOfEachKind()) {
        CAPTURE(static_cast<int>(airOf(medium)));
        std::size_t before = 0, several = 0;
        for (double tolerance = 0.9; tolerance > 1e-7; tolerance *= 0.9) {
            const Pick pick = pickQuality(tolerance, medium);
            CAPTURE(tolerance, pick.quality);
            CHECK(rank(pick.quality) >= before);
            CHECK(pick.reached == (pick.predictedError <= tolerance));
            CHECK(pick.predictedError > 0);
            if (pick.reached) // with no other that errs as little for less
                CHECK(pickQuality(pick.predictedError, medium).quality == pick.quality);
            several += rank(pick.quality) > before;
            before = rank(pick.quality);
        }
        CHECK((several >= 1) == (airOf(medium) != Air::Sharp)); // by day there no quality gains anything (docs/accuracy)
        const Pick best = pickQuality(1e-9, medium);
        CHECK_FALSE(best.reached);
        CHECK(pickQuality(best.predictedError, medium).quality == best.quality);
    }
}

TEST_CASE("tolerance: what it picked is told, as a warning where nothing reaches it")
{
    struct Ear : Listener {
        std::vector<std::string> remarks;
        void remark(const std::string& sentence) override { remarks.push_back(sentence); }
    };
    const auto air = sampleEarth(Aerosol::Yes);
    Options options;
    options.qualityByTolerance = true;
    for (const bool reached : {true, false}) {
        options.tolerance = reached ? 0.2 : 1e-9;
        Ear ear;
        const Options result = settled(options, air, ear);
        CHECK(result.quality == (reached ? qualityNames().front() : qualityNames().back())); // such air gains from every point
        CHECK(result.predictedError);
        REQUIRE(ear.remarks.size() == (reached ? 1 : 0));
        REQUIRE(ear.warnings.size() == (reached ? 0 : 1));
        const std::string said = reached ? ear.remarks.front() : ear.warnings.front();
        CHECK_THAT(said, Catch::Contains("quality " + result.quality + ", whose error in air with few particles is predicted to be "));
        CHECK(orderTolerance(result) < *options.tolerance);
    }
    auto narrow = molecules(6371e3, 60e3, 8e3);
    for (std::size_t k = 0; k < narrow.scatteringAngles.size(); ++k)
        for (int w = 0; w < narrow.wavelengthCount(); ++w)
            narrow.species.front().phaseFunction[k * narrow.wavelengthCount() + w] = henyeyGreenstein(0.99, narrow.scatteringAngles[k]);
    narrow.groundAlbedo.assign(narrow.groundAlbedo.size(), 0.3);
    options.tolerance = 0.2;
    Ear ear;
    CHECK_FALSE(settled(options, narrow, ear).predictedError);
    REQUIRE(ear.warnings.size() == 1);
    CHECK_THAT(ear.warnings.front(), Catch::StartsWith("No error can be predicted"));
    options.qualityByTolerance = false; // a quality that was given stays
    options.quality = "draft";
    options.tolerance = 1e-3;
    Ear other;
    const Options kept = settled(options, air, other);
    CHECK(kept.quality == "draft");
    CHECK_FALSE(kept.predictedError);
    CHECK(other.remarks.empty());
    CHECK(orderTolerance(kept) == 1e-3);
}

TEST_CASE("tolerance: the manifest says what it picked and what is predicted", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    SceneText scene;
    Options options;
    options.parts = {Part::Moments};
    options.qualityByTolerance = true;
    options.tolerance = 0.5;
    const Run loose(*context, scene.parse(), options);
    const auto& manifest = loose.model.manifest();
    CHECK(manifest.settings.at("quality") == qualityNames().front());
    CHECK(manifest.settings.at("tolerance") == "0.5");
    CHECK(manifest.estimatedError.at("rms, as predicted") < 0.5);
    CHECK_FALSE(loose.listener.fell);
    options.tolerance = 1e-4;
    options.qualityByTolerance = false; // with a quality
    const Run strict(*context, scene.parse(), options);
    CHECK(strict.model.manifest().settings.at("quality") == "normal");
    CHECK(strict.model.manifest().estimatedError.count("rms, as predicted") == 0);
}

TEST_CASE("plan: it names the quality, and the error predicted where a tolerance picked it")
{
    const auto whyOf = [](const Options& options) {
        for (const auto& item : plan(SceneText().parse(), options))
            if (item.what == "moments")
                return item.why;
        return std::string();
    };
    Options options = draft();
    CHECK(whyOf(options) == "quality draft");
    options.predictedError = 0.0123;
    CHECK(whyOf(options) == "quality draft, predicted error 1.2 %");
}
