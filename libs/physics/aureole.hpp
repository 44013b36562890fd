#pragma once
// The aureole that is seen through truncated peaks: what they scatter time and again.

#include "physics/geometry.hpp"
#include "physics/optics.hpp"
#include "physics/ray.hpp"
#include <vector>

namespace sky::physics {

/// Truncation (delta-M scaling) takes light within a peak for light that went straight on, and single scattering with the exact phase function over
/// scaled depths (TMS) shows the peak once. But light that peaks scatter again and again on its way is thrown aside each time: beside a Sun behind a
/// scattering depth F into peaks, the peak p is its mean over all numbers of events, by Poisson's law. With f the truncated share, lambda_l the
/// moments of the phase function P and lambda'_l those of the scaled series, P of single scattering becomes
///
///   P - f p + f p_F,    q_l = (lambda_l - (1 - f) lambda'_l) / f of p,    (exp(F q_l) - 1) exp(-F) / F of p_F,
///
/// which is P where F is 0, and is made P far from the peak. source: the small-angle approximation of Goudsmit & Saunderson 1940, Phys. Rev. 57, 24, for the
/// peak alone; to the second event it is IMS of Nakajima & Tanaka 1988, J. Quant. Spectrosc. Radiat. Transfer 40, 51.
/// F is that between camera and Sun, beside which an aureole is seen, and at a scattering angle theta from it that of the highest view there: what is
/// seen far from a low Sun has come by shorter ways.
class Aureole
{
public:
    Aureole(const Medium& medium, const Optics& optics);

    /// Whether any peak is truncated: else nothing needs to be asked.
    bool any() const { return !tables_.empty(); }

    /// F of a camera, the cosine of the Sun's zenith angle there and a scattering angle (rad).
    ///   tracer    through the profile of the medium
    ///   altitude  of the camera, m, >= 0, inside the air or above it
    ///   returns   [wavelength]; empty where nothing is truncated
    std::vector<double> depths(RayTracer& tracer, double altitude, double muSun, double theta) const;

    /// The same for many questions, into memory that is kept: `columns` is scratch.
    void depths(RayTracer& tracer, double altitude, double muSun, double theta, std::vector<double>& columns,
                std::vector<double>& result) const;

    /// Multiplies the phase function of a species at scattering angle `theta` (rad) by what its aureole is over it.
    ///   depths  as told by `depths`; peaks of other species among them count as peaks of this one. Empty: no aureole
    ///   phase   [wavelength]
    void multiply(int species, double theta, const std::vector<double>& depths, double* phase) const;

private:
    void tabulate(const Medium& medium, const Optics& optics, int species, int wavelength, std::vector<float>& table) const;

    Planet planet_;
    int wavelengths_;
    std::vector<double> angles_;             ///< rad
    std::vector<double> peaks_;              ///< [species][wavelength], f times the scattering cross section, m^2
    std::vector<int> tableOf_;               ///< [species][wavelength]; -1: nothing truncated
    std::vector<std::vector<float>> tables_; ///< [depth][angle], logarithms of factors
};

} // namespace sky::physics
