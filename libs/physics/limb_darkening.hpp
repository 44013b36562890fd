#pragma once
#include "physics/eclipse.hpp"
#include <vector>

namespace sky::physics {

/// A solar disc that is darker towards its limb: radiance ~ mu^alpha, mu the cosine of the angle to the Sun's surface
/// normal, with an exponent per wavelength.
///   source  Hestroffer & Magnan 1998, Astron. Astrophys. 333, 338: alpha = -0.023 + 0.292 um / wavelength from 417 to
///           1099 nm, -0.507 + 0.441 um / wavelength from 303 to 373 nm; joined linearly, and held beyond
class LimbDarkening
{
public:
    explicit LimbDarkening(const std::vector<double>& wavelengthsNm);

    /// Share of the disc's light that the Moon leaves, [wavelength]: exactly 1 outside, exactly 0 in totality.
    ///   error  < 1e-4 of the whole light: tests/physics/limb_darkening.cpp
    void visible(const Discs<double>& discs, double* result) const;

    /// Radiance at a distance from the disc's centre over its mean, [wavelength]; 0 <= distance <= 1, of the radius.
    void profile(double distance, double* result) const;

    static double exponent(double wavelengthNm);

private:
    std::vector<double> exponents_;
};

} // namespace sky::physics
