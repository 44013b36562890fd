#pragma once
#include "physics/directions.hpp"
#include "solver/rays.hpp"
#include <array>
#include <vector>

namespace sky::solver {

/// Light scattered any number of times in air over which it is everywhere the same: as it would be were there one Sun for all places. It
/// knows no azimuths and of the harmonics the lowest, which are those that last: in deep air light spreads by diffusion, and what
/// horizontal differences, azimuths and higher harmonics add dies out within few events. So it tells what the events that follow will add
/// up to, up to a small rest (docs/deep-air.md): the operator that makes one event of another, taken level by level from the same rays, is
/// small enough to be inverted.
class LayeredLight
{
public:
    /// \param shape  [level][wavelength], > 0: how light goes with altitude, differences from which are what is interpolated
    /// \param straight  between two levels, so that light of a shape that is not known yet can't become negative; false: as the field is,
    /// where the shape is gentle. A chord bends at its ends: drawn between deep levels of a known shape, it takes light that nothing absorbs.
    LayeredLight(std::vector<double> shape, int wavelengths, int degree, bool straight);

    /// Harmonics that are kept, l = 0 .. degree().
    int degree() const { return degree_; }
    /// Rays of some levels, for later events.
    ///   directions  [level] of all levels: the rays start at `firstLevel`, direction by direction
    void add(const ScatteredRays& rays, const std::vector<physics::Directions>& directions, int firstLevel, int levels);
    /// Once all rays are there.
    void factorise();
    /// Adds to an event what follows from it, all events.
    ///   values  [level][l] of one wavelength and Sun, I_l0; then the downward irradiance of the ground
    void addFollowing(int wavelength, double* values) const;

    /// Bytes that the matrices of so many levels take.
    static double bytes(int levels, int wavelengths, int degree);

    int wavelengths() const { return wavelengths_; }
    int valueCount() const { return valueCount(levels_, degree_); }

private:
    static int valueCount(int levels, int degree) { return levels * (degree + 1) + 1; }
    std::array<double, 4> weightsAt(const ScatteredRays::FoldNode& node, int wavelength) const;

    std::vector<double> shape_; // [level][wavelength]
    bool straight_;
    int levels_, wavelengths_, degree_;
    /// [wavelength]: [row][column] of one minus the operator, relative to the shape; then its L and U.
    std::vector<std::vector<double>> matrices_;
    std::vector<std::vector<int>> pivots_; // [wavelength][row]
};

} // namespace sky::solver
