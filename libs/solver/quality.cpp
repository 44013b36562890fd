#include "solver/quality.hpp"
#include "base/error.hpp"
#include "physics/geometry.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numeric>
#include <sstream>

namespace sky::solver {

namespace {

/// A point of the front, and its error in each kind of air. The order of the list is that of processor time. Errors are the larger one of what
/// tables by Monte Carlo show, their noise removed, and, without particles, of what separates the point from `reference` at the same places:
///   bench_front front AIR.atmo TABLE.csv --orders all --presets draft!,normal!,good!,fine!,finer! [--against reference]
/// for the airs and tables of bench/run: thin, earth, dense, hazy, cloudy. Where the tables can't tell finer points apart, these keep the error of
/// the coarser one, and where a coarse one errs less by chance it has the error of the finer. What is finer than `fine` was only looked at in the
/// Earth's air (docs/accuracy.md). Of sharp peaks the worse of two airs counts, with as many particles as aerosols, and 1.4 times as many.
struct Point {
    std::string name;
    double work; ///< processor time of the moments by that of `normal`, about the mean over the kinds of air
    physics::MomentSettings moments;
    BakeSettings bake;
    std::map<Air, double> error; ///< rms, the worst of day, sunset and twilight
};

const std::vector<Point>& points()
{
    using enum Air;
    static const std::vector<Point> list{
        {"draft",
         0.5,
         {12, 24, 4, 4, 3, 6, 4, 48, 8, true, 5e-3, 4},
         {20, 8, 2},
         {{Clear, 0.0063}, {Dusty, 0.014}, {Dense, 0.0092}, {Hazy, 0.0057}, {Sharp, 0.0079}, {Cloudy, 0.0129}}},
        {"normal",
         1,
         {14, 28, 8, 7, 4, 8, 6, 64, 10, true, 2.5e-3, 4},
         {64, 10, 3},
         {{Clear, 0.0037}, {Dusty, 0.0062}, {Dense, 0.0052}, {Hazy, 0.0054}, {Sharp, 0.0079}, {Cloudy, 0.0094}}},
        {"good",
         3,
         {18, 36, 12, 8, 5, 10, 10, 96, 14, true, 1e-3, 5},
         {72, 14, 3},
         {{Clear, 0.0027}, {Dusty, 0.0031}, {Dense, 0.0021}, {Hazy, 0.0054}, {Sharp, 0.0079}, {Cloudy, 0.007}}},
        {"fine",
         9,
         {24, 48, 12, 8, 6, 12, 12, 160, 20, true, 5e-4, 6},
         {80, 24, 4},
         {{Clear, 0.0023}, {Dusty, 0.0024}, {Dense, 0.0021}, {Hazy, 0.0054}, {Sharp, 0.0079}, {Cloudy, 0.0064}}},
        {"finer",
         30,
         {30, 60, 14, 10, 8, 16, 14, 176, 28, true, 2e-4, 8},
         {120, 32, 5},
         {{Clear, 0.0023}, {Dusty, 0.0007}, {Dense, 0.0021}, {Hazy, 0.0054}, {Sharp, 0.0079}, {Cloudy, 0.0064}}},
        {"reference",
         110,
         {40, 80, 16, 12, 10, 20, 18, 192, 40, true, 1e-4, 10},
         {160, 48, 6},
         {{Clear, 0.0023}, {Dusty, 0.0005}, {Dense, 0.0021}, {Hazy, 0.0054}, {Sharp, 0.0079}, {Cloudy, 0.0064}}},
    };
    return list;
}

const Point& pointNamed(const std::string& name)
{
    for (const Point& point : points())
        if (point.name == name)
            return point;
    std::string known;
    for (const Point& point : points())
        known += (known.empty() ? "" : &point == &points().back() ? " or " : ", ") + point.name;
    throw UsageError("--quality is \"" + name + "\"; expected " + known + ".");
}

bool truncatesPeaks(const physics::Medium& medium, const int degree)
{
    return physics::truncates(physics::makeOptics(medium, degree, true));
}

/// Vertical optical depth of scattering, the mean over wavelengths.
double scatteringDepth(const physics::Medium& medium)
{
    double sum = 0;
    for (const auto& species : medium.species)
        for (const double depth : physics::scatteringDepths(medium, species))
            sum += depth;
    return sum / medium.wavelengthCount();
}

/// A peak of which so much is left at this degree (g = 0.92) shows beyond all harmonics, wherever such particles do so much of the scattering.
constexpr int lastDegree = 15;
constexpr double sharpMoment = 0.3, sharpShare = 0.005;
bool hasSharpPeaks(const physics::Medium& medium)
{
    const double all = scatteringDepth(medium);
    for (const auto& species : medium.species) {
        const auto depths = physics::scatteringDepths(medium, species);
        for (int w = 0; w < medium.wavelengthCount(); ++w)
            if (depths[w] > sharpShare * all && physics::phaseMoments(medium, species, w, lastDegree)[lastDegree] > sharpMoment)
                return true;
    }
    return false;
}

const char* nameOf(const Air air)
{
    switch (air) {
    case Air::Clear: return "air without particles";
    case Air::Dusty: return "air with few particles";
    case Air::Dense: return "dense air";
    case Air::Hazy: return "haze";
    case Air::Sharp: return "air with sharp peaks";
    case Air::Cloudy: return "clouds";
    }
    return "";
}

std::string percent(const double value)
{
    std::ostringstream text;
    text << std::setprecision(2) << 100 * value << " %";
    return text.str();
}

/// Legendre moments below this don't show.
constexpr double negligibleMoment = 1e-4;

/// Smallest degree, up to `most`, above which no species' Legendre moments matter.
///   tolerance  0: moments count by themselves; else by the share of light that the species scatters along the vertical
int neededDegree(const physics::Medium& medium, int most, double tolerance)
{
    int needed = 0;
    for (const auto& species : medium.species) {
        if (!species.scatters())
            continue;
        const auto depths = physics::scatteringDepths(medium, species);
        for (int w = 0; w < medium.wavelengthCount(); ++w) {
            const double depth = depths[w];
            if (!(depth > 0) || (w > 0 && species.achromatic && tolerance == 0))
                continue;
            const double weight = tolerance > 0 ? std::min(1., depth) / tolerance : 1 / negligibleMoment;
            const auto moments = physics::phaseMoments(medium, species, w, most);
            for (int l = most; l > needed; --l)
                if (std::abs(moments[l]) * weight > 1) {
                    needed = l;
                    break;
                }
        }
    }
    return needed;
}

/// Vertical optical depth of scattering above which air is dense: most light is scattered more than once.
constexpr double thick = 1.2;

/// A peak worth truncating is worth more harmonics, directions that resolve them, and nodes where light dims along the ray. Most of them in
/// haze: the aureole of light scattered twice is cut with the peak, and a cloud washes it out; and slanted rays see far into haze.
physics::MomentSettings forPeaks(physics::MomentSettings m, const bool dense)
{
    m.degree = std::max(dense ? 14 : 18, m.degree + 6);
    m.nodes += dense ? 2 : 6;
    m.groundDirections += 2;
    m.skyDirections += 2;
    m.lightAzimuths = m.azimuths;
    m.azimuths = std::max(m.azimuths, m.degree + 2);
    return m;
}

/// A peak in thin air is blurred to what the harmonics resolve.
physics::MomentSettings forBlurredPeaks(physics::MomentSettings m)
{
    m.degree += 6;
    m.lightAzimuths = m.azimuths;
    m.azimuths = std::max(m.azimuths, m.degree + 2);
    return m;
}

/// What air asks for beyond the point of the front.
physics::MomentSettings forAir(physics::MomentSettings m, const physics::Medium& medium)
{
    const bool dense = scatteringDepth(medium) > thick;
    const auto optics = physics::makeOptics(medium, m.degree, true);
    if (physics::truncates(optics))
        return forPeaks(m, dense);
    if (dense) // the field changes along a ray as light dims
        m.nodes += m.nodes / 2;
    return physics::blurs(optics) ? forBlurredPeaks(m) : m;
}

} // namespace

const std::vector<std::string>& qualityNames()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Point& point : points())
            list.push_back(point.name);
        return list;
    }();
    return names;
}

Quality qualityFor(const std::string& name, const physics::Medium& medium, const double tolerance)
{
    const Point& point = pointNamed(name);
    Quality q{forAir(point.moments, medium), point.bake};
    q.moments.degree = neededDegree(medium, q.moments.degree, tolerance);
    // Less than a tenth of what each quality errs by (docs/method 5).
    q.bake.stationTolerance = q.moments.stationTolerance = 0.3 * q.moments.tolerance;
    return q;
}

double relativeWork(const std::string& quality) { return pointNamed(quality).work; }

Air airOf(const physics::Medium& medium)
{
    const bool dense = scatteringDepth(medium) > thick;
    const int degree = pointNamed("normal").moments.degree;
    if (!dense && hasSharpPeaks(medium))
        return Air::Sharp;
    if (truncatesPeaks(medium, degree))
        return dense ? Air::Cloudy : Air::Hazy;
    return dense ? Air::Dense : neededDegree(medium, degree, 0) > 2 ? Air::Dusty : Air::Clear;
}

Pick pickQuality(const double tolerance, const physics::Medium& medium)
{
    const Air air = airOf(medium);
    const auto reaches = [&](const Point& point) { return point.error.at(air) <= tolerance; };
    const auto found = std::find_if(points().begin(), points().end(), reaches);
    const bool reached = found != points().end();
    const auto lessError = [&](const Point& a, const Point& b) { return a.error.at(air) < b.error.at(air); };
    const Point& point = *(reached ? found : std::min_element(points().begin(), points().end(), lessError)); // the first of equals
    const double error = point.error.at(air);
    const std::string what = "quality " + point.name + ", whose error in " + nameOf(air) + " is predicted to be " + percent(error);
    return {point.name, error, reached,
            reached ? "A tolerance of " + percent(tolerance) + " takes " + what + "."
                    : "No quality is predicted to reach a tolerance of " + percent(tolerance) + ": taken is " + what + "."};
}

std::vector<std::string> unresolvedPeaks(const physics::Medium& medium)
{
    constexpr double mostOfIt = 0.75; // g = 0.981; of a cloud's droplets of g = 0.85 it is 0.09
    constexpr double bright = 0.02;   // ground: where it is darker, what thin air scatters of its light is of no weight
    const auto meanOf = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
    };
    std::vector<std::string> sentences;
    double vertical = 0, horizontal = 0; // of all such scatterers
    for (const auto& species : medium.species) {
        const double mine = meanOf(physics::scatteringDepths(medium, species));
        if (!(mine > 0))
            continue;
        double inPeak = 0;
        for (int w = 0; w < medium.wavelengthCount(); ++w)
            inPeak = std::max(inPeak, physics::phaseMoments(medium, species, w, lastDegree)[lastDegree]);
        if (!(inPeak > mostOfIt))
            continue;
        vertical += mine;
        horizontal += mine * physics::horizontalColumn(medium, species) / physics::verticalColumn(medium, species);
        sentences.push_back("Scatterer `" + species.name + "` throws " + percent(inPeak) +
                            " of its light into a peak that is too narrow for any quality: what it scatters of light from the ground, and "
                            "of light scattered before, may be wrong by half and more, most of all near the horizon.");
    }
    // Where neither holds, nearly all light that they scatter comes straight from the Sun.
    const bool seen = horizontal > thick || meanOf(medium.groundAlbedo) > bright;
    return seen && vertical > 0.5 * scatteringDepth(medium) ? sentences : std::vector<std::string>{};
}

Options settled(Options options, const physics::Medium& medium, Progress& progress)
{
    if (!options.qualityByTolerance || !options.tolerance)
        return options;
    if (!unresolvedPeaks(medium).empty()) {
        options.quality = "normal";
        progress.warning("No error can be predicted where peaks are too narrow for any quality: taken is quality " + options.quality + ".");
        return options;
    }
    const Pick pick = pickQuality(*options.tolerance, medium);
    options.quality = pick.quality;
    options.predictedError = pick.predictedError;
    pick.reached ? progress.remark(pick.sentence) : progress.warning(pick.sentence);
    return options;
}

double orderTolerance(const Options& options) { return options.tolerance.value_or(0) * (options.qualityByTolerance ? 0.25 : 1); }

} // namespace sky::solver
