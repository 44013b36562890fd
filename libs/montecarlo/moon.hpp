#pragma once
// The Moon before the Sun: both are spheres at finite distances, and a ray of sunlight is hidden if it meets the Moon.
// Nothing is said here of overlapping areas: shares of the disc come out of samples and chords alone.

#include "montecarlo/sun.hpp"

#include <algorithm>
#include <array>

namespace sky::montecarlo {

/// Positions are from the planet's centre, m.
class Eclipse
{
public:
    Eclipse(Vec sun, Vec moon, double moonRadius, double sunAngularRadius)
        : sun_(sun), moon_(moon), moonRadius_(moonRadius), sunAngularRadius_(sunAngularRadius)
    {
    }

    /// The Sun's disc for one place.
    SunDisc sunFrom(Vec position) const { return {normalized(sun_ - position), sunAngularRadius_}; }

    /// True if the Moon stands in the way of a ray towards the Sun.
    bool hides(Vec position, Vec direction) const
    {
        const Vec toMoon = moon_ - position;
        return dot(toMoon, direction) > 0 && length(cross(toMoon, direction)) < moonRadius_;
    }

    /// A guess at how bright the Sun is, never 0: only guides samples.
    double guess(Vec position) const
    {
        const Vec toMoon = moon_ - position;
        const double apart = angleBetween(normalized(toMoon), normalized(sun_ - position));
        const double moon = moonRadius_ / length(toMoon), inner = moon - sunAngularRadius_;
        return std::clamp((apart - inner) / (2 * sunAngularRadius_ + 1e-9), 0.01, 1.0);
    }

    /// Average over the disc of f(direction), f = 0 where the Moon or the ground is in the way.
    ///   rule  for each stretch across the disc and for what is seen of each chord
    template<class F>
    double average(double planetRadius, const Place& place, const Rule& rule, F&& f) const
    {
        const Vec position = (planetRadius + place.altitude) * place.up;
        const SunDisc disc = sunFrom(position);
        const Vec centre = disc.centre(), moon = normalized(moon_ - position);
        if (disc.isPoint())
            return hides(position, centre) || dot(place.up, centre) < horizonCosine(planetRadius, place) ? 0.0 : f(centre);
        // Chords run towards the Moon's centre: angle v along them, u across.
        const Vec across = cross(centre, moon);
        const Vec sideways = length(across) > 1e-12 ? normalized(across) : perpendicular(centre);
        const Vec towards = cross(sideways, centre);
        const double moonCosine = std::cos(std::asin(std::min(1.0, moonRadius_ / length(moon_ - position))));
        const double crossing = limbCrossing(centre, towards, sideways, moon, moonCosine);
        // u = radius sin t makes half a chord a smooth function of t. The limbs cross at t = crossing, chords beyond t
        // = widest pass the Moon by.
        const double moonSine = std::sqrt((1 - moonCosine) * (1 + moonCosine));
        const double widest = std::asin(std::min(1.0, std::asin(moonSine) / sunAngularRadius_));
        std::array<double, 6> bounds{-0.5 * std::numbers::pi, -crossing, -widest, widest, crossing, 0.5 * std::numbers::pi};
        std::sort(bounds.begin(), bounds.end());
        double sum = 0;
        for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
            const double half = 0.5 * (bounds[part + 1] - bounds[part]);
            for (std::size_t i = 0; half > 1e-9 && i < rule.node.size(); ++i) {
                const double t = bounds[part] + half * (1 + rule.node[i]), u = sunAngularRadius_ * std::sin(t);
                const double squared = std::sin(0.5 * (sunAngularRadius_ + u)) * std::sin(0.5 * (sunAngularRadius_ - u)) / std::cos(u);
                const double halfChord = 2 * std::asin(std::sqrt(squared));
                const auto chord = [&](double v) {
                    return std::cos(u) * (std::cos(v) * centre + std::sin(v) * towards) + std::sin(u) * sideways;
                };
                const Arc sky = arcWithin(u, centre, towards, sideways, place.up, horizonCosine(planetRadius, place));
                const Arc hidden = arcWithin(u, centre, towards, sideways, moon, moonCosine);
                const double low = std::max(-halfChord, sky.low), high = std::min(halfChord, sky.high);
                double seen = 0;
                const auto add = [&](double from, double to) {
                    const double scale = 0.5 * (to - from);
                    for (std::size_t k = 0; scale > 0 && k < rule.node.size(); ++k)
                        seen += rule.weight[k] * scale * f(chord(from + scale * (1 + rule.node[k])));
                };
                add(low, std::min(high, hidden.low));
                add(std::max(low, hidden.high), high);
                sum += rule.weight[i] * half * sunAngularRadius_ * std::cos(t) * std::cos(u) * seen;
            }
        }
        return sum / disc.solidAngle();
    }

private:
    struct Arc {
        double low, high; ///< empty: both beyond the end of every chord
    };
    static double horizonCosine(double planetRadius, const Place& place)
    {
        return -std::sqrt(radialSquare(planetRadius, place.altitude)) / (planetRadius + place.altitude);
    }
    /// The v of a chord whose directions stand within the cap of this cosine around `axis`.
    static Arc arcWithin(double u, Vec centre, Vec towards, Vec sideways, Vec axis, double cosine)
    {
        const double x = dot(axis, centre), y = dot(axis, towards), amplitude = std::cos(u) * std::hypot(x, y);
        const double rest = cosine - std::sin(u) * dot(axis, sideways);
        if (rest >= amplitude)
            return {4, 4};
        if (rest <= -amplitude)
            return {-4, 4};
        const double middle = std::atan2(y, x), half = std::acos(rest / amplitude);
        return {middle - half, middle + half};
    }
    /// Angle t, 0 .. pi/2, of the point of the Sun's limb that the Moon's limb meets, by bisection; 0 if there is none.
    double limbCrossing(Vec centre, Vec towards, Vec sideways, Vec moon, double moonCosine) const
    {
        const auto hidden = [&](double w) { // w from the side of the Moon around the limb
            const Vec limb =
                std::cos(sunAngularRadius_) * centre + std::sin(sunAngularRadius_) * (std::cos(w) * towards + std::sin(w) * sideways);
            return dot(limb, moon) >= moonCosine;
        };
        double in = 0, out = std::numbers::pi;
        if (!hidden(in) || hidden(out))
            return 0;
        for (int i = 0; i < 40; ++i)
            (hidden(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
        return in < 0.5 * std::numbers::pi ? in : std::numbers::pi - in;
    }

    Vec sun_, moon_;
    double moonRadius_, sunAngularRadius_;
};

} // namespace sky::montecarlo
