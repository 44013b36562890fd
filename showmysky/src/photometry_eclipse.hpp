#pragma once
// Photometric questions in an eclipse: light scattered once along many nodes, higher orders by the quotient of a local
// field.

#include "eclipse/field.hpp"
#include "photometry_model.hpp"
#include "showmysky/photometry.hpp"
#include <mutex>

namespace showmysky {

/// Const functions are thread-safe. The field of the last place of camera, Sun and Moon is kept.
class EclipsePhotometry
{
public:
    explicit EclipsePhotometry(const PhotometryModel& sky) : sky_(sky) {}

    /// Spectral radiance, W m^-2 sr^-1 nm^-1; without light pollution.
    void radiance(const Photometer::View& view, const Moon& moon, unsigned layers, double* result) const;
    /// Share of the disc's area that the Moon hides at the camera.
    double obscuration(const Photometer::View& view, const Moon& moon) const;

private:
    sky::physics::EclipseBodies bodiesOf(const Photometer::View& view, const Moon& moon) const;
    std::shared_ptr<const sky::eclipse::ScatteredField> fieldOf(const sky::physics::EclipseBodies& bodies) const;

    const PhotometryModel& sky_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const sky::eclipse::AirRays> air_;
    mutable std::shared_ptr<const sky::eclipse::ScatteredField> field_;
    mutable sky::physics::EclipseBodies known_{}; ///< whose field it is
};

} // namespace showmysky
