#include "showmysky/photometry.hpp"
#include "base/angles.hpp"
#include "base/not_negative.hpp"
#include "cities.hpp"
#include "glow.hpp"
#include "photometry_eclipse.hpp"
#include "photometry_gather.hpp"
#include "photometry_model.hpp"
#include "physics/air_entry.hpp"
#include "physics/quadrature.hpp"
#include "translate.hpp"
#include <algorithm>
#include <cmath>
#include <mutex>

namespace showmysky {

namespace physics = sky::physics;

namespace {

using sky::base::notNegative;
using sky::base::pi;

void checkRange(const char* name, double value, double low, double high, const char* range)
{
    if (!(value >= low && value <= high))
        throw Error(ErrorKind::settings, std::string(name) + " is " + std::to_string(value) + "; expected " + range + ".");
}

void checkAltitude(double altitude) { checkRange("The altitude", altitude, 0, 1e15, "0 or more metres"); }

void checkZenithAngle(const char* name, double angle) { checkRange(name, angle, 0, pi * (1 + 1e-12), "0 (the zenith) to pi (the nadir)"); }

void checkView(const Photometer::View& view)
{
    checkAltitude(view.altitude);
    checkZenithAngle("The Sun's zenith angle", view.sunZenithAngle);
    checkZenithAngle("The view's zenith angle", view.viewZenithAngle);
    if (!std::isfinite(view.viewAzimuth - view.sunAzimuth))
        throw Error(ErrorKind::settings, "An azimuth is not a finite number.");
}

/// A ray that begins inside the atmosphere.
struct RayStart {
    double altitude, mu, muSun;
};

/// Where a ray from above the atmosphere enters it; false if it never does.
bool enter(const physics::Planet& p, RayStart& ray, double nu)
{
    const auto entry = enterAir(p, ray.altitude, ray.mu);
    if (!entry)
        return false;
    ray = {entry->altitude, entry->mu, std::clamp(entry->outerScale * ray.muSun + entry->outerShift * nu, -1., 1.)};
    return true;
}

} // namespace

struct Photometer::Inside {
    /// Memory of one question: kept for the next, so that answers allocate nothing.
    struct Scratch {
        FastScratch fast;
        std::vector<double> spectrum, light, columns;
    };
    /// Borrows a scratch for a scope. The questioner gets the one given back last, which may hold its ray already.
    class Borrowed
    {
    public:
        explicit Borrowed(const Inside& from) : from_(from), scratch_(from.borrow()) {}
        ~Borrowed() { from_.giveBack(std::move(scratch_)); }
        Borrowed(const Borrowed&) = delete;
        Borrowed& operator=(const Borrowed&) = delete;
        Scratch& operator*() { return *scratch_; }
        Scratch* operator->() { return scratch_.get(); }

    private:
        const Inside& from_;
        std::unique_ptr<Scratch> scratch_;
    };

    Inside(const std::string& directory, Method how)
        : sky(directory), method(how), gather(sky.medium, sky.optics, sky.sun, sky.moments ? &*sky.moments : nullptr, {}, &sky.aureole)
    {
        if (Glow::whyMissing(sky.model).empty())
            glow.emplace(sky.model, sky.medium);
    }

    int wavelengths() const { return sky.medium.wavelengthCount(); }
    void checkLayers(unsigned layers) const;
    void scattered(const RayStart& start, double nu, const FastGather::Parts& parts, Scratch& scratch, double* result) const;
    void addGround(const RayStart& start, double nu, Scratch& scratch, double* result) const;
    void radiance(const View& view, unsigned layers, Scratch& scratch, double* result) const;
    void eclipsed(const View& view, const Moon& moon, unsigned layers, Scratch& scratch, double* result) const;
    void transmittance(const physics::Optics& optics, double altitude, double mu, Scratch& scratch, double* result) const;
    void diffuse(double altitude, double muSun, Scratch& scratch, double* result) const;

    std::unique_ptr<Scratch> borrow() const
    {
        std::unique_ptr<Scratch> scratch;
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty()) {
                scratch = std::move(idle.back());
                idle.pop_back();
            }
        }
        if (!scratch)
            scratch = std::make_unique<Scratch>();
        scratch->spectrum.resize(wavelengths());
        scratch->light.resize(wavelengths());
        scratch->columns.resize(sky.medium.species.size());
        return scratch;
    }
    void giveBack(std::unique_ptr<Scratch> scratch) const noexcept
    {
        const std::lock_guard lock(mutex);
        if (idle.size() < idle.capacity()) // growing could throw
            idle.push_back(std::move(scratch));
    }

    PhotometryModel sky;
    std::optional<Glow> glow; ///< if the model has it
    EclipsePhotometry eclipse{sky};
    mutable std::once_flag citiesOnce;
    mutable std::unique_ptr<Cities> cities; ///< once they have been asked for
    Method method;
    FastGather gather;
    mutable std::mutex mutex;
    mutable std::vector<std::unique_ptr<Scratch>> idle = [] {
        std::vector<std::unique_ptr<Scratch>> room;
        room.reserve(64);
        return room;
    }();
};

void Photometer::Inside::checkLayers(const unsigned layers) const
{
    if (layers & ~(wholeSky | lightPollution))
        throw Error(ErrorKind::settings, "The layers " + std::to_string(layers) +
                                             " are unknown; expected a sum of 1 (zero order), 2 "
                                             "(single scattering), 4 (multiple scattering) and 8 (light pollution).");
    if ((layers & lightPollution) && !glow)
        throw Error(ErrorKind::unsupported, Glow::whyMissing(sky.model));
    if ((layers & (multipleScattering | zeroOrder)) && !sky.moments && !sky.onceAtMost)
        throw Error(ErrorKind::unsupported,
                    "The model '" + sky.model.directory().string() +
                        "' holds no moments, so only its single scattering is known. Compute it without --skip moments.");
}

/// Light scattered into a ray, per unit solar irradiance.
void Photometer::Inside::scattered(const RayStart& start, double nu, const FastGather::Parts& parts, Scratch& scratch, double* result) const
{
    if (method == Method::fast) {
        gather.radiance(scratch.fast, start.altitude, start.mu, start.muSun, nu, parts, result);
        return;
    }
    physics::RayTracer tracer(sky.profile, sky.optics);
    physics::SkyEvaluator::Parts how;
    how.single = parts.single;
    how.multiple = parts.multiple;
    how.exactPhase = parts.exactPhase;
    sky.evaluator.radiance(tracer, sky.moments ? &*sky.moments : nullptr, start.altitude, start.mu, start.muSun, nu, how, result);
}

/// The ground in direct view: albedo / pi times all light that falls on it, times the transmittance.
void Photometer::Inside::addGround(const RayStart& start, double nu, Scratch& scratch, double* result) const
{
    const auto& p = sky.profile.planet();
    if (!physics::hitsGround(p, start.altitude, start.mu))
        return;
    const double r = p.radius + start.altitude, s = physics::distanceToGround(p, start.altitude, start.mu);
    const double muSun = std::clamp((r * start.muSun + s * nu) / p.radius, -1., 1.);
    const int count = wavelengths();
    std::vector<double>& transmittance = scratch.spectrum;
    if (method == Method::fast) {
        gather.trace(scratch.fast, start.altitude, start.mu);
        for (int w = 0; w < count; ++w)
            transmittance[w] = double(scratch.fast.ray.transmittance[w / lanes::count].v[w % lanes::count]);
    } else {
        transmittance = physics::RayTracer(sky.profile, sky.optics).trace(start.altitude, start.mu, 2, true).groundTransmittance;
    }
    sky.sun.groundIrradiance(muSun, scratch.light.data());
    for (int w = 0; w < count; ++w)
        result[w] += sky.medium.groundAlbedo[w] / pi * transmittance[w] * scratch.light[w];
    if (!sky.moments)
        return;
    sky.moments->interpolateGround(muSun, scratch.light.data());
    for (int w = 0; w < count; ++w)
        result[w] += sky.medium.groundAlbedo[w] / pi * transmittance[w] * scratch.light[w];
}

void Photometer::Inside::eclipsed(const View& view, const Moon& moon, const unsigned layers, Scratch& scratch, double* const result) const
{
    checkView(view);
    checkZenithAngle("The Moon's zenith angle", moon.zenithAngle);
    checkRange("The Moon's azimuth", moon.azimuth, -1e6, 1e6, "a finite angle");
    eclipse.radiance(view, moon, layers, result);
    if (layers & lightPollution) {
        glow->radiance(view.altitude, std::cos(view.viewZenithAngle), scratch.light.data());
        for (int w = 0; w < wavelengths(); ++w)
            result[w] += scratch.light[w];
    }
}

void Photometer::Inside::radiance(const View& view, const unsigned layers, Scratch& scratch, double* const result) const
{
    checkView(view);
    const double azimuth = view.viewAzimuth - view.sunAzimuth;
    RayStart start{view.altitude, std::cos(view.viewZenithAngle), std::cos(view.sunZenithAngle)};
    const double nu =
        std::clamp(start.mu * start.muSun + std::sin(view.viewZenithAngle) * std::sin(view.sunZenithAngle) * std::cos(azimuth), -1., 1.);
    std::fill(result, result + wavelengths(), 0.);
    if (!enter(sky.profile.planet(), start, nu))
        return;
    const FastGather::Parts parts{(layers & singleScattering) != 0, (layers & multipleScattering) != 0, true};
    if (parts.single || parts.multiple)
        scattered(start, nu, parts, scratch, result);
    if (layers & zeroOrder)
        addGround(start, nu, scratch, result);
    sky.finishRadiance(result);
    if (layers & lightPollution) {
        glow->radiance(view.altitude, std::cos(view.viewZenithAngle), scratch.light.data());
        for (int w = 0; w < wavelengths(); ++w)
            result[w] += scratch.light[w];
    }
}

void Photometer::Inside::transmittance(const physics::Optics& optics, double altitude, double mu, Scratch& scratch, double* result) const
{
    RayStart start{altitude, mu, 0};
    const auto& p = sky.profile.planet();
    if (!enter(p, start, 0)) {
        std::fill(result, result + wavelengths(), 1.);
        return;
    }
    if (physics::hitsGround(p, start.altitude, start.mu)) {
        std::fill(result, result + wavelengths(), 0.);
        return;
    }
    physics::RayTracer(sky.profile, optics).columns(start.altitude, start.mu, scratch.columns.data());
    for (int w = 0; w < wavelengths(); ++w) {
        double depth = 0;
        for (std::size_t s = 0; s < scratch.columns.size(); ++s)
            depth += scratch.columns[s] * optics.extinction[s * wavelengths() + w];
        result[w] = std::exp(-depth);
    }
}

/// Downward irradiance by the sky per unit solar irradiance, peaks truncated: a quadrature over the hemisphere. (The moments' own
/// irradiance of the ground is of one order less, since reflection is an order too.) Single scattering with its phase function cut at the degree: the rest of the peak is
/// forward, and the flux is right with it counted as unscattered.
void Photometer::Inside::diffuse(const double altitude, const double muSun, Scratch& scratch, double* const result) const
{
    std::fill(result, result + wavelengths(), 0.);
    if (altitude >= sky.profile.planet().topOfAtmosphere)
        return;
    // mu = x^2 puts nodes at the bright horizon; mu dmu = 2 x^3 dx.
    const auto zenith = physics::gaussLegendre(12, 0, 1);
    const int azimuths = std::max(8, sky.optics.degree + 2);
    std::vector<double> light(wavelengths());
    for (std::size_t i = 0; i < zenith.nodes.size(); ++i) {
        const double x = zenith.nodes[i], mu = x * x;
        for (int j = 0; j < azimuths; ++j) {
            const double nu = mu * muSun + std::sqrt((1 - mu * mu) * (1 - muSun * muSun)) * std::cos(pi * (j + 0.5) / azimuths);
            scattered({altitude, mu, muSun}, std::clamp(nu, -1., 1.), {true, true, false}, scratch, light.data());
            for (int w = 0; w < wavelengths(); ++w)
                result[w] += zenith.weights[i] * 2 * x * mu * 2 * pi / azimuths * light[w];
        }
    }
    for (int w = 0; w < wavelengths(); ++w)
        result[w] = notNegative(result[w]);
}

Photometer::Photometer(const std::string& modelDirectory, const Method method)
    : inside_(translated([&] { return std::make_unique<Inside>(modelDirectory, method); }))
{
}
Photometer::~Photometer() = default;
Photometer::Photometer(Photometer&&) noexcept = default;
Photometer& Photometer::operator=(Photometer&&) noexcept = default;

const std::vector<double>& Photometer::wavelengthsNm() const { return inside_->sky.medium.wavelengthsNm; }
const std::vector<double>& Photometer::solarIrradiance() const { return inside_->sky.medium.solarIrradiance; }
double Photometer::planetRadius() const { return inside_->sky.medium.planetRadius; }
double Photometer::topOfAtmosphere() const { return inside_->sky.medium.topOfAtmosphere; }
double Photometer::sunAngularRadius() const { return inside_->sky.medium.sunAngularRadius; }

void Photometer::radiance(const View& view, const unsigned layers, double* const spectrum) const
{
    radianceMany(&view, 1, layers, spectrum);
}

void Photometer::radianceMany(const View* const views, const std::size_t count, const unsigned layers, double* const spectra) const
{
    translated([&] {
        inside_->checkLayers(layers);
        Inside::Borrowed scratch(*inside_);
        const int wavelengths = inside_->wavelengths();
        for (std::size_t i = 0; i < count; ++i) {
            inside_->radiance(views[i], layers, *scratch, spectra + i * wavelengths);
            inside_->sky.checkAnswer("The radiance", spectra + i * wavelengths);
        }
    });
}

void Photometer::eclipsedRadiance(const View* const views, const Moon* const moons, const std::size_t count, const unsigned layers,
                                  double* const spectra) const
{
    translated([&] {
        inside_->checkLayers(layers);
        Inside::Borrowed scratch(*inside_);
        const int wavelengths = inside_->wavelengths();
        for (std::size_t i = 0; i < count; ++i) {
            inside_->eclipsed(views[i], moons[i], layers, *scratch, spectra + i * wavelengths);
            inside_->sky.checkAnswer("The radiance", spectra + i * wavelengths);
        }
    });
}

double Photometer::obscuration(const View& view, const Moon& moon) const
{
    return translated([&] {
        checkView(view);
        checkZenithAngle("The Moon's zenith angle", moon.zenithAngle);
        return inside_->eclipse.obscuration(view, moon);
    });
}

void Photometer::cityRadiance(const View* const views, const std::size_t count, const std::vector<City>& cities,
                              double* const spectra) const
{
    translated([&] {
        const auto& sky = inside_->sky;
        std::call_once(inside_->citiesOnce,
                       [&] { inside_->cities = std::make_unique<Cities>(sky.medium, sky.model.manifest().lightPollutionRadiance); });
        const std::string wrong = inside_->cities->whyNot(cities);
        if (!wrong.empty())
            throw Error(ErrorKind::settings, wrong);
        const auto wavelengths = static_cast<std::size_t>(inside_->wavelengths());
        std::fill(spectra, spectra + count * wavelengths, 0.);
        for (std::size_t i = 0; i < count; ++i) {
            checkAltitude(views[i].altitude);
            checkZenithAngle("The view's zenith angle", views[i].viewZenithAngle);
            const double sine = std::sin(views[i].viewZenithAngle);
            inside_->cities->addRadiance(
                cities, views[i].altitude,
                {sine * std::cos(views[i].viewAzimuth), -sine * std::sin(views[i].viewAzimuth), std::cos(views[i].viewZenithAngle)},
                spectra + i * wavelengths);
            sky.checkAnswer("The radiance of cities", spectra + i * wavelengths);
        }
    });
}

Photometer::Colour Photometer::luminance(const View& view, const unsigned layers) const
{
    std::vector<double> spectrum(inside_->wavelengths());
    radiance(view, layers, spectrum.data());
    return colourOf(spectrum.data());
}

Photometer::Colour Photometer::colourOf(const double* const spectrum) const
{
    Colour colour;
    for (int w = 0; w < inside_->wavelengths(); ++w) {
        const auto& weights = inside_->sky.luminanceWeights[w];
        colour.X += weights[0] * spectrum[w];
        colour.Y += weights[1] * spectrum[w];
        colour.Z += weights[2] * spectrum[w];
        colour.scotopic += weights[3] * spectrum[w];
    }
    return colour;
}

void Photometer::transmittance(const double altitude, const double viewZenithAngle, double* const spectrum) const
{
    translated([&] {
        checkAltitude(altitude);
        checkZenithAngle("The view's zenith angle", viewZenithAngle);
        Inside::Borrowed scratch(*inside_);
        const auto& sky = inside_->sky;
        inside_->transmittance(sky.trueOptics ? *sky.trueOptics : sky.optics, altitude, std::cos(viewZenithAngle), *scratch, spectrum);
        sky.checkAnswer("The transmittance", spectrum);
    });
}

void Photometer::sunIrradiance(const double altitude, const double sunZenithAngle, double* const spectrum) const
{
    translated([&] {
        checkAltitude(altitude);
        checkZenithAngle("The Sun's zenith angle", sunZenithAngle);
        const auto& sky = inside_->sky;
        RayStart start{altitude, std::cos(sunZenithAngle), std::cos(sunZenithAngle)};
        if (enter(sky.profile.planet(), start, 1))
            sky.directSun().transmittance(start.altitude, start.muSun, spectrum);
        else
            std::fill(spectrum, spectrum + inside_->wavelengths(), 1.);
        for (int w = 0; w < inside_->wavelengths(); ++w)
            spectrum[w] *= sky.medium.solarIrradiance[w];
        sky.checkAnswer("The Sun's irradiance", spectrum);
    });
}

void Photometer::horizontalIrradiance(const double altitude, const double sunZenithAngle, double* const direct, double* const diffuse) const
{
    translated([&] {
        checkAltitude(altitude);
        checkZenithAngle("The Sun's zenith angle", sunZenithAngle);
        if (diffuse)
            inside_->checkLayers(multipleScattering);
        const auto& sky = inside_->sky;
        // Above the atmosphere nothing dims the Sun while it stands above the plane.
        const double inside = std::min(altitude, sky.medium.topOfAtmosphere);
        Inside::Borrowed scratch(*inside_);
        const int wavelengths = inside_->wavelengths();
        std::vector<double> unscattered(wavelengths);
        const auto sunlight = [&](const physics::Optics& optics, double* result) {
            physics::sunOnSurface(sky.profile, optics, sky.medium.sunAngularRadius, inside, pi / 2 - sunZenithAngle, result);
        };
        sunlight(sky.trueOptics ? *sky.trueOptics : sky.optics, unscattered.data());
        if (diffuse) {
            inside_->diffuse(inside, std::cos(sunZenithAngle), *scratch, diffuse);
            // Truncated peaks count as sunlight inside; to others they are light of the sky.
            sunlight(sky.optics, scratch->light.data());
            for (int w = 0; w < wavelengths; ++w)
                diffuse[w] = notNegative(diffuse[w] + scratch->light[w] - unscattered[w]) * sky.medium.solarIrradiance[w];
            sky.checkAnswer("The irradiance by the sky", diffuse);
        }
        if (direct) {
            for (int w = 0; w < wavelengths; ++w)
                direct[w] = unscattered[w] * sky.medium.solarIrradiance[w];
            sky.checkAnswer("The irradiance by the Sun", direct);
        }
    });
}

} // namespace showmysky
