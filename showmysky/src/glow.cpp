#include "glow.hpp"

#include "base/parallel.hpp"
#include "moment_gather.hpp"
#include "physics/colour.hpp"

namespace showmysky {

namespace physics = sky::physics;

namespace {

constexpr double glowCells = physics::GlowSettings().cells;

/// The same light in all azimuths.
void setView(ViewTable& table, int view, const std::array<double, 4>& luminance)
{
    for (int a = 0; a < table.azimuths; ++a)
        for (std::size_t c = 0; c < 4; ++c)
            table.at(view, a)[c] = static_cast<float>(luminance[c]);
}

} // namespace

Glow::Glow(const sky::model::Model& model, const physics::Medium& medium)
    : model_(model), medium_(medium), moments_(sky::model::readGlow(model)), profile_(physics::glowProfile(medium)),
      optics_(physics::glowOptics(medium, moments_.degree)), light_(medium, optics_, moments_),
      weights_(physics::luminanceWeights(medium.wavelengthsNm))
{
}

std::string Glow::whyMissing(const sky::model::Model& model)
{
    if (model.hasTable(sky::model::lightPollutionMoments) && model.hasTable(sky::model::lightPollutionTable))
        return {};
    for (const auto& skipped : model.manifest().skipped)
        if (skipped.what == "light-pollution")
            return "The model '" + model.directory().string() + "' holds no light pollution: " + skipped.why + ".";
    return "The model '" + model.directory().string() + "' holds no light pollution; compute it anew.";
}

std::array<double, 4> Glow::luminanceOf(const double* radiance) const
{
    std::array<double, 4> sum{};
    for (std::size_t w = 0; w < weights_.size(); ++w)
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += weights_[w][c] * radiance[w];
    return sum;
}

void Glow::along(physics::RayTracer& tracer, const physics::AirEntry& entry, bool ground, double* result) const
{
    light_.seen(tracer.cells(entry.altitude, entry.mu, ground, physics::GlowLight::deepest), result);
    const auto& spectrum = model_.manifest().lightPollutionRadiance;
    for (std::size_t w = 0; w < spectrum.size(); ++w)
        result[w] *= spectrum[w];
}

void Glow::radiance(double altitude, double mu, double* result) const
{
    std::fill(result, result + weights_.size(), 0.);
    physics::RayTracer tracer(profile_, optics_, glowCells);
    if (const auto entry = enterAir(profile_.planet(), altitude, mu))
        along(tracer, *entry, physics::hitsGround(profile_.planet(), altitude, mu), result);
}

ViewTable Glow::fromMoments(double altitude) const
{
    ViewTable table(MomentGather::halfViews, 2);
    const auto sines = viewSines(profile_.planet(), altitude, table.halfViews);
    sky::base::parallel([&](int thread, int threads) {
        physics::RayTracer tracer(profile_, optics_, glowCells);
        std::vector<double> light(weights_.size());
        for (int v = thread; v < 2 * table.halfViews; v += threads)
            if (const auto entry = enterAir(profile_.planet(), altitude, sines[static_cast<std::size_t>(v)])) {
                along(tracer, *entry, v >= table.halfViews, light.data()); // the half says what is ground, not rounding
                setView(table, v, luminanceOf(light.data()));
            }
    });
    return table;
}

ViewTable Glow::fromTextures(double altitude)
{
    if (!table_)
        table_.emplace(model_);
    const auto slice = table_->slice(altitude);
    const int views = table_->views();
    ViewTable increasing(views / 2, 2);
    for (int v = 0; v < views; ++v) {
        const double* values = &slice[static_cast<std::size_t>(v * table_->channels())];
        setView(increasing, v, table_->isLuminance() ? std::array{values[0], values[1], values[2], values[3]} : luminanceOf(values));
    }
    return fromIncreasingElevation(increasing.texels, views, 2);
}

} // namespace showmysky
