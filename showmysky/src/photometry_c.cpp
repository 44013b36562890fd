#include "c_cities.hpp"
#include "showmysky/photometry.h"
#include "showmysky/photometry.hpp"
#include <algorithm>
#include <cstring>
#include <new>

using showmysky::Error;
using showmysky::ErrorKind;
using showmysky::Photometer;

struct showmysky_photometer {
    Photometer photometer;
};

static_assert(sizeof(showmysky_view) == 5 * sizeof(double));
static_assert(unsigned(SHOWMYSKY_ZERO_ORDER) == Photometer::zeroOrder &&
              unsigned(SHOWMYSKY_SINGLE_SCATTERING) == Photometer::singleScattering &&
              unsigned(SHOWMYSKY_MULTIPLE_SCATTERING) == Photometer::multipleScattering &&
              unsigned(SHOWMYSKY_LIGHT_POLLUTION) == Photometer::lightPollution && unsigned(SHOWMYSKY_WHOLE_SKY) == Photometer::wholeSky);

namespace {

/// The sentence of this thread's last failure. Of fixed size: keeping it can't fail.
char* lastError()
{
    thread_local char text[1024] = "";
    return text;
}

int fail(int status, const char* message) noexcept
{
    constexpr std::size_t room = 1024;
    std::strncpy(lastError(), message, room - 1);
    lastError()[room - 1] = 0;
    return status;
}

/// Runs an action; what it throws becomes a status and a sentence.
template<class Action>
int guarded(Action&& action) noexcept
{
    try {
        action();
        return SHOWMYSKY_PHOTOMETRY_OK;
    } catch (const Error& error) {
        const auto kind = error.kind();
        return fail(kind == ErrorKind::model         ? SHOWMYSKY_PHOTOMETRY_BAD_MODEL
                    : kind == ErrorKind::settings    ? SHOWMYSKY_PHOTOMETRY_BAD_ARGUMENT
                    : kind == ErrorKind::unsupported ? SHOWMYSKY_PHOTOMETRY_UNSUPPORTED
                                                     : SHOWMYSKY_PHOTOMETRY_FAILED,
                    error.what());
    } catch (const std::bad_alloc&) {
        return fail(SHOWMYSKY_PHOTOMETRY_FAILED, "There is not enough memory.");
    } catch (const std::exception& error) {
        return fail(SHOWMYSKY_PHOTOMETRY_FAILED, error.what());
    } catch (...) {
        return fail(SHOWMYSKY_PHOTOMETRY_FAILED, "Something failed that should not.");
    }
}

/// The same with a photometer; `given` says whether all pointers are there.
template<class Action>
int answer(const showmysky_photometer* photometer, bool given, Action&& action) noexcept
{
    if (!photometer || !given)
        return fail(SHOWMYSKY_PHOTOMETRY_BAD_ARGUMENT, "A null pointer was passed where an object or an array is expected.");
    return guarded([&] { action(photometer->photometer); });
}

Photometer::View viewOf(const showmysky_view& v)
{
    return {v.altitude, v.sun_zenith_angle, v.sun_azimuth, v.view_zenith_angle, v.view_azimuth};
}

void store(const Photometer::Colour& colour, double* result)
{
    result[0] = colour.X;
    result[1] = colour.Y;
    result[2] = colour.Z;
    result[3] = colour.scotopic;
}

} // namespace

int showmysky_photometry_abi(void) { return SHOWMYSKY_PHOTOMETRY_ABI; }

const char* showmysky_photometry_error(void) { return lastError(); }

int showmysky_photometer_open(const char* directory, int reference, showmysky_photometer** result)
{
    if (!directory || !result)
        return fail(SHOWMYSKY_PHOTOMETRY_BAD_ARGUMENT, "A null pointer was passed where a text or a place for the result is expected.");
    *result = nullptr;
    return guarded([&] {
        *result = new showmysky_photometer{Photometer(directory, reference ? Photometer::Method::reference : Photometer::Method::fast)};
    });
}

void showmysky_photometer_close(showmysky_photometer* photometer) { delete photometer; }

size_t showmysky_photometer_wavelength_count(const showmysky_photometer* photometer)
{
    return photometer ? photometer->photometer.wavelengthsNm().size() : 0;
}

int showmysky_photometer_wavelengths(const showmysky_photometer* photometer, double* nanometres)
{
    return answer(photometer, nanometres,
                  [&](const Photometer& p) { std::copy(p.wavelengthsNm().begin(), p.wavelengthsNm().end(), nanometres); });
}

int showmysky_photometer_solar_irradiance(const showmysky_photometer* photometer, double* spectrum)
{
    return answer(photometer, spectrum,
                  [&](const Photometer& p) { std::copy(p.solarIrradiance().begin(), p.solarIrradiance().end(), spectrum); });
}

int showmysky_photometer_radiance(const showmysky_photometer* photometer, const showmysky_view* views, size_t count, unsigned layers,
                                  double* spectra)
{
    return answer(photometer, (views && spectra) || count == 0, [&](const Photometer& p) {
        std::vector<Photometer::View> converted(count);
        std::transform(views, views + count, converted.begin(), viewOf);
        p.radianceMany(converted.data(), count, layers, spectra);
    });
}

int showmysky_photometer_eclipsed_radiance(const showmysky_photometer* p, const showmysky_view* views, const showmysky_moon* moons,
                                           size_t count, unsigned layers, double* spectra)
{
    return answer(p, (views && moons && spectra) || count == 0, [&](const Photometer& photometer) {
        const std::size_t wavelengths = photometer.wavelengthsNm().size();
        for (std::size_t i = 0; i < count; ++i) {
            const Photometer::View view = viewOf(views[i]);
            const showmysky::Moon moon{moons[i].azimuth, moons[i].zenith_angle, moons[i].distance};
            photometer.eclipsedRadiance(&view, &moon, 1, layers, spectra + i * wavelengths);
        }
    });
}

int showmysky_photometer_obscuration(const showmysky_photometer* p, const showmysky_view* view, const showmysky_moon* moon, double* share)
{
    return answer(p, view && moon && share, [&](const Photometer& photometer) {
        *share = photometer.obscuration(viewOf(*view), {moon->azimuth, moon->zenith_angle, moon->distance});
    });
}

int showmysky_photometer_city_radiance(const showmysky_photometer* photometer, const showmysky_view* views, size_t count,
                                       const showmysky_city* cities, size_t city_count, double* spectra)
{
    return answer(photometer, ((views && spectra) || count == 0) && (cities || city_count == 0), [&](const Photometer& p) {
        std::vector<Photometer::View> converted(count);
        std::transform(views, views + count, converted.begin(), viewOf);
        p.cityRadiance(converted.data(), count, showmysky::citiesOf(cities, city_count), spectra);
    });
}

int showmysky_photometer_luminance(const showmysky_photometer* photometer, const showmysky_view* views, size_t count, unsigned layers,
                                   double* xyz)
{
    return answer(photometer, (views && xyz) || count == 0, [&](const Photometer& p) {
        for (size_t i = 0; i < count; ++i)
            store(p.luminance(viewOf(views[i]), layers), xyz + 4 * i);
    });
}

int showmysky_photometer_colour(const showmysky_photometer* photometer, const double* spectrum, double* xyz)
{
    return answer(photometer, spectrum && xyz, [&](const Photometer& p) { store(p.colourOf(spectrum), xyz); });
}

int showmysky_photometer_transmittance(const showmysky_photometer* photometer, double altitude, double viewZenithAngle, double* spectrum)
{
    return answer(photometer, spectrum, [&](const Photometer& p) { p.transmittance(altitude, viewZenithAngle, spectrum); });
}

int showmysky_photometer_sun_irradiance(const showmysky_photometer* photometer, double altitude, double sunZenithAngle, double* spectrum)
{
    return answer(photometer, spectrum, [&](const Photometer& p) { p.sunIrradiance(altitude, sunZenithAngle, spectrum); });
}

int showmysky_photometer_horizontal_irradiance(const showmysky_photometer* photometer, double altitude, double sunZenithAngle,
                                               double* direct, double* diffuse)
{
    return answer(photometer, true, [&](const Photometer& p) { p.horizontalIrradiance(altitude, sunZenithAngle, direct, diffuse); });
}
