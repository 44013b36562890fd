#pragma once
// The independent judge: sky radiance by Monte Carlo in double precision on the CPU. It takes the plain tables of the
// medium and shares no formula with the solver. Method, equations and tests: docs/reference.md.

#include "physics/medium.hpp"

#include <cstdint>
#include <deque>
#include <iosfwd>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace sky::montecarlo {

class Air;
struct GroundDisc; // ground_light.hpp

/// Where the Moon stands, seen from the camera, and what an eclipse needs beside. SI, radians.
struct MoonPlace {
    double zenithAngle = 0;
    double relativeAzimuth = 0; ///< minus that of the Sun, counted as Query::relativeAzimuth
    double distance = 0;        ///< from the planet's centre
    double radius = 0;
    double sunDistance = 0; ///< from the planet's centre
};

/// Where the camera stands, where the Sun is and where the camera looks. SI, radians.
struct Query {
    double altitude = 0;             ///< m, >= 0; may be above the atmosphere
    double sunZenithAngle = 0;       ///< of the centre of the disc, at the camera
    double viewZenithAngle = 0;      ///< 0 up, pi/2 horizontal
    double relativeAzimuth = 0;      ///< of the view minus that of the Sun: 0 = towards the Sun
    int wavelength = 0;              ///< index into Medium::wavelengthsNm
    std::optional<MoonPlace> moon{}; ///< none: no eclipse
};

struct Settings {
    int orders = 0;                  ///< events counted; 0 = all, ended by Russian roulette
    double relativeError = 1e-3;     ///< stop when stderr / (single + multiple) is below; 0 = use maxPaths
    std::int64_t maxPaths = 1 << 24; ///< rounded up to whole batches
    double maxSeconds = 0;           ///< 0 = no limit. The only setting that makes a result depend on the machine
    std::uint64_t seed = 1;          ///< queries with the same seed still have independent errors
    int threads = 0;                 ///< 0 = one per processor. Does not change the result
};

/// Radiance per unit solar irradiance on a plane facing the Sun outside the atmosphere, 1/sr. The sky is single +
/// multiple; light whose last event is the ground in direct view is in neither. Orders are counted as in
/// docs/reference.md.
struct Result {
    double single = 0;         ///< scattered exactly once, in the air; by quadrature
    double multiple = 0;       ///< orders 2 and above (up to Settings::orders)
    double singleStderr = 0;   ///< change of `single` when its steps were last halved
    double multipleStderr = 0; ///< one standard error of `multiple`
    double groundDirect = 0;   ///< ground in direct view, lit by direct sunlight only; 0 if the ray misses it
    std::int64_t paths = 0;

    double total() const { return single + multiple; }
};

/// `result` times the solar irradiance (W m^-2 nm^-1): W m^-2 sr^-1 nm^-1.
Result scaled(const Result& result, double solarIrradiance);

/// Light of a ground whose own radiance is 1, as a share of it.
struct GroundLight {
    double direct = 0;          ///< the ground itself in direct view, dimmed by the air in between
    double scattered = 0;       ///< all light whose last event is in the air (up to Settings::orders)
    double scatteredStderr = 0; ///< one standard error of `scattered`
    std::int64_t paths = 0;
};

/// The judge of one medium. Prepares a wavelength when it is first asked for; safe to share between threads.
class Reference
{
public:
    ///   throws  RangeError where the tables do not fit together or hold values outside their range
    explicit Reference(physics::Medium medium);
    ~Reference();

    const physics::Medium& medium() const { return medium_; }

    /// Deterministic for given settings whatever the number of threads, unless maxSeconds ends it.
    ///   throws  RangeError where the query is outside its range
    Result radiance(const Query& query, const Settings& settings) const;

    /// Order 1 by random paths: checks the quadrature that radiance() uses. In Result::multiple.
    Result singleByPaths(const Query& query, const Settings& settings) const;

    /// Light of a glowing ground, or of a glowing disc on it. The Sun plays no part. Settings::relativeError is that of `scattered`.
    GroundLight groundLight(const Query& query, const std::optional<GroundDisc>& disc, const Settings& settings) const;

private:
    struct Slot {
        std::once_flag once;
        std::unique_ptr<Air> air;
    };
    const Air& air(int wavelength) const;
    void check(const Query& query) const;

    physics::Medium medium_;
    mutable std::deque<Slot> slots_; // deque: slots cannot be moved
};

/// One line of a table of reference radiances.
struct Row {
    std::string atmosphere;
    int orders = 0;
    Query query;
    Result result;
};

/// Writes rows under the header
/// atmosphere,orders,altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm,L1_per_sr,Lms_per_sr,Lms_stderr,L0_per_sr
/// and, if any row has a Moon, moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m;
/// with orders "all" for 0. `wavelengthsNm` is that of the medium.
void writeCsv(std::ostream& out, const std::vector<Row>& rows, const std::vector<double>& wavelengthsNm);

} // namespace sky::montecarlo
