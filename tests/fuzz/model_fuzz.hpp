#pragma once
// What must hold for any bytes taken as what a stranger's model makes us parse ourselves: manifest.json with all that is made of it, the header of an
// EXR file and its pixels. The fuzzer and an ordinary test share it.

#include "../model/support.hpp"
#include "base/error.hpp"
#include "model/exr_header.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "physics/harmonics.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace fuzz {

/// A manifest is refused with a ModelError, or can be written and then says the same. Anything else gets out.
inline void checkManifest(const std::string& text)
{
    using namespace sky::model;
    try {
        const std::string written = writeManifest(parseManifest(text, "fuzz"));
        if (writeManifest(parseManifest(written, "fuzz")) != written)
            throw std::logic_error("the manifest that was written says something else");
    } catch (const sky::ModelError&) {
    }
}

/// A table whose file is tests/fuzz/model_seeds/header.exr, or with halves pixels_half.exr.
inline sky::model::Table tableOfTheHeader(bool half = false)
{
    sky::model::Table table;
    table.name = table.quantity = half ? "h" : "t";
    table.file = table.name + ".exr";
    table.unit = "1";
    table.axes = {{"row", "1", {0, 1, 2, 3}}, {"column", "1", {0, 1}}};
    table.channelNames = {"X", "Y"};
    table.half = half;
    if (half) {
        table.significandBits = 11;
        table.rowExponents = {0, -20, 3, 120};
    }
    return table;
}

/// An EXR header is refused with a ModelError or taken. Anything else gets out.
///   returns  whether it was taken
inline bool checkHeader(const std::string& bytes, bool half = false)
{
    try {
        std::istringstream stream(bytes);
        sky::model::checkExrHeader(stream, bytes.size(), tableOfTheHeader(half), "fuzz");
        return true;
    } catch (const sky::ModelError&) {
        return false;
    }
}

/// Models on disk that inputs are put into.
class Models
{
public:
    Models()
    {
        using namespace sky::model;
        using namespace sky::physics;
        Medium medium; // with a peak, a part of which is truncated
        const Manifest small = test::smallManifest();
        medium.planetRadius = small.planetRadius;
        medium.topOfAtmosphere = small.topOfAtmosphere;
        medium.sunAngularRadius = small.sunAngularRadius;
        medium.wavelengthsNm = small.wavelengthsNm;
        medium.solarIrradiance = small.solarIrradiance;
        medium.groundAlbedo = small.groundAlbedo;
        medium.altitudes = {0, 3e3, medium.topOfAtmosphere};
        const std::size_t count = medium.wavelengthsNm.size();
        medium.species.push_back({"drops", {1, 0.5, 0}, std::vector(count, 1e-4), std::vector(count, 0.9), {}, true, false});
        for (int i = 0; i <= 16; ++i) {
            const double g = 0.9, angle = i * std::numbers::pi / 16;
            medium.scatteringAngles.push_back(angle);
            medium.species[0].phaseFunction.insert(medium.species[0].phaseFunction.end(), count,
                                                   (1 - g * g) /
                                                       (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * std::cos(angle), 1.5)));
        }
        Moments moments;
        moments.grid = MomentGrid({medium.planetRadius, medium.topOfAtmosphere}, medium.altitudes, -0.3, 3);
        moments.degree = 1;
        moments.wavelengths = static_cast<int>(count);
        moments.values.assign(3 * 3 * harmonicCount(1) * count, -0.5);
        moments.groundIrradiance.assign(3 * count, 0.25);
        ModelWriter writer(whole());
        writeMedium(writer, medium);
        writeMoments(writer, "moments", moments);
        Manifest manifest = small;
        describeMedium(manifest, medium);
        describeOptics(manifest, makeOptics(medium, 1, true), true);
        writer.commit(manifest);

        std::filesystem::create_directory(scratch_.path / "pixels");
    }

    std::string manifest() const { return sky::model::test::readFile(whole() / "manifest.json"); }

    /// A manifest beside the tables of a model is refused with a ModelError at some step, or leads to a medium, optics and moments of finite numbers.
    ///   returns  whether it led to all three
    bool checkModel(const std::string& text) const
    {
        using namespace sky;
        using namespace sky::model;
        try {
            Manifest manifest = parseManifest(text, "fuzz");
            for (auto& [file, info] : manifest.files) // that they don't fit is soon said
                if (std::filesystem::is_regular_file(whole() / file))
                    info.bytes = std::filesystem::file_size(whole() / file);
            test::writeFile(whole() / "manifest.json", writeManifest(manifest));
            const Model model = Model::open(whole());
            const physics::Medium medium = readMedium(model);
            const physics::Optics optics = readOptics(model, medium);
            for (const auto* values : {&optics.extinction, &optics.scattering, &optics.truncation, &optics.moments})
                requireFinite(*values, "optics");
            const physics::Moments moments = readMoments(model);
            requireFinite(moments.values, "moments");
            requireFinite(moments.groundIrradiance, "light on the ground");
            return true;
        } catch (const ModelError&) {
            return false;
        }
    }

    /// The bytes of an EXR file are refused with a ModelError, or hold as many radiances as the table says.
    ///   returns  what was said, empty if they were taken
    std::string checkPixels(const std::string& bytes, bool half) const
    {
        using namespace sky::model;
        const Table table = tableOfTheHeader(half);
        try {
            Manifest manifest = test::smallManifest();
            manifest.tables = {table};
            manifest.files = {{table.file, {bytes.size(), std::string(32, '0')}}};
            test::writeFile(scratch_.path / "pixels" / table.file, bytes);
            test::writeFile(scratch_.path / "pixels" / "manifest.json", writeManifest(manifest));
            const auto values = Model::open(scratch_.path / "pixels").readAll(table.name);
            if (values.size() != table.valueCount(table.rows()))
                throw std::logic_error("another number of pixels was read");
            if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value) && value >= 0; }))
                throw std::logic_error("pixels that are no radiance were taken");
            return "";
        } catch (const sky::ModelError& error) {
            return error.what();
        }
    }

    /// All that an input may be.
    void check(const std::string& input) const
    {
        checkManifest(input);
        checkModel(input);
        for (const bool half : {false, true})
            if (checkHeader(input, half))
                checkPixels(input, half);
    }

private:
    static void requireFinite(const std::vector<double>& values, const std::string& what)
    {
        if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
            throw std::logic_error(what + ": a number that is none was taken");
    }

    std::filesystem::path whole() const { return scratch_.path / "whole"; }

    sky::model::test::Scratch scratch_;
};

} // namespace fuzz
