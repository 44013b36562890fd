#pragma once
// The Sun: a uniform disc at infinity. Averages over it count each point by its solid angle.

#include "montecarlo/geometry.hpp"
#include "montecarlo/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace sky::montecarlo {

class SunDisc
{
public:
    SunDisc(Vec centre, double angularRadius) : centre_(centre), radius_(angularRadius) {}

    Vec centre() const { return centre_; }
    bool isPoint() const { return radius_ < 1e-9; }
    double solidAngle() const
    {
        const double s = std::sin(0.5 * radius_);
        return 4 * std::numbers::pi * s * s;
    }

    /// A point of the disc, uniform in solid angle, from two random numbers in [0, 1).
    Vec point(double u1, double u2) const
    {
        const double half = std::sqrt(u1) * std::sin(0.5 * radius_); // sin of half the distance from the centre
        const double cosine = 1 - 2 * half * half, sine = 2 * half * std::sqrt(1 - half * half);
        return turned(centre_, cosine, sine, 2 * std::numbers::pi * u2);
    }

    /// Average of f(direction) over the disc, f = 0 below the horizon of `place`. The edge of the horizon is met
    /// exactly, so the rules integrate a smooth function.
    template<class F>
    double average(double planetRadius, const Place& place, const Rule& across, const Rule& along, F&& f) const
    {
        const double x = radialSquare(planetRadius, place.altitude);
        const double horizonMu = -std::sqrt(x) / (planetRadius + place.altitude);
        if (isPoint())
            return dot(place.up, centre_) >= horizonMu ? f(centre_) : 0.0;
        // Angle v along the vertical circle through the centre, upwards; angle u across it.
        const Vec horizontal = cross(centre_, place.up);
        const Vec sideways = length(horizontal) > 1e-12 ? normalized(horizontal) : perpendicular(centre_);
        const Vec upwards = cross(sideways, centre_);
        const double zenithAngle = angleBetween(place.up, centre_);
        double sum = 0;
        for (std::size_t i = 0; i < across.node.size(); ++i) {
            // u = radius sin t makes the half chord a smooth function of t.
            const double t = 0.5 * std::numbers::pi * across.node[i];
            const double u = radius_ * std::sin(t);
            const double squared = std::sin(0.5 * (radius_ + u)) * std::sin(0.5 * (radius_ - u)) / std::cos(u);
            const double halfChord = 2 * std::asin(std::sqrt(squared));
            const double horizon = zenithAngle - std::acos(std::max(-1.0, horizonMu / std::cos(u)));
            const double low = std::max(-halfChord, horizon);
            if (low >= halfChord)
                continue;
            const double scale = 0.5 * (halfChord - low);
            double chord = 0;
            for (std::size_t k = 0; k < along.node.size(); ++k) {
                const double v = low + scale * (1 + along.node[k]);
                chord += along.weight[k] * f(std::cos(u) * (std::cos(v) * centre_ + std::sin(v) * upwards) + std::sin(u) * sideways);
            }
            sum += across.weight[i] * 0.5 * std::numbers::pi * radius_ * std::cos(t) * std::cos(u) * scale * chord;
        }
        return sum / solidAngle();
    }

private:
    Vec centre_;
    double radius_;
};

} // namespace sky::montecarlo
