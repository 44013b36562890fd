#pragma once
// Sun, Moon and the shadow between them, seen from any point of the air, with the full parallax of both.
//
// Everything is measured from the shadow's axis, the line through both centres (Bessel's fundamental plane: Explanatory
// Supplement to the Astronomical Almanac, 2013, ch. 11). Both discs then stand on one line through the axis, and the
// angle between them is a small quantity that no subtraction of large ones makes: float is good to a metre of the
// shadow's place. Points are in the frame of the camera: x North, y West, z zenith, origin at the camera, metres.

#include "physics/geometry.hpp"
#include <array>

namespace sky::physics {

/// Nominal mean radius of the Moon, m. source: IAU 2015, Archinal et al. 2018.
constexpr double meanMoonRadius = 1737.4e3;

/// Where the bodies stand for a camera. Directions are unit vectors in its frame.
struct EclipseBodies {
    Planet planet{};
    double cameraAltitude = 0; ///< m, >= 0
    std::array<double, 3> sunDirection{0, 0, 1};
    std::array<double, 3> moonDirection{0, 0, 1};
    double sunDistance = 149597870700.; ///< m, from the planet's centre
    double moonDistance = 384400e3;     ///< m, from the planet's centre
    double sunAngularRadius = 0;        ///< rad, at the camera
    double moonRadius = meanMoonRadius; ///< m
};

/// Two discs in the sky; angles in rad.
template<class Real>
struct Discs {
    Real sunRadius, moonRadius, separation;
};

namespace eclipse_detail {

/// x - sin x, 0 <= x <= 2 pi, without cancellation.
template<class Real>
Real withoutSine(Real x)
{
    if (x > Real(1))
        return x - std::sin(x);
    const Real q = x * x;
    return x * q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72 * (1 - q / 110 * (1 - q / 156 * (1 - q / 210))))));
}

/// Twice the arctangent of sqrt(a / b), for a, b >= 0 up to rounding.
template<class Real>
Real twiceAngle(Real a, Real b)
{
    return 2 * std::atan2(std::sqrt(std::max(Real(0), a)), std::sqrt(std::max(Real(0), b)));
}

} // namespace eclipse_detail

/// Share of the Sun's disc that the Moon hides: 0 from outside contact on, 1 in totality, relatively exact for slivers.
///   error  8 roundings; both discs are taken as flat: their radii squared, 2e-5 of what is hidden
template<class Real>
Real coveredFraction(const Discs<Real>& discs);

/// Share that is left: exactly 1 outside, exactly 0 in totality, and relatively exact for a thin lune.
template<class Real>
Real visibleFraction(const Discs<Real>& discs);

/// How far the middle of what the Moon leaves of an even disc stands from the Sun's centre, away from the Moon's, rad; 0 where it leaves nothing. Its
/// light comes through the air from there.
template<class Real>
Real middleOfVisible(const Discs<Real>& discs);

namespace eclipse_detail {

/// Angles of the triangle of both centres and a point where the limbs cross. With a, b the radii, d the separation:
/// atSun, atMoon are half the arcs that lie in the other disc, between is the angle of the limbs.
template<class Real>
struct Triangle {
    Real atSun, atMoon, between;
    Triangle(Real a, Real b, Real d)
    {
        // Twice (s - a), (s - b), (s - d), s of the half-angle formulas; s the half perimeter.
        const Real all = a + b + d, sa = d + (b - a), sb = d - (b - a), sd = (a + b) - d;
        atSun = twiceAngle(sa * sd, all * sb);
        atMoon = twiceAngle(sb * sd, all * sa);
        between = twiceAngle(sa * sb, all * sd);
    }
};

/// Share hidden where the limbs cross: two circular segments, of the same sign.
template<class Real>
Real coveredByLens(Real a, Real b, Real d)
{
    const Triangle<Real> t(a, b, d);
    const Real ratio = b / a;
    return (withoutSine(2 * t.atSun) + ratio * ratio * withoutSine(2 * t.atMoon)) / (2 * Real(3.14159265358979323846));
}

/// Share left where the limbs cross. The area a^2 g + a b sin g - (b^2 - a^2) m, g between the limbs and m at the Moon,
/// loses its digits in a thin lune; with a sin(m + g) = b sin m its first-order terms cancel by hand and leave
/// a^2 (g - sin g) + a (a + b) (2 sin g sin^2(m/2) + 2 sin^2(g/2) sin m) - (b^2 - a^2) (m - sin m).
template<class Real>
Real leftByLune(Real a, Real b, Real d)
{
    const Triangle<Real> t(a, b, d);
    const Real g = t.between, m = t.atMoon, ratio = b / a;
    const Real halfG = std::sin(g / 2), halfM = std::sin(m / 2);
    const Real area = withoutSine(g) + (1 + ratio) * 2 * (std::sin(g) * halfM * halfM + halfG * halfG * std::sin(m)) -
                      (b - a) / a * (1 + ratio) * withoutSine(m);
    return std::max(Real(0), area / Real(3.14159265358979323846));
}

template<class Real>
struct Shares {
    Real covered, left; // both to their own digits
};

template<class Real>
Shares<Real> shares(const Discs<Real>& discs)
{
    const Real a = discs.sunRadius, b = discs.moonRadius, d = discs.separation;
    if (d >= a + b)
        return {0, 1};
    if (d <= b - a)
        return {1, 0};
    if (d <= a - b)
        return {std::min(Real(1), b / a * (b / a)), (a - b) / a * ((a + b) / a)};
    const Real covered = coveredByLens(a, b, d);
    if (covered < Real(0.5))
        return {covered, 1 - covered};
    const Real left = leftByLune(a, b, d);
    return {std::min(Real(1), 1 - left), left};
}

} // namespace eclipse_detail

template<class Real>
Real coveredFraction(const Discs<Real>& discs)
{
    return eclipse_detail::shares(discs).covered;
}

template<class Real>
Real visibleFraction(const Discs<Real>& discs)
{
    return eclipse_detail::shares(discs).left;
}

/// The first moment of the lens about the Sun's centre: those of both segments about their own centres cancel (both are 2/3 of the cube of half the
/// chord), and what is left is the Moon's segment times the separation. What is hidden and what is left balance.
template<class Real>
Real middleOfVisible(const Discs<Real>& discs)
{
    const Real a = discs.sunRadius, b = discs.moonRadius, d = discs.separation;
    if (d >= a + b || d <= b - a)
        return 0;
    const Real left = visibleFraction(discs), ratio = b / a;
    const Real segment =
        ratio * ratio *
        (d <= a - b ? Real(1)
                    : eclipse_detail::withoutSine(2 * eclipse_detail::Triangle<Real>(a, b, d).atMoon) / (2 * Real(3.14159265358979323846)));
    return left > 0 ? std::min(a, d * segment / left) : Real(0);
}

/// What a point sees of the Sun.
template<class Real>
struct VisibleSun {
    Real share;                ///< of the disc, 0..1, the horizon not counted
    std::array<Real, 3> aside; ///< of the middle of its light from the Sun's centre, rad, in the camera's frame
};

/// The shadow for one camera. `double` where it is made, `float` where many points are asked.
template<class Real>
struct ShadowOf {
    std::array<Real, 3> along{};     ///< unit vector of the axis, from the Moon to the Sun
    std::array<Real, 3> across[2]{}; ///< the fundamental plane
    std::array<Real, 2> axis{};      ///< where the axis meets that plane, m from the camera
    Real moonAlong = 0;              ///< the Moon's centre on the axis, m from the camera
    Real sunAlong = 0;
    Real moonRadius = 0, sunRadius = 0; ///< m

    /// Distance from the axis, m.
    Real fromAxis(const std::array<Real, 3>& p) const
    {
        const Real x = axis[0] - dot(across[0], p), y = axis[1] - dot(across[1], p);
        return std::sqrt(x * x + y * y);
    }
    /// The discs as seen from a point. One that the Moon lies behind sees none of it: moonRadius 0, separation pi.
    Discs<Real> discs(const std::array<Real, 3>& p) const
    {
        const Real depth = dot(along, p), toMoon = moonAlong - depth, toSun = sunAlong - depth;
        const Real far = fromAxis(p), sunSlope = far / toSun;
        const Real sun = std::asin(std::min(Real(1), sunRadius / (toSun * std::sqrt(1 + sunSlope * sunSlope))));
        if (!(toMoon > 0))
            return {sun, 0, Real(3.14159265358979323846)};
        // tan(a - b) of the two slopes, as a product.
        const Real slope = far / toMoon, ratio = toMoon / toSun;
        return {sun, std::asin(std::min(Real(1), moonRadius / (toMoon * std::sqrt(1 + slope * slope)))),
                std::atan2(slope * (1 - ratio), 1 + slope * slope * ratio)};
    }
    /// Share of the Sun's disc that the Moon leaves, 0..1, the horizon not counted.
    Real visible(const std::array<Real, 3>& p) const { return visibleFraction(discs(p)); }

    /// The same with where its light comes from.
    VisibleSun<Real> visibleSun(const std::array<Real, 3>& p) const
    {
        const Discs<Real> seen = discs(p);
        VisibleSun<Real> sun{visibleFraction(seen), {}};
        const Real x = dot(across[0], p) - axis[0], y = dot(across[1], p) - axis[1], far = std::sqrt(x * x + y * y);
        if (!(far > 0) || !(sun.share < 1))
            return sun;
        // The Moon is off the Sun towards the axis.
        const Real middle = middleOfVisible(seen) / far;
        for (std::size_t i = 0; i < 3; ++i)
            sun.aside[i] = middle * (x * across[0][i] + y * across[1][i]);
        return sun;
    }

    /// Radius of the penumbra where a plane across the axis goes through a point at `depth` along it; of the umbra,
    /// negative beyond its tip (an annular eclipse).
    Real penumbraRadius(Real depth) const { return coneRadius(sunRadius + moonRadius, moonRadius, depth); }
    Real umbraRadius(Real depth) const { return -coneRadius(sunRadius - moonRadius, -moonRadius, depth); }
    Real depthOf(const std::array<Real, 3>& p) const { return dot(along, p); }

    static Real dot(const std::array<Real, 3>& a, const std::array<Real, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

private:
    /// Cone around both spheres: sine of its half-angle is `sum` over the distance of the centres.
    Real coneRadius(Real sum, Real moon, Real depth) const
    {
        const Real sine = sum / (sunAlong - moonAlong), cosine = std::sqrt(1 - sine * sine);
        return (moon + (moonAlong - depth) * sine) / cosine;
    }
};
using Shadow = ShadowOf<double>;

/// The shadow of these bodies.
///   throws  RangeError where the Moon's surface touches the air or encloses the camera, or doesn't stand before the
///   Sun
Shadow makeShadow(const EclipseBodies& bodies);

/// The same, for many points.
ShadowOf<float> singlePrecision(const Shadow& shadow);

/// Where the axis meets the ground.
struct GroundShadow {
    bool central = false;          ///< the axis meets the ground; all below is of that place
    std::array<double, 3> place{}; ///< in the camera's frame, m
    double sunElevation = 0;       ///< rad
    double umbraRadius = 0;        ///< m, across the axis; along it longer by 1 / sin(sunElevation); < 0: annular
    double penumbraRadius = 0;     ///< m, across the axis
};
GroundShadow groundShadow(const Shadow& shadow, const EclipseBodies& bodies);

/// Position of a body at `distance` from the planet's centre, seen in a direction: in the camera's frame, m.
std::array<double, 3> placeOfBody(const Planet& planet, double cameraAltitude, const std::array<double, 3>& direction, double distance);

} // namespace sky::physics
