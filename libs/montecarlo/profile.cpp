#include "montecarlo/profile.hpp"

#include "montecarlo/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace sky::montecarlo {
namespace {

using physics::Medium;
using physics::Species;

constexpr int samplesPerInterval = 4;
constexpr int enoughShells = 64;

/// The interpolation rule of physics::Medium between two nodes, 0 <= t <= 1.
double between(double a, double b, double t)
{
    return a > 0 && b > 0 ? std::exp((1 - t) * std::log(a) + t * std::log(b)) : (1 - t) * a + t * b;
}

double extinctionOf(const Medium& medium, int wavelength, std::size_t interval, double t)
{
    double sum = 0;
    for (const Species& species : medium.species)
        sum +=
            species.extinctionCrossSection[wavelength] * between(species.numberDensity[interval], species.numberDensity[interval + 1], t);
    return sum;
}

/// Parts into which an interval of the table is cut so that no density changes by more than half an e-fold in one.
int partsOf(const Medium& medium, std::size_t interval)
{
    double folds = 0;
    for (const Species& species : medium.species) {
        const double a = species.numberDensity[interval], b = species.numberDensity[interval + 1];
        if (a > 0 && b > 0)
            folds = std::max(folds, std::abs(std::log(a / b)));
    }
    return std::clamp(static_cast<int>(std::ceil(2 * folds)), 1, 400);
}

/// Whether a species begins or ends at a node of the tables.
bool edgeAt(const Medium& medium, std::size_t node)
{
    return std::any_of(medium.species.begin(), medium.species.end(), [&](const Species& species) {
        const auto& n = species.numberDensity;
        return n[node] == 0 && (n[node - 1] > 0 || n[node + 1] > 0);
    });
}

/// Legendre polynomials P_0 .. P_5 at y.
std::array<double, 6> legendre(double y)
{
    std::array<double, 6> p{1, y};
    for (int k = 2; k < 6; ++k)
        p[k] = ((2 * k - 1) * y * p[k - 1] - (k - 1) * p[k - 2]) / k;
    return p;
}

/// Coefficients of powers of y from those of P_0 .. P_5.
std::array<double, 6> powersFromLegendre(const std::array<double, 6>& c)
{
    return {c[0] - c[2] / 2 + 3 * c[4] / 8,
            c[1] - 3 * c[3] / 2 + 15 * c[5] / 8,
            3 * c[2] / 2 - 30 * c[4] / 8,
            5 * c[3] / 2 - 70 * c[5] / 8,
            35 * c[4] / 8,
            63 * c[5] / 8};
}

} // namespace

Profile::Profile(const Medium& medium, int wavelength) : planetRadius_(medium.planetRadius), topOfAtmosphere_(medium.topOfAtmosphere)
{
    const Rule gauss = gaussLegendre(samplesPerInterval);
    std::vector<double> stations{0};
    std::vector<Sample> samples;
    std::vector<std::size_t> edges;
    for (std::size_t i = 0; i + 1 < medium.altitudes.size(); ++i) {
        if (i > 0 && edgeAt(medium, i))
            edges.push_back(stations.size() - 1);
        const double low = medium.altitudes[i], high = medium.altitudes[i + 1];
        const int parts = partsOf(medium, i);
        for (int part = 0; part < parts; ++part) {
            for (int k = samplesPerInterval - 1; k >= 0; --k) {
                const double t = (part + 0.5 + 0.5 * gauss.node[k]) / parts;
                const double altitude = low + t * (high - low);
                // dX = 2 r dh: the weights integrate over X.
                const double weight = gauss.weight[k] * (high - low) / parts * (planetRadius_ + altitude);
                samples.push_back({radialSquare(planetRadius_, altitude), extinctionOf(medium, wavelength, i, t), weight});
            }
            const double end = part + 1 == parts ? high : low + (high - low) * (part + 1) / parts;
            stations.push_back(radialSquare(planetRadius_, end));
        }
    }
    // Tables with many intervals of their own small kinks cannot be merged at the finest tolerance. The fits keep
    // the integrals, so a wider one only smooths those kinks.
    edges.push_back(stations.size() - 1);
    for (double tolerance = 2e-6; tolerance < 2e-4; tolerance *= 3) {
        fit(stations, samples, edges, tolerance);
        if (shellCount() <= enoughShells + static_cast<int>(edges.size()))
            return;
    }
}

void Profile::fit(const std::vector<double>& stations, const std::vector<Sample>& samples, const std::vector<std::size_t>& edges,
                  double tolerance)
{
    shells_.clear();
    // Fits one shell to the intervals first .. last-1; returns whether all samples lie within the tolerance.
    Shell shell{};
    const auto fits = [&](std::size_t first, std::size_t last) {
        shell.low = stations[first];
        shell.high = stations[last];
        shell.middle = 0.5 * (shell.low + shell.high);
        shell.inverseHalf = 2 / (shell.high - shell.low);
        std::array<double, terms> c{};
        double largest = 0;
        for (std::size_t i = first * samplesPerInterval; i < last * samplesPerInterval; ++i) {
            const auto p = legendre((samples[i].x - shell.middle) * shell.inverseHalf);
            for (int k = 0; k < terms; ++k)
                c[k] += (k + 0.5) * p[k] * samples[i].beta * samples[i].weight * shell.inverseHalf;
            largest = std::max(largest, samples[i].beta);
        }
        shell.power = powersFromLegendre(c);
        for (std::size_t i = first * samplesPerInterval; i < last * samplesPerInterval; ++i)
            if (std::abs(shell.value(samples[i].x) - samples[i].beta) > tolerance * largest)
                return false;
        return true;
    };

    auto edge = edges.begin();
    for (std::size_t first = 0; first < edges.back();) {
        edge += first == *edge;
        const std::size_t count = *edge;
        // Gallop to a length that fails, then bisect to the longest that fits. One interval is always accepted.
        std::size_t good = 1, bad = 2;
        while (first + bad <= count && fits(first, first + bad)) {
            good = bad;
            bad *= 2;
        }
        bad = std::min(bad, count - first + 1);
        while (bad - good > 1) {
            const std::size_t middle = (good + bad) / 2;
            (fits(first, first + middle) ? good : bad) = middle;
        }
        fits(first, first + good);
        shells_.push_back(shell);
        first += good;
    }
}

double Profile::Shell::value(double x) const
{
    const double y = (x - middle) * inverseHalf;
    return power[0] + y * (power[1] + y * (power[2] + y * (power[3] + y * (power[4] + y * power[5]))));
}

double Profile::Shell::integral(const Ray& ray, double begin, double end) const
{
    static constexpr double node3 = 0.774596669241483377, weight3[] = {0.888888888888888889, 0.555555555555555556};
    static constexpr double node6[] = {0.238619186083196909, 0.661209386466264514, 0.932469514203152028};
    static constexpr double weight6[] = {0.467913934572691047, 0.360761573048138608, 0.171324492379170345};
    const double half = 0.5 * (end - begin), centre = 0.5 * (end + begin);
    // X departs from a straight line by half^2 at most. Where that is small the integrand is of degree 5 in s.
    if (half * half * inverseHalf < 0.02)
        return half * (weight3[0] * value(ray.at(centre)) +
                       weight3[1] * (value(ray.at(centre - half * node3)) + value(ray.at(centre + half * node3))));
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        sum += weight6[k] * (value(ray.at(centre - half * node6[k])) + value(ray.at(centre + half * node6[k])));
    return half * sum;
}

int Profile::shellAt(double x) const
{
    const auto after =
        std::upper_bound(shells_.begin(), shells_.end(), x, [](double value, const Shell& shell) { return value < shell.high; });
    return std::min(static_cast<int>(after - shells_.begin()), shellCount() - 1);
}

/// Calls visit(shell, begin, end) for the parts of the ray inside the atmosphere, in order.
template<class Visit>
void Profile::walk(const Ray& ray, Visit&& visit) const
{
    int k = shellAt(ray.x0);
    double s = 0;
    if (ray.b < 0) {
        const double lowest = ray.lowest();
        for (; k >= 0 && shells_[k].low >= lowest; --k) {
            const double end = ray.down(std::min(shells_[k].low, ray.x0));
            visit(k, s, end);
            s = end;
        }
        if (k < 0 && ray.hitsGround())
            return;
        k = std::max(k, 0); // a perigee exactly on the ground
    }
    for (; k < shellCount(); ++k) {
        const double end = std::max(s, ray.up(shells_[k].high));
        visit(k, s, end);
        s = end;
    }
}

double Profile::opticalDepthToSpace(const Ray& ray) const
{
    double sum = 0;
    walk(ray, [&](int k, double begin, double end) { sum += shells_[k].integral(ray, begin, end); });
    return std::max(0.0, sum);
}

void Profile::trace(const Ray& ray, Leg& leg) const
{
    leg.segments.clear();
    leg.opticalDepth = leg.length = 0;
    leg.hitsGround = ray.hitsGround();
    walk(ray, [&](int k, double begin, double end) {
        const double depth = std::max(0.0, shells_[k].integral(ray, begin, end));
        leg.segments.push_back({begin, end, depth, k});
        leg.opticalDepth += depth;
        leg.length = end;
    });
}

double Profile::partialDepth(const Ray& ray, const Segment& segment, double s) const
{
    return std::clamp(shells_[segment.shell].integral(ray, segment.begin, s), 0.0, segment.opticalDepth);
}

double Profile::distanceAt(const Ray& ray, const Segment& segment, double depth) const
{
    const Shell& shell = shells_[segment.shell];
    double low = segment.begin, high = segment.end;
    double s = low + (high - low) * depth / segment.opticalDepth;
    // Newton's iteration, kept inside a shrinking bracket by bisection.
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double excess = shell.integral(ray, segment.begin, s) - depth;
        if (std::abs(excess) <= 1e-9 * segment.opticalDepth)
            break;
        (excess > 0 ? high : low) = s;
        const double beta = shell.value(ray.at(s));
        const double next = s - excess / beta;
        s = beta > 0 && next > low && next < high ? next : 0.5 * (low + high);
    }
    return s;
}

double Profile::extinction(double altitude) const
{
    const double x = radialSquare(planetRadius_, altitude);
    return std::max(0.0, shells_[shellAt(x)].value(x));
}

std::array<double, 2> Profile::altitudesOf(int shell) const
{
    return {altitudeOf(planetRadius_, shells_[shell].low), altitudeOf(planetRadius_, shells_[shell].high)};
}

double Profile::middleAltitude(int shell) const { return altitudeOf(planetRadius_, shells_[shell].middle); }

} // namespace sky::montecarlo
