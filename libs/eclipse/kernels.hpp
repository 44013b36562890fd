#pragma once
// The inner loops of a sweep: over all points of one level, for one group of wavelengths.

#include "eclipse/grid.hpp"
#include "eclipse/lane.hpp"

namespace sky::eclipse {

/// Real harmonics of a degree, all azimuths: first cos(m phi) of each (l, m) as physics::harmonicIndex, then sin(m phi) of each
/// (l, m >= 1) in the same order.
constexpr int allHarmonics(int degree) { return (degree + 1) * (degree + 1); }

/// Scattered light that leaves the points of a level towards each azimuth of the turn, at one zenith angle.
///   lower, upper  [point][harmonic], moments at the levels below and above; `share` of the way between them
///   coefficients  [lm]: lambda_l and what else multiplies the harmonic (l, m)
///   planes        [azimuth][point], written
void radiate(const Turn& turn, const Lane* lower, const Lane* upper, float share, const Lane* coefficients, int points, Lane* planes);

/// Moments of the light that arrives at the points from one zenith angle: adds to `moments`.
///   planes   [azimuth][point]: radiance;  factors  [lm];  weight  solid angle of all azimuths together
///   rings    [point] or null: gets the mean radiance times `weight` times `cosine` added, an irradiance
void project(const Turn& turn, const Lane* planes, const float* factors, float weight, int points, Lane* moments, Lane* rings,
             float cosine);

/// A shift of a plane of points: where each point of `to` finds itself on `from`.
struct Shift {
    std::vector<Neighbours> along, across;
    Shift() = default;
    /// \param x, y the shift, m
    Shift(const Grid& from, const Grid& to, float x, float y);
};

/// Adds to `sums`, [addend][target points], the shifted plane times `weights`, [addend]; the plane alone if `weights` is null.
///   plane, mirror  [source points]: this azimuth, and what its mirror image sees;  row  scratch, [source points along]
void addShifted(const Shift& shift, int sourceAlong, const Lane* plane, const Lane* mirror, const Lane* weights, int addends, Lane* row,
                Lane* sums);

/// Where light of a level comes from: factors of cos(m phi), then of sin(m phi), m >= 1, at one point.
///   lower, upper  [harmonic];  terms  [2 degree + 1], written; else as radiate()
void foldPoint(int degree, const Lane* lower, const Lane* upper, float share, const Lane* coefficients, Lane* terms);
/// Light in a direction from between `count` folded points: `weights` of each; `mirrored` swaps the sides. Adds to `sum`.
void addFolded(int degree, int count, const Lane* const* terms, const float* weights, const bool* mirrored, const float* cosines,
               const float* sines, Lane& sum);

/// upper share + lower (1 - share).
void mix(const Lane* lower, const Lane* upper, float share, int points, Lane* result);

/// Sets `plane`, [point], to the sum over scatterers of `light`, [scatterer][point], times the phase function at `nu`, [point].
///   phase  [scatterer][degree + 1]
void scatterSunlight(int degree, int scatterers, const Lane* phase, const float* nu, const Lane* light, int points, Lane* plane);

} // namespace sky::eclipse
