#include "solver/eclipse_table.hpp"
#include "eclipse/field.hpp"
#include "eclipse/kernels.hpp"
#include "eclipse/rays.hpp"
#include "model/eclipse_table.hpp"
#include "physics/stencil.hpp"
#include "physics/table_axes.hpp"
#include "solver/field_work.hpp"
#include "solver/quality.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace sky::solver {

namespace {

/// Most altitudes at which quotients are computed; between them cubics of logarithms, at equal shares of the axes of Sun and view.
constexpr int solvedAltitudes = 12;
/// Most Suns of the axis for which every one is solved; of more, every second one by day is, of the upper 5/8 of the axis, and between
/// them stand cubics of logarithms too. Near the horizon and below it quotients change too fast.
constexpr int solvedSuns = 16;
/// Quotients below this are noise: totality leaves 1e-4 or more.
constexpr float leastRatio = 1e-9f;
/// On the ground no air is seen below the horizon. What is seen from this altitude, m, is what quotients in between go towards.
constexpr double leastAltitude = 1;
/// Seconds for one field of three events and eight wavelengths, on two cores, before the medium is known; for one shift of eight wavelengths
/// towards one azimuth at one point of the grid.
constexpr double usualStateSeconds = 0.06, secondsPerVisit = 3.5e-9;
/// In shifts: one of light that looks alike from all sides; what a station takes beside its shifts; a direction of view at a node of its ray.
constexpr double shiftEvenly = 0.7, radiating = 5, viewing = 40;
/// Moments that are read in the time of a shift.
constexpr double harmonicsPerVisit = 6;
/// Events until quotients are known, of the events until the ordinary light is: the shadow is filled from far away.
constexpr double eventsPerEvent = 1.3;
/// Share of the stage's time that goes into quotients, for the progress bar.
constexpr double solving = 0.9;

/// What a table needs of the field (docs/eclipses.md has the errors that go with it).
eclipse::FieldSettings tableSettings(const std::string& quality)
{
    eclipse::FieldSettings s;
    if (quality == "draft") {
        s.altitudes = 7;
        s.along = 13;
        s.across = 7;
        s.degree = 3;
        s.groundDirections = 3;
        s.limbDirections = 2;
        s.skyDirections = 4;
        s.azimuths = 8;
        s.directNodes = 12;
        s.nodes = 6;
        s.viewNodes = 10;
    } else if (quality == "normal") {
        s.along = 15;
        s.viewNodes = 28;
    } else {
        const bool finest = quality == "reference";
        s.altitudes = finest ? 20 : 14;
        s.along = finest ? 33 : 21;
        s.across = finest ? 17 : 11;
        s.degree = 5;
        s.groundDirections = 6;
        s.limbDirections = 4;
        s.skyDirections = 8;
        s.directNodes = finest ? 48 : 32;
        s.nodes = finest ? 16 : 12;
        s.viewNodes = finest ? 40 : 24;
    }
    return s;
}

/// The altitudes that are solved around a layer. The nodes are even in the measure of altitudeNodes, so the place among them is even too.
physics::Stencil layerStencil(int layer, int layers, int solved)
{
    auto stencil = physics::uniformStencil(double(layer) * (solved - 1) / std::max(1, layers - 1), solved);
    for (int i = 0; i < 4; ++i)
        if (stencil.weight[i] == 0)
            stencil.index[i] = stencil.index[1];
    return stencil;
}

int solvedCount(const atmo::SizeScattering& size) { return std::min(size.altitude, solvedAltitudes); }

/// Which Suns of the axis are solved, from the dark end to the zenith; the same at all altitudes.
std::vector<bool> sunsSolved(const atmo::SizeScattering& size)
{
    const int count = size.sunZenithAngle;
    std::vector<bool> result(static_cast<std::size_t>(count), true);
    for (int j = count - 2; count > solvedSuns && j > 3 * count / 8; j -= 2)
        result[static_cast<std::size_t>(j)] = false;
    return result;
}

int solvedSunCount(const atmo::SizeScattering& size)
{
    const auto solved = sunsSolved(size);
    return static_cast<int>(std::count(solved.begin(), solved.end(), true));
}

/// ln of the quotients of all Suns, views and azimuths at one of the altitudes that are solved.
class Ratios
{
public:
    explicit Ratios(const BakeJob& job)
        : job_(job), rays_(eclipse::traceAir(job.scene.medium, job.scene.profile, job.scene.optics, tableSettings(job.options.quality)))
    {
    }

    /// \param breath called with the number of Suns done
    std::vector<float> at(double altitude, const std::function<void(int)>& breath) const
    {
        const auto& planet = job_.scene.profile.planet();
        const int views = job_.size.viewZenithAngle;
        std::vector<eclipse::ViewRay> rays;
        for (int k = 0; k < views; ++k) {
            const double from = k < views / 2 ? std::max(altitude, leastAltitude) : altitude;
            rays.push_back({from, physics::viewMuNodes(planet, from, views)[k], k < views / 2, 0});
        }
        const auto azimuths = physics::azimuthNodes(job_.size.dotViewSun);
        const auto suns = physics::sunElevationNodes(planet, altitude, job_.sunAxis, job_.size.sunZenithAngle);
        const auto traced = eclipse::traceViews(*rays_, rays);
        const std::size_t wavelengths = job_.scene.optics.wavelengths, sky = rays.size() * azimuths.size() * wavelengths;
        const auto solved = sunsSolved(job_.size);
        std::vector<float> result(suns.size() * sky);
        int done = 0;
        for (std::size_t j = 0; j < suns.size(); ++j) {
            if (!solved[j])
                continue;
            breath(done);
            eclipse::ScatteredField field(rays_, job_.scene.sun, bodies(altitude, suns[j]), orders());
            while (!field.step())
                breath(done);
            const auto light = field.view(*traced, azimuths);
            float* out = &result[j * sky];
            for (int v = 0; v < views; ++v)
                for (int a = 0; a < light.azimuths; ++a)
                    for (int w = 0; w < light.wavelengths; ++w)
                        *out++ = std::log(std::max(leastRatio, light.skyRatio(v, a, w)));
            ++done;
        }
        // Half-way between four neighbours; the one beyond the zenith is the Sun on its other side.
        for (std::size_t j = 0; j < suns.size(); ++j) {
            if (solved[j])
                continue;
            const bool beyond = j + 3 >= suns.size();
            const float *low = &result[(j - 3) * sky], *below = &result[(j - 1) * sky], *above = &result[(j + 1) * sky];
            const float* high = beyond ? below : &result[(j + 3) * sky];
            for (std::size_t i = 0; i < sky; ++i) {
                const std::size_t azimuth = i / wavelengths % azimuths.size();
                const std::size_t opposite = i + (azimuths.size() - 1 - 2 * azimuth) * wavelengths;
                result[j * sky + i] = (9 * (below[i] + above[i]) - low[i] - high[beyond ? opposite : i]) / 16;
            }
        }
        return result;
    }

private:
    physics::EclipseBodies bodies(double altitude, double sunElevation) const
    {
        physics::EclipseBodies b;
        b.planet = job_.scene.profile.planet();
        b.cameraAltitude = altitude;
        b.sunDirection = b.moonDirection = {std::cos(sunElevation), 0, std::sin(sunElevation)};
        b.sunDistance = job_.description.sunDistance;
        b.moonDistance = job_.description.moonDistance;
        b.moonRadius = job_.description.moonRadius;
        b.sunAngularRadius = job_.scene.medium.sunAngularRadius;
        return b;
    }
    eclipse::Orders orders() const
    {
        eclipse::Orders result;
        result.orders = job_.description.scatteringOrders;
        result.all = job_.description.allScatteringOrders;
        return result;
    }

    const BakeJob& job_;
    std::shared_ptr<const eclipse::AirRays> rays_;
};

} // namespace

std::optional<std::string> noEclipse(const atmo::Description& d)
{
    physics::EclipseBodies bodies;
    bodies.planet = {d.planetRadius, d.atmosphereHeight};
    bodies.cameraAltitude = d.atmosphereHeight;
    bodies.sunDistance = d.sunDistance;
    bodies.moonDistance = d.moonDistance;
    bodies.moonRadius = d.moonRadius;
    bodies.sunAngularRadius = d.sunAngularRadius();
    try {
        physics::makeShadow(bodies);
    } catch (const RangeError& error) {
        return error.what();
    }
    return {};
}

atmo::SizeScattering eclipseTableSize(const atmo::Description& d)
{
    const auto& asked = d.eclipsedDoubleScatteringSize;
    return {std::max(4, (asked.viewZenithAngle + 1) / 2 * 2), std::max(2, asked.relativeAzimuth), std::max(2, asked.sunZenithAngle),
            d.scatteringSize.altitude};
}

int eclipseStates(const atmo::Description& d, const Options& options)
{
    const auto size = eclipseTableSize(d);
    const int solved = solvedCount(size), suns = solvedSunCount(size);
    std::set<int> altitudes; // those that the layers asked for look at
    const auto [first, last] = options.altitudeLayers.value_or(std::pair{0, size.altitude - 1});
    for (int layer = first; layer <= last; ++layer) {
        const auto stencil = layerStencil(layer, size.altitude, solved);
        altitudes.insert(stencil.index.begin(), stencil.index.end());
    }
    return static_cast<int>(altitudes.size()) * suns;
}

double eclipseSeconds(const atmo::Description& d, const Options& options, const physics::Medium* const medium)
{
    const int states = eclipseStates(d, options);
    if (!medium)
        return states * usualStateSeconds * std::ceil(d.wavelengths.count / 8.) * relativeWork(options.quality);
    const auto settings = tableSettings(options.quality);
    const physics::Profile profile(*medium);
    const auto field = qualityFor(options.quality, *medium, orderTolerance(options)).moments;
    const auto optics = physics::makeOptics(*medium, field.degree, field.truncatePeaks);
    const eclipse::AirRays air(*medium, profile, optics, settings);
    // Moments that are read and planes that are shifted, all points of a level at once.
    const auto turns = eclipse::turnsOf(settings, air.degree);
    const double events = d.allScatteringOrders ? eventsPerEvent * eventsOf(*medium) : d.scatteringOrders - 1.;
    double visits = 0;
    for (const auto& level : air.rays)
        for (const auto& ray : level) {
            const auto& [places, entries] = ray.scattered;
            visits += shiftEvenly * turns.front().count * air.scatterers * static_cast<double>(ray.direct.stations.size());
            for (double event = 1; event < events; ++event) {
                const auto& turn = turns[std::min(static_cast<std::size_t>(event), turns.size() - 1)];
                visits += static_cast<double>(places.size()) * (turn.count + radiating) +
                          static_cast<double>(entries.size()) * eclipse::allHarmonics(turn.degree) / harmonicsPerVisit;
            }
        }
    const auto size = eclipseTableSize(d);
    visits = visits * settings.along * settings.across + viewing * size.viewZenithAngle * size.dotViewSun * settings.viewNodes;
    return states * secondsPerVisit * air.groups * visits;
}

void bakeEclipsed(const gl::Api& api, const BakeJob& ordinary, const physics::Moments& field, model::ModelWriter& writer,
                  const std::function<void(double)>& breath)
{
    BakeJob job = ordinary;
    job.size = eclipseTableSize(job.description);
    const auto& medium = job.scene.medium;
    const int solved = solvedCount(job.size), suns = job.size.sunZenithAngle, wavelengths = job.scene.optics.wavelengths;
    const int stride = job.scene.sets() * 4, states = eclipseStates(job.description, job.options);
    const bool luminance = !job.options.radiance;
    auto table = writer.table(job.spec(
        model::eclipseTable, "scattering of orders 2 and up in a total eclipse, Sun and Moon concentric at the camera", luminance));

    const auto heights = physics::altitudeNodes(job.scene.profile.planet(), solved);
    const Ratios ratios(job);
    std::map<int, std::vector<float>> known; // by altitude solved: those in reach of the layer
    int done = 0;
    double fraction = 0;
    const auto advance = [&](double share) { breath(fraction = std::max(fraction, share)); };
    const auto ratiosAt = [&](int k) -> const std::vector<float>& {
        auto& found = known[k];
        if (found.empty()) {
            found = ratios.at(heights[k], [&](int sun) { advance(solving * std::min(1., double(done + sun) / states)); });
            done += solvedSunCount(job.size);
        }
        return found;
    };

    const auto colours = luminanceOf(medium);
    const auto altitudes = job.altitudes();
    const int channels = luminance ? 4 : wavelengths;
    std::vector<float> row, texels;
    gatherMultipleScattering(
        api, job, field, false, [&](double share) { advance(fraction + (1 - solving) * share / double(altitudes.size())); },
        [&](int layer, const std::vector<float>& light) {
            const auto stencil =
                layerStencil(layer + (job.options.altitudeLayers ? job.options.altitudeLayers->first : 0), job.size.altitude, solved);
            std::array<const float*, 4> near;
            for (int i = 0; i < 4; ++i)
                near[i] = ratiosAt(stencil.index[i]).data();
            known.erase(known.begin(), known.lower_bound(stencil.index[0]));
            const std::size_t count = light.size() / stride;
            texels.assign(count * channels, 0.f);
            for (std::size_t t = 0; t < count; ++t)
                for (int w = 0; w < wavelengths; ++w) {
                    const std::size_t at = t * wavelengths + w;
                    double logarithm = 0;
                    for (int i = 0; i < 4; ++i)
                        logarithm += stencil.weight[i] * double(near[i][at]);
                    const double value = std::min(1., std::exp(logarithm)) * double(light[t * stride + w]);
                    if (!luminance)
                        texels[t * wavelengths + w] = static_cast<float>(value * medium.solarIrradiance[w]);
                    else
                        for (int c = 0; c < 4; ++c)
                            texels[t * 4 + c] += static_cast<float>(value * colours[w][c]);
                }
            table.writeRows(layer * suns, suns, texels.data());
        });
    breath(1);
}

} // namespace sky::solver
