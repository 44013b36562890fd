#include "model/evaluate.hpp"
#include "base/error.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "model/scattering_table.hpp"
#include "physics/harmonics.hpp"
#include "physics/sky.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sky::model {

namespace {

double cosineToSun(const SkyGeometry& g)
{
    return std::clamp(std::cos(g.viewZenithAngle) * std::cos(g.sunZenithAngle) +
                          std::sin(g.viewZenithAngle) * std::sin(g.sunZenithAngle) * std::cos(g.relativeAzimuth),
                      -1., 1.);
}

/// From moments. Nodes are many, so that the error is that of the moments and not of this evaluation.
class SkyFromMoments : public SkyOfModel
{
public:
    SkyFromMoments(const physics::Medium& medium, const physics::Optics& optics, std::optional<physics::Moments> moments)
        : medium_(medium), profile_(medium_), optics_(optics), aureole_(medium_, optics_),
          sun_(profile_, optics_, medium_.sunAngularRadius, 192, 256), sky_(medium_, profile_, optics_, sun_, &aureole_),
          tracer_(profile_, optics_), moments_(std::move(moments))
    {
    }

    SkyRadiance radiance(const SkyGeometry& g) override
    {
        const std::size_t wavelengths = medium_.wavelengthsNm.size();
        SkyRadiance result{std::vector<double>(wavelengths), std::vector<double>(wavelengths)};
        const double mu = std::cos(g.viewZenithAngle), muSun = std::cos(g.sunZenithAngle), nu = cosineToSun(g);
        physics::SkyEvaluator::Parts parts;
        parts.singleNodes = 300;
        parts.multipleNodes = 40;
        parts.multiple = false;
        sky_.radiance(tracer_, nullptr, g.altitude, mu, muSun, nu, parts, result.single.data());
        std::swap(parts.single, parts.multiple);
        if (moments_)
            sky_.radiance(tracer_, &*moments_, g.altitude, mu, muSun, nu, parts, result.multiple.data());
        return result;
    }

private:
    physics::Medium medium_;
    physics::Profile profile_;
    physics::Optics optics_;
    physics::Aureole aureole_;
    physics::SunTable sun_;
    physics::SkyEvaluator sky_;
    physics::RayTracer tracer_;
    std::optional<physics::Moments> moments_;
};

/// From the 4D tables.
class SkyFromTextures : public SkyOfModel
{
public:
    explicit SkyFromTextures(const Model& model)
        : medium_(readMedium(model)), profile_(medium_), optics_(readOptics(model, medium_)), aureole_(medium_, optics_),
          tracer_(profile_, optics_)
    {
        for (std::size_t s = 0; s < medium_.species.size(); ++s)
            if (const auto& name = medium_.species[s].name; medium_.species[s].scatters() && model.hasTable("single-scattering/" + name))
                single_.push_back({static_cast<int>(s), ScatteringTable(model, "single-scattering/" + name)});
        if (!scattersOnceAtMost(model.manifest()))
            multiple_.emplace(model, "multiple-scattering");
        for (const auto& part : single_)
            refuseLuminance(part.table);
        if (multiple_)
            refuseLuminance(*multiple_);
    }

    SkyRadiance radiance(const SkyGeometry& g) override
    {
        constexpr double right = std::numbers::pi / 2;
        const std::size_t wavelengths = medium_.wavelengthsNm.size();
        const double sun = right - g.sunZenithAngle, scatteringAngle = std::acos(cosineToSun(g));
        std::vector<double> value(wavelengths), phase(wavelengths);
        SkyRadiance result{value, value};
        const auto add = [&](const ScatteringTable& table, std::vector<double>& to) {
            table.sample(table.slice(g.altitude, sun), g.altitude, right - g.viewZenithAngle, g.relativeAzimuth, value.data());
            for (std::size_t w = 0; w < wavelengths; ++w)
                to[w] += value[w] * phase[w] / medium_.solarIrradiance[w];
        };
        const auto peakDepths = aureole_.depths(tracer_, g.altitude, std::cos(g.sunZenithAngle), scatteringAngle);
        for (const auto& [s, table] : single_) {
            std::fill(phase.begin(), phase.end(), 1.);
            if (const auto& species = medium_.species[s]; !species.smooth) { // tables of smooth phase functions hold them already
                physics::phaseFunctionAt(medium_, species, scatteringAngle, phase.data());
                aureole_.multiply(s, scatteringAngle, peakDepths, phase.data());
            }
            add(table, result.single);
        }
        std::fill(phase.begin(), phase.end(), 1.);
        if (multiple_)
            add(*multiple_, result.multiple);
        return result;
    }

private:
    struct Single {
        int species;
        ScatteringTable table;
    };

    static void refuseLuminance(const ScatteringTable& table)
    {
        if (table.table().channels != Channels::SpectralRadiance)
            throw UsageError("This model's textures hold luminance, and only spectra can be compared with the reference: "
                             "compute it with --radiance, or look at its moments.");
    }

    physics::Medium medium_;
    physics::Profile profile_;
    physics::Optics optics_;
    physics::Aureole aureole_;
    physics::RayTracer tracer_;
    std::vector<Single> single_;
    std::optional<ScatteringTable> multiple_;
};

} // namespace

SkySource usualSource(const Model& model)
{
    return model.hasTable("moments") || !model.hasTable("multiple-scattering") ? SkySource::Moments : SkySource::Textures;
}

std::unique_ptr<SkyOfModel> skyOfMoments(const physics::Medium& medium, const physics::Optics& optics,
                                         std::optional<physics::Moments> moments)
{
    return std::make_unique<SkyFromMoments>(medium, optics, std::move(moments));
}

std::unique_ptr<SkyOfModel> openSky(const Model& model, const SkySource source)
{
    if (source == SkySource::Moments) {
        const physics::Medium medium = readMedium(model);
        return skyOfMoments(medium, readOptics(model, medium),
                            scattersOnceAtMost(model.manifest()) ? std::nullopt : std::optional(readMoments(model)));
    }
    return std::make_unique<SkyFromTextures>(model);
}

} // namespace sky::model
