#include "physics/ray.hpp"
#include "base/lanes.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace sky::physics {

namespace {

/// Light of a part of a cell, shared out among the nodes on both its sides.
///   column                         of one scatterer in the cell, m^-2; centre of its density, 0..1
///   scattering, seen, shift        [wavelength]: cross-section, m^2; mean transmittance to the viewer; shift of the light's centre
///   near, far                      [wavelength]: weights of the nodes, added to
SKY_WIDEST_VECTORS
void shareOut(const PartLight<double>& part, double column, double centreOfDensity, const double* __restrict scattering,
              const double* __restrict seen, const double* __restrict shift, int wavelengths, double* __restrict near,
              double* __restrict far)
{
    for (int w = 0; w < wavelengths; ++w) {
        const double weight = column * scattering[w] * seen[w];
        const double centre = std::clamp(centreOfDensity + shift[w], 0., 1.);
        const double slope = std::clamp(6 * centre - 3, -1., 1.);
        const auto light = part.of<double>({slope, centre - 0.5 - slope / 6});
        const double beyond = std::clamp(light.far, 0., light.share);
        near[w] += (light.share - beyond) * weight;
        far[w] += beyond * weight;
    }
}

/// RayTracer::pass, once the optical depths are known.
SKY_WIDEST_VECTORS
void passCell(const double* __restrict tau, int wavelengths, double* __restrict transmittance, double* __restrict mean,
              double* __restrict shift)
{
    for (int w = 0; w < wavelengths; ++w) {
        const double lost = -base::expm1Lane(-tau[w]), depth = tau[w] > 1e-9 ? tau[w] : 1, part = tau[w] > 1e-9 ? lost : 1;
        const double thick = 1 / depth - (1 - lost) / part - 0.5;
        shift[w] = tau[w] > 1e-3 ? thick : -tau[w] / 12;
        mean[w] = transmittance[w] * (tau[w] > 1e-9 ? lost / depth : 1 - 0.5 * tau[w]);
        transmittance[w] = transmittance[w] * (1 - lost);
    }
}

} // namespace

RayTracer::RayTracer(const Profile& profile, const Optics& optics, const double cellScale)
    : profile_(profile), underEdges_(profile.withShellsUnderEdges()), optics_(optics)
{
    limits_.steepness *= cellScale;
    limits_.length *= cellScale;
    limits_.depth *= cellScale;
    for (int s = 0; s < optics.species; ++s) {
        const auto begin = optics.extinction.begin() + s * optics.wavelengths;
        maxExtinction_.push_back(*std::max_element(begin, begin + optics.wavelengths));
        minExtinction_.push_back(*std::min_element(begin, begin + optics.wavelengths));
    }
}

void RayTracer::walk(const Profile& profile, const double h, const double mu, const bool hitsGround, const CellLimits& limits,
                     const double deepest)
{
    const auto& p = profile.planet();
    const auto& shells = profile.shells();
    const double r = p.radius + h;
    const double length = hitsGround ? distanceToGround(p, h, mu) : distanceToTop(p, h, mu);
    const int species = profile.speciesCount();
    bounds_.assign(1, 0);
    altitudes_.assign(1, h);
    columns_.clear();
    centres_.clear();
    halvings_.clear();
    if (!(length > 0))
        return;

    std::vector<double> n(species), m(species);
    int k = profile.intervalAt(h);
    bool down = mu < 0;
    if (down && h <= shells[k] && k > 0)
        --k;
    double s0 = 0, passed = 0;
    const double perigee = -r * mu;
    while (s0 < length) {
        double s1;
        int next = k;
        bool turn = false;
        if (down) {
            const double crossing = distanceToShell(p, h, mu, shells[k], true);
            if (crossing >= 0 && (hitsGround || (k > 0 && crossing < perigee))) { // rounding must not end the horizon's ray
                s1 = crossing;
                next = k - 1;
            } else {
                s1 = perigee;
                turn = true;
            }
            if (hitsGround && k == 0)
                s1 = length;
        } else {
            s1 = distanceToShell(p, h, mu, shells[k + 1], false);
            next = k + 1;
            if (k + 2 >= static_cast<int>(shells.size()))
                s1 = length;
        }
        s1 = std::clamp(s1, s0, length);
        if (s1 > s0) {
            const double h0 = altitudeAlong(p, h, mu, s0), h1 = altitudeAlong(p, h, mu, s1);
            Stretch stretch{s0, s1, length, profile.steepness(k) * std::abs(h1 - h0), 0, 0};
            if (std::isfinite(limits.depth)) {
                profile.densities(k, 0.5 * (h0 + h1), n.data());
                profile.densities(k, h0, m.data());
                for (int s = 0; s < species; ++s) {
                    stretch.depth += n[s] * maxExtinction_[s] * (s1 - s0);
                    stretch.near += m[s] * maxExtinction_[s] * (s1 - s0);
                }
            }
            const CellDivision division = divided(stretch, limits);
            const int cells = division.count();
            for (int c = 1; c <= cells; ++c) {
                const double a = bounds_.back(), b = c == cells ? s1 : division.end(c);
                const double offset = 0.5 * (b - a) / std::sqrt(3.), middle = 0.5 * (a + b);
                profile.densities(k, altitudeAlong(p, h, mu, middle - offset), n.data());
                profile.densities(k, altitudeAlong(p, h, mu, middle + offset), m.data());
                for (int s = 0; s < species; ++s) {
                    const double both = n[s] + m[s];
                    columns_.push_back(0.5 * (b - a) * both);
                    passed += columns_.back() * minExtinction_[s];
                    centres_.push_back(0.5 + (both > 0 ? 0.5 / std::sqrt(3.) * (m[s] - n[s]) / both : 0));
                }
                bounds_.push_back(b);
                altitudes_.push_back(altitudeAlong(p, h, mu, b));
                halvings_.push_back(profile.halvings(k) * std::abs(altitudes_.back() - altitudes_[altitudes_.size() - 2]) /
                                    (shells[k + 1] - shells[k]));
                if (passed > deepest)
                    return;
            }
        }
        s0 = s1;
        if (turn)
            down = false;
        else
            k = next;
        if (k < 0 || k + 1 >= static_cast<int>(shells.size()))
            break;
    }
}

RayCells RayTracer::cells(const double altitude, const double mu, const bool hits, const double deepest)
{
    walk(underEdges_, altitude, mu, hits, limits_, deepest);
    return {altitude, mu, hits, bounds_, altitudes_, columns_, centres_};
}

void RayTracer::columns(const double altitude, const double mu, double* const result, const double deepest)
{
    CellLimits limits = limits_;
    limits.depth = std::numeric_limits<double>::infinity(); // nobody looks into a cell
    walk(profile_, altitude, mu, false, limits, deepest);
    const int species = profile_.speciesCount();
    std::fill(result, result + species, 0.);
    for (size_t i = 0; i < columns_.size(); ++i)
        result[i % species] += columns_[i];
}

void RayTracer::pass(const int cell, double* const tau, double* const transmittance, double* const mean, double* const shift) const
{
    const int wavelengths = optics_.wavelengths, species = optics_.species;
    std::fill(tau, tau + wavelengths, 0.);
    for (int s = 0; s < species; ++s)
        for (int w = 0; w < wavelengths; ++w)
            tau[w] += columns_[cell * species + s] * optics_.extinction[s * wavelengths + w];
    passCell(tau, wavelengths, transmittance, mean, shift);
}

SeenColumns RayTracer::seen(const double altitude, const double mu, const bool hits)
{
    walk(underEdges_, altitude, mu, hits, limits_);
    const int wavelengths = optics_.wavelengths, species = optics_.species;
    const int cells = static_cast<int>(bounds_.size()) - 1, scatterers = static_cast<int>(optics_.scatterers.size());
    SeenColumns result{bounds_, std::vector<double>(size_t(cells + 1) * scatterers * wavelengths, 0.), {}, {}};
    std::vector<double> transmittance(wavelengths, 1.), tau(wavelengths), mean(wavelengths), shift(wavelengths);
    result.transmittance = transmittance;
    result.transmittance.reserve(size_t(cells + 1) * wavelengths);
    for (int c = 0; c < cells; ++c) {
        pass(c, tau.data(), transmittance.data(), mean.data(), shift.data());
        for (int i = 0; i < scatterers; ++i) {
            const int s = optics_.scatterers[i];
            const size_t at = (size_t(c) * scatterers + i) * wavelengths;
            for (int w = 0; w < wavelengths; ++w)
                result.seen[at + size_t(scatterers) * wavelengths + w] =
                    result.seen[at + w] + columns_[c * species + s] * optics_.scattering[s * wavelengths + w] * mean[w];
        }
        result.transmittance.insert(result.transmittance.end(), transmittance.begin(), transmittance.end());
    }
    result.groundTransmittance.assign(wavelengths, 0.);
    if (hits)
        result.groundTransmittance = transmittance;
    return result;
}

RayNodes RayTracer::trace(const double altitude, const double mu, const int count, const bool hits, const NodesFor nodesFor)
{
    walk(underEdges_, altitude, mu, hits, limits_);
    const auto& p = profile_.planet();
    const double r = p.radius + altitude;
    const int wavelengths = optics_.wavelengths, species = optics_.species;
    const int scatterers = static_cast<int>(optics_.scatterers.size());
    const int cells = static_cast<int>(bounds_.size()) - 1;
    const double length = bounds_.back();

    // What each cell contributes: sum over species of sigma_sca N T (1 - exp(-tau)) / tau, the exact mean over the cell.
    std::vector<double> tau(wavelengths), seen(cells * wavelengths);
    std::vector<NodeShares> shares(cells);
    // A cell's light comes from its centre of density, shifted towards the viewer by attenuation (in lengths of the cell).
    std::vector<double> shift(cells * wavelengths);
    std::vector<double> transmittance(wavelengths, 1.);
    for (int c = 0; c < cells; ++c) {
        const double* column = &columns_[c * species];
        double* mean = &seen[c * wavelengths];
        double scattered = 0;
        pass(c, tau.data(), transmittance.data(), mean, &shift[size_t(c) * wavelengths]);
        for (const int s : optics_.scatterers)
            for (int w = 0; w < wavelengths; ++w)
                scattered += column[s] * optics_.scattering[s * wavelengths + w] * mean[w];
        const double way = bounds_[c + 1] - bounds_[c], slant = way > 0 ? std::abs(altitudes_[c + 1] - altitudes_[c]) / way : 0;
        const double depthAlong = std::accumulate(tau.begin(), tau.end(), 0.) / wavelengths;
        shares[c] = {scattered,    std::abs(horizonDistance(p, altitudes_[c + 1]) - horizonDistance(p, altitudes_[c])),
                     way,          depthAlong * slant,
                     halvings_[c], depthAlong};
    }

    std::vector<double> measured, position;
    const NodeShares whole = weighedAsSeen(shares);
    placeNodes(bounds_, shares, NodeMeasure(whole, nodesFor), count, measured, position);

    const auto nodeAt = [&](double s) {
        const double h = altitudeAlong(p, altitude, mu, s), rNode = p.radius + h;
        return RayNodes::Node{h, r / rNode, s / rNode, std::clamp((r * mu + s) / rNode, -1., 1.)};
    };
    RayNodes result;
    result.nodes.reserve(count);
    for (const double s : position)
        result.nodes.push_back(nodeAt(s));
    result.weights.assign(count * scatterers * wavelengths, 0.);
    cutAtNodes(bounds_, position, parts_);
    for (const CellPart& part : parts_) {
        const PartLight<double> partLight(part);
        for (int i = 0; i < scatterers; ++i) {
            const int c = part.cell, s = optics_.scatterers[i];
            if (!(columns_[c * species + s] > 0)) // layers end, and where many are given most don't reach a given cell
                continue;
            double* const near = &result.weights[(part.node * scatterers + i) * wavelengths];
            shareOut(partLight, columns_[c * species + s], centres_[c * species + s], &optics_.scattering[s * wavelengths],
                     &seen[c * wavelengths], &shift[size_t(c) * wavelengths], wavelengths, near, near + scatterers * wavelengths);
        }
    }
    result.hitsGround = hits;
    result.ground = nodeAt(length);
    result.groundTransmittance.assign(wavelengths, 0.);
    if (hits)
        result.groundTransmittance = transmittance;
    return result;
}

} // namespace sky::physics
