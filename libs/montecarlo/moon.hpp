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

    /// A random point of what the Moon leaves of the disc, and by how much its light counts: by the share that is left of its chord towards the
    /// Moon's centre, which is 0 where nothing is.
    struct Left {
        Vec point;
        double share;
    };
    Left pointLeft(Vec position, double u1, double u2) const
    {
        const SunDisc disc = sunFrom(position);
        const Vec point = disc.point(u1, u2);
        if (disc.isPoint())
            return {point, hides(position, point) ? 0. : 1.};
        const Chords chords(*this, position, disc.centre());
        const double u = std::asin(std::clamp(dot(point, chords.sideways), -1., 1.)), half = halfChord(u);
        const Arc hidden = chords.hidden(u);
        const double near = std::max(0., std::min(half, hidden.low) + half), far = std::max(0., half - std::max(-half, hidden.high));
        if (!(near + far > 0) || !(half > 0))
            return {point, 0};
        // The point's own place along the chord, on what is left of that.
        const double v = std::atan2(dot(point, chords.towards), dot(point, chords.centre));
        const double along = std::clamp(0.5 * (v / half + 1), 0., 1.) * (near + far);
        return {chords.at(u, along < near ? along - half : half - (near + far - along)), 0.5 * (near + far) / half};
    }

    /// A guess at how bright the Sun is, never 0: only guides samples.
    double guess(Vec position) const
    {
        const Vec toMoon = moon_ - position;
        const double apart = angleBetween(normalized(toMoon), normalized(sun_ - position));
        const double moon = moonRadius_ / length(toMoon), inner = moon - sunAngularRadius_;
        const double shown = std::clamp((apart - inner) / (2 * sunAngularRadius_ + 1e-9), 1e-3, 1.0);
        return shown * std::sqrt(shown); // as a crescent grows
    }

    /// Average over the disc of f(direction), f = 0 where the Moon or the ground is in the way.
    ///   rule  for each stretch across the disc and for what is seen of each chord
    template<class F>
    double average(double planetRadius, const Place& place, const Rule& rule, F&& f) const
    {
        const Vec position = (planetRadius + place.altitude) * place.up;
        const SunDisc disc = sunFrom(position);
        if (disc.isPoint())
            return hides(position, disc.centre()) || dot(place.up, disc.centre()) < horizonCosine(planetRadius, place) ? 0.0
                                                                                                                       : f(disc.centre());
        const Chords chords(*this, position, disc.centre());
        const double crossing = limbCrossing(chords);
        // u = radius sin t makes half a chord a smooth function of t. The limbs cross at t = crossing, chords beyond t
        // = widest pass the Moon by.
        const double moonSine = std::sqrt((1 - chords.moonCosine) * (1 + chords.moonCosine));
        const double widest = std::asin(std::min(1.0, std::asin(moonSine) / sunAngularRadius_));
        std::array<double, 6> bounds{-0.5 * std::numbers::pi, -crossing, -widest, widest, crossing, 0.5 * std::numbers::pi};
        std::sort(bounds.begin(), bounds.end());
        double sum = 0;
        for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
            const double half = 0.5 * (bounds[part + 1] - bounds[part]);
            for (std::size_t i = 0; half > 1e-9 && i < rule.node.size(); ++i) {
                const double t = bounds[part] + half * (1 + rule.node[i]), u = sunAngularRadius_ * std::sin(t);
                const double reach = halfChord(u);
                const Arc sky = chords.within(u, place.up, horizonCosine(planetRadius, place)), hidden = chords.hidden(u);
                const double low = std::max(-reach, sky.low), high = std::min(reach, sky.high);
                double seen = 0;
                const auto add = [&](double from, double to) {
                    const double scale = 0.5 * (to - from);
                    for (std::size_t k = 0; scale > 0 && k < rule.node.size(); ++k)
                        seen += rule.weight[k] * scale * f(chords.at(u, from + scale * (1 + rule.node[k])));
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
    double halfChord(double u) const
    {
        const double squared = std::sin(0.5 * (sunAngularRadius_ + u)) * std::sin(0.5 * (sunAngularRadius_ - u)) / std::cos(u);
        return 2 * std::asin(std::sqrt(std::max(0., squared)));
    }
    /// Chords of the disc that run towards the Moon's centre: angle v along them, u across.
    struct Chords {
        Vec centre, moon, sideways, towards;
        double moonCosine;
        Chords(const Eclipse& eclipse, Vec position, Vec sunCentre)
            : centre(sunCentre), moon(normalized(eclipse.moon_ - position)),
              moonCosine(std::cos(std::asin(std::min(1.0, eclipse.moonRadius_ / length(eclipse.moon_ - position)))))
        {
            const Vec across = cross(centre, moon);
            sideways = length(across) > 1e-12 ? normalized(across) : perpendicular(centre);
            towards = cross(sideways, centre);
        }
        Vec at(double u, double v) const { return std::cos(u) * (std::cos(v) * centre + std::sin(v) * towards) + std::sin(u) * sideways; }
        Arc hidden(double u) const { return within(u, moon, moonCosine); }
        /// The v of a chord whose directions stand within the cap of this cosine around `axis`.
        Arc within(double u, Vec axis, double cosine) const
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
    };
    /// Angle t, 0 .. pi/2, of the point of the Sun's limb that the Moon's limb meets, by bisection; 0 if there is none.
    double limbCrossing(const Chords& chords) const
    {
        const auto hidden = [&](double w) { // w from the side of the Moon around the limb
            const Vec limb = std::cos(sunAngularRadius_) * chords.centre +
                             std::sin(sunAngularRadius_) * (std::cos(w) * chords.towards + std::sin(w) * chords.sideways);
            return dot(limb, chords.moon) >= chords.moonCosine;
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
