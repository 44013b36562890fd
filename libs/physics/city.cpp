#include "physics/city.hpp"
#include "base/angles.hpp"
#include "base/lanes.hpp"
#include "physics/harmonics.hpp"
#include "physics/quadrature.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace sky::physics {

namespace {

using base::pi;
constexpr int degreeOfCities = 4;  // of the harmonics of what is scattered more than once
constexpr int linkElevations = 48; // sine of the elevation at the ground: sinh(4 t) / sinh 4
constexpr double linkScale = 4;
constexpr int phaseAngles = 1024;      // theta = pi t^3
constexpr double lowestAltitude = 0.1; // m; nearer, the disc fills the lower half space
constexpr int mostElements = 40;

/// T p_i weights of one element, added up.
SKY_WIDEST_VECTORS
void addElement(const float* __restrict columns, const float* __restrict extinction, int species, const float* const* near,
                const float* const* far, float x, float weight, int scatterers, int stride, float* __restrict result)
{
    for (int w = 0; w < stride; ++w) {
        float depth = 0;
        for (int s = 0; s < species; ++s)
            depth += columns[s] * extinction[s * stride + w];
        const float light = weight * base::exp2Lane(-depth);
        for (int i = 0; i < scatterers; ++i)
            result[i * stride + w] += light * (near[i][w] + x * (far[i][w] - near[i][w]));
    }
}

SKY_WIDEST_VECTORS
void addTerms(const float* __restrict moments, const float* __restrict factors, const float* __restrict lambdas, int degree, int scatterers,
              int stride, float* __restrict sums, float* __restrict result)
{
    for (int l = 0, lm = 0; l <= degree; ++l) {
        for (int w = 0; w < stride; ++w)
            sums[w] = factors[lm] * moments[lm * stride + w];
        ++lm;
        for (int m = 1; m <= l; ++m, ++lm)
            for (int w = 0; w < stride; ++w)
                sums[w] += factors[lm] * moments[lm * stride + w];
        for (int i = 0; i < scatterers; ++i)
            for (int w = 0; w < stride; ++w)
                result[i * stride + w] += sums[w] * lambdas[(i * (degree + 1) + l) * stride + w];
    }
}

} // namespace

CityAir::CityAir(const Medium& medium)
    : medium_(medium), profile_([&] {
          const Profile coarse(medium, 1e-3);
          return coarse.withShellsAt(altitudeNodes(coarse.planet(), 48));
      }()),
      optics_(makeOptics(medium, degreeOfCities, true)), stride_((medium.wavelengthCount() + 3) / 4 * 4), species_(optics_.species),
      altitudes_(profile_.shells())
{
    const int wavelengths = optics_.wavelengths;
    extinction_.assign(size_t(species_) * stride_, 0.F);
    for (int s = 0; s < species_; ++s)
        for (int w = 0; w < wavelengths; ++w)
            extinction_[s * stride_ + w] = static_cast<float>(optics_.extinction[s * wavelengths + w] / std::log(2.));

    lambdas_.assign(size_t(scatterers()) * (optics_.degree + 1) * stride_, 0.F);
    for (int i = 0; i < scatterers(); ++i)
        for (int l = 0; l <= optics_.degree; ++l)
            for (int w = 0; w < wavelengths; ++w)
                lambdas_[(size_t(i) * (optics_.degree + 1) + l) * stride_ + w] =
                    static_cast<float>(optics_.moment(optics_.scatterers[i], l, w));

    // Columns from the ground upwards, shell by shell: two Gauss points in each.
    const auto& p = profile_.planet();
    links_.assign(altitudes_.size() * linkElevations * species_, 0.F);
    std::vector<double> n(species_), column(species_);
    for (int e = 0; e < linkElevations; ++e) {
        const double sine = std::sinh(linkScale * e / (linkElevations - 1)) / std::sinh(linkScale);
        std::fill(column.begin(), column.end(), 0.);
        double from = 0;
        profile_.densities(0, 0, n.data());
        for (int s = 0; s < species_; ++s)
            links_[e * species_ + s] = static_cast<float>(n[s]);
        for (size_t k = 1; k < altitudes_.size(); ++k) {
            const double to = distanceToShell(p, 0, sine, altitudes_[k], false);
            for (const double side : {-1., 1.}) {
                const double s0 = 0.5 * (from + to) + side * 0.5 * (to - from) / std::sqrt(3.);
                profile_.densities(static_cast<int>(k) - 1, altitudeAlong(p, 0, sine, s0), n.data());
                for (int s = 0; s < species_; ++s)
                    column[s] += 0.5 * (to - from) * n[s];
            }
            for (int s = 0; s < species_; ++s)
                links_[(k * linkElevations + e) * species_ + s] = static_cast<float>(column[s] / to);
            from = to;
        }
    }

    std::vector<double> values(wavelengths);
    phases_.assign(size_t(scatterers()) * phaseAngles * stride_, 0.F);
    for (int i = 0; i < scatterers(); ++i) {
        const int species = optics_.scatterers[i];
        for (int a = 0; a < phaseAngles; ++a) {
            phaseFunctionAt(medium_, medium_.species[species], pi * std::pow(double(a) / (phaseAngles - 1), 3), values.data());
            for (int w = 0; w < wavelengths; ++w)
                phases_[(size_t(i) * phaseAngles + a) * stride_ + w] =
                    static_cast<float>(values[w] / (1 - optics_.truncation[species * wavelengths + w]));
        }
    }
}

/// The disc seen from a place as points with solid angles. Far away its centre, nearer rings about its centre, and close above or
/// beside it points along azimuths about the point below, in the tangent of the angle from the nadir, which takes the peak there for
/// smooth. Angles at the planet's centre are small enough to be added as in a plane.
int CityAir::elementsOf(const double altitude, const double fromCity, const double discRadius, Element* const elements) const
{
    const double R = profile_.planet().radius, h = std::max(altitude, lowestAltitude), r = R + h, radius = discRadius * R;
    int count = 0;
    const auto add = [&](double angle, double phi, double area) {
        const double half = std::sin(0.5 * angle), square = h * h + 4 * R * r * half * half, d = std::sqrt(square);
        const double sine = (h - 2 * r * half * half) / d;
        if (!(sine > 0) || !(area > 0))
            return;
        const double flat = R * std::sin(angle) / d;
        elements[count++] = {{flat * std::cos(phi), flat * std::sin(phi), -(h + 2 * R * half * half) / d}, d, sine, area * sine / square};
    };
    const double distance = std::hypot(h, std::max(0., fromCity - discRadius) * R);
    if (distance > 12 * radius) {
        add(fromCity, 0, pi * radius * radius);
        return count;
    }
    static const std::array<Quadrature, 5> rules{Quadrature{}, gaussLegendre(1), gaussLegendre(2), gaussLegendre(3), gaussLegendre(4)};
    if (distance > 1.2 * radius) {
        const int rings = distance > 3 * radius ? 2 : 3, spokes = distance > 3 * radius ? 5 : 8;
        for (int i = 0; i < rings; ++i) {
            const double from = discRadius * std::sqrt(0.5 + 0.5 * rules[rings].nodes[i]);
            for (int k = 0; k < spokes; ++k) {
                const double turn = 2 * pi * (k + 0.5 * i) / spokes;
                const double x = fromCity + from * std::cos(turn), y = from * std::sin(turn);
                add(std::hypot(x, y), std::atan2(y, x), pi * radius * radius * 0.5 * rules[rings].weights[i] / spokes);
            }
        }
        return count;
    }
    constexpr int azimuths = 10, distances = 4;
    const bool inside = fromCity < discRadius;
    const double widest = inside ? pi : std::asin(std::min(1., discRadius / fromCity));
    for (int a = 0; a < azimuths; ++a) {
        // Outside, phi = widest sin t makes the chord a smooth periodic function of t, for which equal steps are best.
        const double t = pi * ((a + 1.) / (azimuths + 1) - 0.5);
        const double phi = inside ? pi * (2 * (a + 0.5) / azimuths - 1) : widest * std::sin(t);
        const double weight = inside ? 2 * pi / azimuths : widest * std::cos(t) * pi / (azimuths + 1);
        const double middle = fromCity * std::cos(phi);
        const double side = std::sqrt(std::max(0., discRadius * discRadius - std::pow(fromCity * std::sin(phi), 2)));
        const double from = inside ? 0 : std::atan(std::max(0., middle - side) * R / h), to = std::atan((middle + side) * R / h);
        for (int k = 0; k < distances; ++k) {
            const double x = 0.5 * (from + to) + 0.5 * (to - from) * rules[distances].nodes[k];
            const double angle = h / R * std::tan(x), step = h / R / std::pow(std::cos(x), 2);
            add(angle, phi, R * R * std::sin(angle) * step * 0.5 * (to - from) * rules[distances].weights[k] * weight);
        }
    }
    return count;
}

void CityAir::meanDensities(const double altitude, const double sineAtGround, float* const result) const
{
    const int k = std::clamp(profile_.intervalAt(altitude), 0, static_cast<int>(altitudes_.size()) - 2);
    const float y = static_cast<float>(std::clamp((altitude - altitudes_[k]) / (altitudes_[k + 1] - altitudes_[k]), 0., 1.));
    static const double inverse = 1 / linkScale, whole = std::sinh(linkScale);
    const double t = std::clamp(std::asinh(sineAtGround * whole) * inverse, 0., 1.) * (linkElevations - 1);
    const int e = std::min(static_cast<int>(t), linkElevations - 2);
    const float x = static_cast<float>(t - e);
    const float* low = &links_[(size_t(k) * linkElevations + e) * species_];
    const float* high = low + size_t(linkElevations) * species_;
    for (int s = 0; s < species_; ++s) {
        const float below = low[s] + x * (low[species_ + s] - low[s]), above = high[s] + x * (high[species_ + s] - high[s]);
        result[s] = below + y * (above - below);
    }
}

void CityAir::scattered(const double altitude, const double fromCity, const double discRadius, const double mu, const double cosine,
                        const double sine, Scratch& scratch, float* const result) const
{
    std::fill(result, result + scatterers() * stride_, 0.F);
    Element elements[mostElements];
    const int count = elementsOf(altitude, fromCity, discRadius, elements);
    auto& [columns, sums, near, far] = scratch;
    columns.resize(species_);
    near.resize(scatterers());
    far.resize(scatterers());
    for (int k = 0; k < count; ++k) {
        const Element& e = elements[k];
        meanDensities(altitude, e.sineAtGround, columns.data());
        for (float& column : columns)
            column *= static_cast<float>(e.distance);
        const double nu = std::clamp(e.towards[0] * cosine + e.towards[1] * sine + e.towards[2] * mu, -1., 1.);
        const double t = std::cbrt(std::acos(nu) / pi) * (phaseAngles - 1);
        const int a = std::min(static_cast<int>(t), phaseAngles - 2);
        for (int i = 0; i < scatterers(); ++i) {
            near[i] = &phases_[(size_t(i) * phaseAngles + a) * stride_];
            far[i] = near[i] + stride_;
        }
        addElement(columns.data(), extinction_.data(), species_, near.data(), far.data(), static_cast<float>(t - a),
                   static_cast<float>(e.solidAngle), scatterers(), stride_, result);
    }
}

void CityAir::addHarmonics(const float* const moments, const float* const factors, Scratch& scratch, float* const result) const
{
    scratch.sums.resize(stride_);
    addTerms(moments, factors, lambdas_.data(), optics_.degree, scatterers(), stride_, scratch.sums.data(), result);
}

} // namespace sky::physics
