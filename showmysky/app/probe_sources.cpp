#include "probe_sources.hpp"
#include "base/angles.hpp"
#include "base/error.hpp"
#include "bodies.hpp"
#include "model/eclipse_table.hpp"
#include "model/glow_tables.hpp"
#include "model/medium_tables.hpp"
#include "model/moment_tables.hpp"
#include "model/scattering_table.hpp"
#include "physics/aureole.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace showmysky::app {

namespace {

using sky::base::pi;

std::vector<std::string> spectralColumns(const std::vector<double>& wavelengthsNm)
{
    std::vector<std::string> names;
    for (const double nm : wavelengthsNm) {
        char text[64];
        std::snprintf(text, sizeof text, "L_%.7gnm", nm);
        names.push_back(text);
    }
    return names;
}

class MomentSource : public ProbeSource
{
public:
    MomentSource(const std::string& directory, Photometer::Method method) : photometer_(directory, method) {}
    std::vector<std::string> columns() const override { return spectralColumns(photometer_.wavelengthsNm()); }
    void answer(const Photometer::View& view, const Moon* moon, unsigned layers, double* values) override
    {
        if (moon)
            photometer_.eclipsedRadiance(&view, moon, 1, layers, values);
        else
            photometer_.radiance(view, layers, values);
    }

private:
    Photometer photometer_;
};

class TextureSource : public ProbeSource
{
public:
    TextureSource(const std::string& directory, bool eclipseTable)
        : model_(sky::model::Model::open(directory)), medium_(sky::model::readMedium(model_)), profile_(medium_),
          optics_(sky::model::readOptics(model_, medium_)), aureole_(medium_, optics_), tracer_(profile_, optics_), photometer_(directory)
    {
        spectral_ = true;
        for (const auto& species : medium_.species)
            if (const std::string table = "single-scattering/" + species.name;
                species.scatters() && model_.hasTable(table)) { // one that scatters no light has none
                single_.push_back({&species, sky::model::ScatteringTable(model_, table), {}});
                spectral_ = spectral_ && single_.back().table.table().channels == sky::model::Channels::SpectralRadiance;
            }
        if (!sky::model::scattersOnceAtMost(model_.manifest())) {
            multiple_.emplace(Part{nullptr, sky::model::ScatteringTable(model_, "multiple-scattering"), {}});
            spectral_ = spectral_ && multiple_->table.table().channels == sky::model::Channels::SpectralRadiance;
        }
        if (!eclipseTable)
            return;
        if (!model_.hasTable(sky::model::eclipseTable))
            throw sky::UsageError("The model `" + directory +
                                  "` holds no table of eclipses; compute it without --no-eds-tex, or leave "
                                  "--precomputed-eclipse out.");
        eclipsed_.emplace(Part{nullptr, sky::model::ScatteringTable(model_, sky::model::eclipseTable), {}});
    }

    std::vector<std::string> columns() const override
    {
        return spectral_ ? spectralColumns(medium_.wavelengthsNm) : std::vector<std::string>{"X", "Y", "Z", "scotopic"};
    }

    void answer(const Photometer::View& view, const Moon* moon, unsigned layers, double* values) override
    {
        if (moon && !eclipsed_)
            throw sky::UsageError(
                "These textures hold no eclipses; leave the Moon's columns out, use --source moments, or ask for the table "
                "of eclipses by --precomputed-eclipse.");
        if (view.altitude > medium_.topOfAtmosphere)
            throw sky::UsageError("The textures end at the top of the atmosphere, " + std::to_string(medium_.topOfAtmosphere) +
                                  " m; use --source moments for views from above.");
        std::vector<double> spectrum(medium_.wavelengthCount(), 0.), xyz(4, 0.);
        if (moon)
            addEclipsed(view, *moon, layers, spectrum, xyz);
        else
            addScattered(view, layers, spectrum, xyz);
        if (layers & Photometer::lightPollution)
            addGlow(view, spectrum, xyz);
        if (spectral_) {
            std::copy(spectrum.begin(), spectrum.end(), values);
            return;
        }
        const auto colour = photometer_.colourOf(spectrum.data());
        values[0] = xyz[0] + colour.X;
        values[1] = xyz[1] + colour.Y;
        values[2] = xyz[2] + colour.Z;
        values[3] = xyz[3] + colour.scotopic;
    }

private:
    struct Part {
        const sky::physics::Species* species; ///< null: multiple scattering
        sky::model::ScatteringTable table;
        std::vector<float> slice; ///< of the altitude and Sun below
        double altitude = -1, sun = 0;
    };

    void addScattered(const Photometer::View& view, unsigned layers, std::vector<double>& spectrum, std::vector<double>& xyz)
    {
        if (layers & Photometer::zeroOrder)
            photometer_.radiance(view, Photometer::zeroOrder, spectrum.data());
        const double nu = std::cos(view.viewZenithAngle) * std::cos(view.sunZenithAngle) +
                          std::sin(view.viewZenithAngle) * std::sin(view.sunZenithAngle) * std::cos(view.viewAzimuth - view.sunAzimuth);
        if (layers & Photometer::singleScattering)
            for (auto& part : single_)
                add(part, view, std::acos(std::clamp(nu, -1., 1.)), spectrum, xyz);
        if ((layers & Photometer::multipleScattering) && multiple_)
            add(*multiple_, view, 0, spectrum, xyz);
    }

    /// As the renderer: higher orders from the table where it fits; the rest follows the Moon wherever it is.
    void addEclipsed(const Photometer::View& view, const Moon& moon, unsigned layers, std::vector<double>& spectrum,
                     std::vector<double>& xyz)
    {
        const auto bodies =
            bodiesOf(model_.manifest(), view.altitude, {view.sunAzimuth, view.sunZenithAngle, {}}, moon, medium_.sunAngularRadius);
        const bool lookUp = (layers & Photometer::multipleScattering) && sky::model::eclipseTableFits(model_.manifest(), bodies);
        layers &= Photometer::wholeSky & ~(lookUp ? Photometer::multipleScattering : 0u);
        photometer_.eclipsedRadiance(&view, &moon, 1, layers, spectrum.data());
        if (lookUp)
            add(*eclipsed_, view, 0, spectrum, xyz);
    }

    void addGlow(const Photometer::View& view, std::vector<double>& spectrum, std::vector<double>& xyz)
    {
        if (!glow_)
            glow_.emplace(model_);
        std::vector<double> value(static_cast<std::size_t>(glow_->channels()));
        glow_->sample(glow_->slice(view.altitude), view.altitude, pi / 2 - view.viewZenithAngle, value.data());
        auto& sum = glow_->isLuminance() ? xyz : spectrum;
        for (std::size_t i = 0; i < value.size(); ++i)
            sum[i] += value[i];
    }

    void add(Part& part, const Photometer::View& view, double scatteringAngle, std::vector<double>& spectrum, std::vector<double>& xyz)
    {
        const double sun = pi / 2 - view.sunZenithAngle;
        if (part.altitude != view.altitude || part.sun != sun) {
            part.slice = part.table.slice(view.altitude, sun);
            part.altitude = view.altitude;
            part.sun = sun;
        }
        const bool luminance = part.table.table().channels == sky::model::Channels::Luminance;
        std::vector<double> value(luminance ? 4 : spectrum.size()), phase(spectrum.size(), 1.);
        part.table.sample(part.slice, view.altitude, pi / 2 - view.viewZenithAngle, view.viewAzimuth - view.sunAzimuth, value.data());
        // Tables of smooth phase functions hold them already; a table of luminance has one for all wavelengths, that of the middle.
        if (part.species && !part.species->smooth) {
            sky::physics::phaseFunctionAt(medium_, *part.species, scatteringAngle, phase.data());
            aureole_.multiply(static_cast<int>(part.species - medium_.species.data()), scatteringAngle,
                              aureole_.depths(tracer_, view.altitude, std::cos(view.sunZenithAngle), scatteringAngle), phase.data());
        }
        auto& sum = luminance ? xyz : spectrum;
        for (std::size_t i = 0; i < value.size(); ++i)
            sum[i] += value[i] * phase[luminance ? phase.size() / 2 : i];
    }

    sky::model::Model model_;
    sky::physics::Medium medium_;
    sky::physics::Profile profile_;
    sky::physics::Optics optics_;
    sky::physics::Aureole aureole_;
    sky::physics::RayTracer tracer_;
    Photometer photometer_;
    std::vector<Part> single_;
    std::optional<Part> multiple_, eclipsed_;
    std::optional<sky::model::GlowTable> glow_;
    bool spectral_ = false;
};

} // namespace

std::unique_ptr<ProbeSource> makeMomentSource(const std::string& directory, Photometer::Method method)
{
    return std::make_unique<MomentSource>(directory, method);
}

std::unique_ptr<ProbeSource> makeTextureSource(const std::string& directory, bool eclipseTable)
{
    return std::make_unique<TextureSource>(directory, eclipseTable);
}

} // namespace showmysky::app
