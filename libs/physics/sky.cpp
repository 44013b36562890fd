#include "physics/sky.hpp"
#include "base/angles.hpp"
#include "physics/harmonics.hpp"
#include "physics/shadow_edge.hpp"
#include <algorithm>
#include <cmath>

namespace sky::physics {

using base::pi;

SkyEvaluator::SkyEvaluator(const Medium& medium, const Profile& profile, const Optics& optics, const SunTable& sun,
                           const Aureole* const aureole)
    : medium_(medium), profile_(profile), optics_(optics), sun_(sun), aureole_(aureole)
{
}

void SkyEvaluator::singleAlong(const RayNodes& ray, const double muSun, const double nu, const bool exactPhase, double* const result,
                               const std::vector<MiddleOfLight>& middles, const std::vector<double>& peakDepths) const
{
    const int wavelengths = optics_.wavelengths, scatterers = static_cast<int>(optics_.scatterers.size());
    std::vector<double> lit(scatterers * wavelengths, 0.), transmittance(wavelengths), phase(wavelengths);
    const auto visible = visibleAlong(sun_, ray, muSun, nu, medium_.sunAngularRadius);
    std::vector<double> whole(scatterers, 0.), aside(scatterers, 0.); // phase functions are taken at the mean of all nodes
    for (size_t k = 0; k < ray.nodes.size(); ++k) {
        const auto& node = ray.nodes[k];
        if (visible[k] <= 0)
            continue;
        sun_.opticalDepth(node.altitude, node.sunScale * muSun + node.nuScale * nu, transmittance.data(),
                          middles.empty() ? 0 : middles[k].rise);
        for (double& value : transmittance)
            value = visible[k] * std::exp(-value);
        for (int i = 0; i < scatterers; ++i)
            for (int w = 0; w < wavelengths; ++w)
                lit[i * wavelengths + w] += ray.weights[(k * scatterers + i) * wavelengths + w] * transmittance[w];
        if (middles.empty())
            continue;
        for (int i = 0; i < scatterers; ++i)
            for (int w = 0; w < wavelengths; ++w) {
                const double light = ray.weights[(k * scatterers + i) * wavelengths + w] * transmittance[w];
                whole[i] += light;
                aside[i] += light * middles[k].nu;
            }
    }
    std::vector<double> polynomials(optics_.degree + 1);
    legendre(optics_.degree, nu, polynomials.data());
    for (int i = 0; i < scatterers; ++i) {
        const int s = optics_.scatterers[i];
        if (exactPhase) {
            const double middle = whole[i] > 0 ? nu + aside[i] / whole[i] : nu;
            const double angle = std::acos(std::clamp(middle, -1., 1.));
            phaseFunctionAt(medium_, medium_.species[s], angle, phase.data());
            if (aureole_)
                aureole_->multiply(s, angle, peakDepths, phase.data());
            for (int w = 0; w < wavelengths; ++w)
                phase[w] /= 1 - optics_.truncation[s * wavelengths + w];
        } else {
            for (int w = 0; w < wavelengths; ++w) {
                phase[w] = 0;
                for (int l = 0; l <= optics_.degree; ++l)
                    phase[w] += (2 * l + 1) / (4 * pi) * optics_.moment(s, l, w) * polynomials[l];
            }
        }
        for (int w = 0; w < wavelengths; ++w)
            result[w] += lit[i * wavelengths + w] * phase[w];
    }
}

void SkyEvaluator::multipleAlong(const RayNodes& ray, const Moments& moments, const double muSun, const double nu,
                                 double* const result) const
{
    const int wavelengths = optics_.wavelengths, scatterers = static_cast<int>(optics_.scatterers.size());
    const int degree = moments.degree;
    std::vector<double> field(harmonicCount(degree) * wavelengths), factors(harmonicCount(degree)), azimuthal(wavelengths);
    for (size_t k = 0; k < ray.nodes.size(); ++k) {
        const auto& node = ray.nodes[k];
        const double muSunNode = std::clamp(node.sunScale * muSun + node.nuScale * nu, -1., 1.);
        moments.interpolate(node.altitude, muSunNode, field.data());
        harmonicFactors(degree, node.mu, factors.data());
        const double sines = std::sqrt(std::max(0., (1 - node.mu * node.mu) * (1 - muSunNode * muSunNode)));
        const double cosine = sines > 1e-12 ? std::clamp((nu - node.mu * muSunNode) / sines, -1., 1.) : 1.;
        double chebyshev = 1, previous = cosine; // cos(m phi), cos((m-1) phi)
        for (int m = 0; m <= degree; ++m) {
            for (int l = m; l <= degree; ++l) {
                const double* moment = &field[harmonicIndex(l, m) * wavelengths];
                const double factor = chebyshev * factors[harmonicIndex(l, m)];
                for (int i = 0; i < scatterers; ++i) {
                    const double* weight = &ray.weights[(k * scatterers + i) * wavelengths];
                    const double* lambda = &optics_.moments[(optics_.scatterers[i] * (degree + 1) + l) * wavelengths];
                    for (int w = 0; w < wavelengths; ++w)
                        result[w] += weight[w] * lambda[w] * moment[w] * factor;
                }
            }
            const double next = 2 * cosine * chebyshev - previous;
            previous = chebyshev;
            chebyshev = next;
        }
    }
}

void SkyEvaluator::radiance(RayTracer& tracer, const Moments* const moments, const double altitude, const double mu, const double muSun,
                            const double nu, const Parts& parts, double* const result) const
{
    std::fill(result, result + optics_.wavelengths, 0.);
    const bool ground = hitsGround(profile_.planet(), altitude, mu);
    if (parts.single)
        singleAlong(tracer.trace(altitude, mu, profile_.forShadows(parts.singleNodes, medium_.sunAngularRadius), ground), muSun, nu,
                    parts.exactPhase, result, {},
                    aureole_ && parts.exactPhase ? aureole_->depths(tracer, altitude, muSun, std::acos(std::clamp(nu, -1., 1.)))
                                                 : std::vector<double>{});
    if (parts.multiple && moments)
        multipleAlong(tracer.trace(altitude, mu, parts.multipleNodes, ground, NodesFor::Field), *moments, muSun, nu, result);
}

} // namespace sky::physics
