#pragma once
// Light of a city: a disc on the ground of uniform radiance, which the air scatters towards places that may lie far away, beyond the
// city's horizon too. Everything is per radiance of the disc.
//
// The field of a city is symmetric about the axis from the planet's centre through the disc's: it depends on the altitude and on the
// angle between the vertical and that axis, as the Sun's field does on altitude and height of the Sun. So it takes the same moments.

#include "base/stop.hpp"
#include "physics/optics.hpp"
#include "physics/profile.hpp"
#include "physics/ray.hpp"
#include <memory>
#include <vector>

namespace sky::physics {

/// A ray from a place near a city. Angles at the planet's centre are rad.
struct CityView {
    double altitude = 0;  ///< of the start, m, in the air
    double mu = 1;        ///< cosine of the ray's zenith angle
    double fromCity = 0;  ///< angle between the vertical of the start and the axis of the city
    double alongAxis = 1; ///< cosine of the angle between the ray and the axis
    bool hitsGround = false;
};

/// The air as city light needs it; made once for a medium, for cities of all sizes.
class CityAir
{
public:
    explicit CityAir(const Medium& medium);
    CityAir(const CityAir&) = delete;

    const Medium& medium() const { return medium_; }
    const Profile& profile() const { return profile_; }
    const Optics& optics() const { return optics_; }

    struct Scratch {
        std::vector<float> columns, sums;
        std::vector<const float*> near, far;
    };

    /// Light of the disc that arrives at a place and is scattered into a direction, without the density of what scatters.
    ///   altitude, fromCity  of the place
    ///   discRadius          angle at the planet's centre
    ///   mu, cosine, sine    of the direction one looks along: of its zenith angle; of its azimuth from the city's direction, times the
    ///                       sine of the zenith angle
    ///   scratch             memory of one thread
    ///   result              [scatterer][stride]: integral of T p_i over the disc's solid angle; phase functions exact (or cut at the
    ///                       degree), over scaled optical depths (TMS)
    void scattered(double altitude, double fromCity, double discRadius, double mu, double cosine, double sine, Scratch& scratch,
                   float* result) const;

    /// The sum over harmonics of lambda_l I_lm Y_lm for each scatterer, added.
    ///   moments  [lm][stride]
    ///   factors  Y_lm of the direction, [lm]
    ///   result   [scatterer][stride]
    void addHarmonics(const float* moments, const float* factors, Scratch& scratch, float* result) const;

    int stride() const { return stride_; } ///< wavelengths, rounded up to whole vectors
    int scatterers() const { return static_cast<int>(optics_.scatterers.size()); }

private:
    struct Element {
        double towards[3];   // unit vector from the place: to the city, across, up
        double distance;     // m
        double sineAtGround; // of the elevation there
        double solidAngle;
    };
    int elementsOf(double altitude, double fromCity, double discRadius, Element* elements) const;
    void meanDensities(double altitude, double sineAtGround, float* result) const;

    const Medium& medium_;
    Profile profile_;
    Optics optics_;
    int stride_, species_;
    std::vector<double> altitudes_; // of the links
    std::vector<float> links_;      // [altitude][elevation][species], m^-3: mean density between the ground and the altitude
    std::vector<float> extinction_; // [species][stride], m^2 / ln 2
    std::vector<float> phases_;     // [scatterer][angle][stride], sr^-1
    std::vector<float> lambdas_;    // [scatterer][l][stride]
};

/// A ray through the air near cities, followed once for all of them.
struct CityColumns {
    SeenColumns columns;
    std::vector<double> nodes; ///< distances where the light that is seen comes from, increasing from 0 to the end; none without length
    /// \param count of the nodes
    CityColumns(RayTracer& tracer, double altitude, double mu, bool hitsGround, int count = 20);
};

/// Higher orders of a disc's light: moments of what has been scattered at least once, on a grid of altitude and angle from the city.
class CityField
{
public:
    ///   discRadius  angle at the planet's centre
    ///   stop        asked before the rays of every point of the grid in every event; throws base::Stopped
    CityField(const CityAir& air, double discRadius, const base::StopRequest& stop = {});

    double discRadius() const { return discRadius_; }
    /// Light that has been scattered or reflected before, scattered into a direction; [stride] of moments, then the sum over l, m is the
    /// caller's: see cityRadiance.
    ///   result  [lm][stride]
    void interpolate(double altitude, double fromCity, float* result) const;
    /// Irradiance of the ground by the sky, [stride], per radiance of the disc, sr.
    void groundIrradiance(double fromCity, float* result) const;
    int events() const { return events_; }

private:
    double position(double fromCity) const;
    double angleAt(int node) const;

    const CityAir& air_;
    double discRadius_, scale_, farthest_;
    int stride_, harmonics_, angles_, events_ = 0;
    std::vector<double> altitudes_, measures_;
    std::vector<float> values_; // [altitude][angle][lm][stride]: log2 I_00, then ratios
    std::vector<float> ground_; // [angle][stride]: log2 of the irradiance
};

/// Radiance of a disc's light along a ray, per radiance of the disc, the disc itself in direct view included.
///   columns  of the ray, traced with the profile and optics of `air`
///   field    null: single scattering alone
///   direct   whether a disc in direct view counts: pictures draw its edge by themselves
///   result   [wavelength], >= 0
void cityRadiance(const CityAir& air, const CityField* field, double discRadius, const CityView& view, const CityColumns& columns,
                  bool direct, double* result);

} // namespace sky::physics
