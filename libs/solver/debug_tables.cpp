#include "solver/debug_tables.hpp"
#include "physics/harmonics.hpp"
#include <cmath>

namespace sky::solver {

namespace {

/// j_lm = sum over species of beta_sca lambda_l I_lm at the levels of the grid: the emission coefficient in harmonics (docs/method).
void writeScatteringDensity(const BakeJob& job, const physics::Moments& field, const std::string& name, const std::string& makes,
                            model::ModelWriter& writer)
{
    const auto& optics = job.scene.optics;
    const int harmonics = physics::harmonicCount(field.degree), wavelengths = field.wavelengths;
    model::TableSpec spec;
    spec.name = name;
    spec.quantity = "moments of the emission coefficient that makes " + makes;
    spec.unit = "W m^-3 nm^-1";
    spec.isSigned = true;
    model::Axis suns{"sunElevation", "rad", {}, {"sinh", {{"scale", field.grid.sunScale()}}}};
    for (int j = 0; j < field.grid.sunCount(); ++j)
        suns.nodes.push_back(field.grid.sunElevation(j));
    model::Axis lm{"harmonic l (l + 1) / 2 + m", "1", {}, {"index", {}}};
    for (int i = 0; i < harmonics; ++i)
        lm.nodes.push_back(i);
    spec.axes = {{"altitude", "m", field.grid.altitudes(), {}}, suns, lm};
    for (int w = 0; w < wavelengths; ++w)
        spec.channelNames.push_back("wavelength" + std::to_string(w));
    std::vector<float> values;
    std::vector<double> densities(optics.species);
    for (int a = 0; a < field.grid.altitudeCount(); ++a) {
        const double h = field.grid.altitudes()[a];
        job.scene.profile.densities(job.scene.profile.intervalAt(h), h, densities.data());
        for (int j = 0; j < field.grid.sunCount(); ++j) {
            const double* moments = field.at(a, j);
            for (int l = 0; l <= field.degree; ++l)
                for (int m = 0; m <= l; ++m)
                    for (int w = 0; w < wavelengths; ++w) {
                        double beta = 0;
                        for (const int s : optics.scatterers)
                            beta += densities[s] * optics.scattering[s * wavelengths + w] * optics.moment(s, l, w);
                        const double ratio = l == 0 ? 1 : moments[physics::harmonicIndex(l, m) * wavelengths + w];
                        values.push_back(static_cast<float>(beta * std::exp(moments[w]) * ratio * job.scene.medium.solarIrradiance[w]));
                    }
        }
    }
    writer.table(spec, values);
}

/// The sum of two fields, each given by logarithm and ratios.
physics::Moments sum(const physics::Moments& a, const physics::Moments& b)
{
    physics::Moments total = a;
    const int harmonics = physics::harmonicCount(a.degree), wavelengths = a.wavelengths;
    for (int h = 0; h < a.grid.altitudeCount(); ++h)
        for (int j = 0; j < a.grid.sunCount(); ++j)
            for (int w = 0; w < wavelengths; ++w) {
                const double wholeA = std::exp(a.at(h, j)[w]), wholeB = std::exp(b.at(h, j)[w]), whole = wholeA + wholeB;
                total.at(h, j)[w] = std::log(whole);
                for (int lm = 1; lm < harmonics; ++lm)
                    total.at(h, j)[lm * wavelengths + w] =
                        (a.at(h, j)[lm * wavelengths + w] * wholeA + b.at(h, j)[lm * wavelengths + w] * wholeB) / whole;
            }
    for (std::size_t i = 0; i < total.groundIrradiance.size(); ++i)
        total.groundIrradiance[i] += b.groundIrradiance[i];
    return total;
}

} // namespace

void writeDebugTables(const gl::Api& api, const BakeJob& job, const RadiationField& field, model::ModelWriter& writer,
                      const std::function<void(double)>& breath)
{
    const auto& options = job.options;
    const std::size_t events = field.perEvent.size();
    if (options.saveScatteringDensity2FromGround)
        writeScatteringDensity(job, field.firstFromGround, "scattering-density/order-2-from-ground", "order 2, from the ground", writer);
    physics::Moments accumulated;
    for (std::size_t e = 0; e < events; ++e) {
        const std::string order = "order-" + std::to_string(e + 2), named = job.orderName(e + 2, e + 1 == events);
        breath(double(e) / double(events));
        if (options.saveScatteringDensity)
            writeScatteringDensity(job, field.perEvent[e], "scattering-density/" + order, named, writer);
        if (options.saveDeltaScattering)
            bakeMultipleScattering(api, job, field.perEvent[e], "delta-scattering/" + order, "scattering of " + named, writer,
                                   [&](double) { breath(double(e) / double(events)); });
        if (options.saveAccumulatedScattering) {
            accumulated = e == 0 ? field.perEvent[0] : sum(accumulated, field.perEvent[e]);
            bakeMultipleScattering(api, job, accumulated, "accumulated-scattering/" + order, "multiple scattering up to " + named, writer,
                                   [&](double) { breath(double(e) / double(events)); });
        }
    }
}

} // namespace sky::solver
