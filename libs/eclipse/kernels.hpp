#pragma once
// The inner loops of a sweep: over all points of one level, for one group of wavelengths.

#include "eclipse/grid.hpp"
#include "eclipse/lane.hpp"
#include <algorithm>

namespace sky::eclipse {

/// Real harmonics of a degree, all azimuths: of each l first cos(0), then cos(m phi), sin(m phi) of m = 1 .. l. Those of a lower
/// degree come first.
constexpr int allHarmonics(int degree) { return (degree + 1) * (degree + 1); }

/// Levels that are seen together.
struct Seen {
    std::vector<const Lane*> levels; ///< of [point][harmonic], moments
    int degree;                      ///< of these, at least that of the turn
    const Lane* coefficients;        ///< [level][lm]: lambda_l and what else multiplies the harmonic (l, m)
    int terms;                       ///< lm of a level
};

/// Scattered light of some levels that leaves the points towards each azimuth of the turn, at one zenith angle, to the turn's degree.
///   planes  [azimuth][point], written
void radiate(const Turn& turn, const Seen& seen, int points, Lane* planes);

/// Moments of the light that arrives at the points from one zenith angle, to the turn's degree: adds to `moments`.
///   planes   [azimuth][point]: radiance;  factors  [lm];  weight  solid angle of all azimuths together
///   rings    [point] or null: gets the mean radiance times `weight` times `cosine` added, an irradiance
void project(const Turn& turn, const Lane* planes, const float* factors, float weight, int points, Lane* moments, Lane* rings,
             float cosine);

/// Shifts of a plane of points by one distance in all azimuths of a turn: where each point of `to` finds itself on `from`.
class Shifts
{
public:
    /// \param distance  m
    Shifts(const Grid& from, const Grid& to, const Turn& turn, float distance);
    /// [point along], [point across] of `to`
    const Neighbours* along(int azimuth) const
    {
        return &along_[static_cast<std::size_t>(std::min(azimuth, azimuths_ - 1 - azimuth) * columns_)];
    }
    const Neighbours* across(int azimuth) const;
    int azimuths() const { return azimuths_; }
    int columns() const { return columns_; }
    int rows() const { return rows_; }

private:
    int azimuths_, columns_, rows_;
    std::vector<Neighbours> along_, across_; ///< [half of the azimuths][point]: two azimuths each share a shift along, and across
};

/// Adds the plane, shifted towards one azimuth, to `sums`, [target points].
///   plane, mirror  [source points]: this azimuth, and what its mirror image sees;  row  scratch, [source points along]
void addShifted(const Shifts& shifts, int azimuth, int sourceAlong, const Lane* plane, const Lane* mirror, Lane* row, Lane* sums);
/// The same towards all azimuths, for a plane of light that looks alike from all sides.
///   sums   [azimuth], each after `stride`: [target points]
///   moved  scratch, [source points across][target points along]
void addShiftedToAll(const Shifts& shifts, const Grid& source, const Lane* plane, Lane* moved, Lane* sums, int stride);

/// Where light of a level comes from: factors of cos(m phi), then of sin(m phi), m >= 1, at one point.
///   lower, upper  [harmonic], moments at the levels below and above; `share` of the way between them
///   coefficients  [lm], as in Seen;  terms  [2 degree + 1], written
void foldPoint(int degree, const Lane* lower, const Lane* upper, float share, const Lane* coefficients, Lane* terms);
/// Light in a direction from between `count` folded points: `weights` of each; `mirrored` swaps the sides. Adds to `sum`.
void addFolded(int degree, int count, const Lane* const* terms, const float* weights, const bool* mirrored, const float* cosines,
               const float* sines, Lane& sum);

/// Sets `plane`, [point], to the sum over `count` levels, [point] each, times `weights`, each after `stride`.
///   returns  false, and sets nothing, if all weights are 0
bool mix(const Lane* const* levels, int count, const Lane* weights, int stride, int points, Lane* plane);

/// Sets `plane`, [point], to the sum over scatterers of `light`, [scatterer][point], times the phase function at `nu`, [point].
///   phase  [scatterer][degree + 1]
void scatterSunlight(int degree, int scatterers, const Lane* phase, const float* nu, const Lane* light, int points, Lane* plane);

} // namespace sky::eclipse
