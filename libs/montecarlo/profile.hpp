#pragma once
// Extinction of the air at one wavelength, arranged for exact optical depths along straight rays.

#include "montecarlo/geometry.hpp"
#include "physics/medium.hpp"

#include <array>
#include <vector>

namespace sky::montecarlo {

/// The part of a ray inside one shell.
struct Segment {
    double begin = 0, end = 0; ///< distances from the start of the ray, m
    double opticalDepth = 0;
    int shell = 0;
};

/// The part of a ray inside the atmosphere.
struct Leg {
    std::vector<Segment> segments;
    double opticalDepth = 0;
    double length = 0; ///< m; to the ground or to the top of the atmosphere
    bool hitsGround = false;
};

/// The atmosphere as a few dozen concentric shells, in each of which the extinction is a polynomial of degree 5 in
/// X = r^2 - R^2. As X is quadratic along a ray, its integral over a shell is a polynomial too, and Gauss' rule with
/// 6 nodes has no error. The polynomials are least-square fits that keep the shell's vertical integral.
/// Where a species begins or ends, so does a shell: a dense one would leave the fit no sign of a thin one beside it.
///   error   of an optical depth against the tables: 1e-6 relative where they are smooth; tests/montecarlo/profile.cpp
class Profile
{
public:
    Profile(const physics::Medium& medium, int wavelength);

    double planetRadius() const { return planetRadius_; }
    double topOfAtmosphere() const { return topOfAtmosphere_; }
    int shellCount() const { return static_cast<int>(shells_.size()); }
    double middleAltitude(int shell) const;
    std::array<double, 2> altitudesOf(int shell) const; ///< of its lower and its upper end, m

    /// Extinction coefficient at an altitude, from the fits, 1/m.
    double extinction(double altitude) const;
    /// Optical depth from a place inside the atmosphere to space; the ray must miss the ground.
    double opticalDepthToSpace(const Ray& ray) const;
    /// All segments of the ray up to the ground or to space. Reuses the storage of `leg`.
    void trace(const Ray& ray, Leg& leg) const;
    /// Optical depth from segment.begin to `s` inside the segment.
    double partialDepth(const Ray& ray, const Segment& segment, double s) const;
    /// Distance at which the optical depth counted from segment.begin reaches `depth`.
    double distanceAt(const Ray& ray, const Segment& segment, double depth) const;

private:
    static constexpr int terms = 6;
    struct Shell {
        double low, high;                // X, m^2
        double middle, inverseHalf;      // y = (X - middle) * inverseHalf is in [-1, 1]
        std::array<double, terms> power; // extinction = sum power[k] y^k
        double value(double x) const;
        double integral(const Ray& ray, double begin, double end) const;
    };
    struct Sample {
        double x, beta, weight; // Gauss nodes inside the intervals of the tables
    };
    /// \param edges  among the stations, which no shell reaches over; the last one is the top
    void fit(const std::vector<double>& stations, const std::vector<Sample>& samples, const std::vector<std::size_t>& edges,
             double tolerance);
    int shellAt(double x) const;
    template<class Visit>
    void walk(const Ray& ray, Visit&& visit) const;

    double planetRadius_;
    double topOfAtmosphere_;
    std::vector<Shell> shells_;
};

} // namespace sky::montecarlo
