#pragma once
// The atmosphere at one wavelength as the random paths see it.

#include "montecarlo/crowded_bins.hpp"
#include "montecarlo/glow.hpp"
#include "montecarlo/phase.hpp"
#include "montecarlo/profile.hpp"
#include "physics/medium.hpp"

#include <memory>
#include <mutex>
#include <vector>

namespace sky::montecarlo {

/// Coefficients at one altitude.
struct Local {
    double extinction = 0;          ///< 1/m, all species
    double bright = 0;              ///< sum of scattering coefficient times integral of the phase function, 1/m
    std::vector<double> scattering; ///< [scattering species], 1/m
};

/// Where light of the Sun is likely: the transmittance towards its disc from the middle of each shell, by the sine of its elevation above
/// the horizon there. It only guides where collisions are sampled, so its resolution is of no consequence for the mean.
class Guide
{
public:
    Guide(const Profile& profile, double sunAngularRadius);
    double operator()(int shell, double aboveHorizon) const
    {
        return transmittance_[static_cast<std::size_t>(shell * bins_.count() + bins_.of(aboveHorizon))];
    }

private:
    CrowdedBins<4> bins_;
    std::vector<double> transmittance_;
};

class Air
{
public:
    Air(const physics::Medium& medium, int wavelength);

    const Profile& profile() const { return profile_; }
    const Guide& guide() const { return guide_; }
    /// Made when it is first asked for; from any thread.
    const Glow& glow() const;
    const PhaseTable& phase(std::size_t species) const { return phases_[species]; }
    double groundAlbedo() const { return groundAlbedo_; }
    double sunAngularRadius() const { return sunAngularRadius_; }

    /// Part of the extinction in a shell that is scattering, with the integrals of phase functions in it. Events are sampled by it: more than
    /// zero wherever anything in the shell scatters.
    double scatteredShare(int shell) const { return scatteredShare_[static_cast<std::size_t>(shell)]; }

    /// Fills `local` for an altitude, straight from the tables.
    void at(double altitude, Local& local) const;
    /// Emission coefficient per unit irradiance from one direction: sum of scattering times phase function, 1/(m sr).
    double scatteredAt(const Local& local, double angle) const;
    /// Transmittance from a place towards a direction, 0 where the ground is in the way.
    double transmittance(const Place& place, Vec direction) const;

private:
    struct Kind {
        std::vector<double> logDensity, density;
        double extinction = 0, scattering = 0; // m^2
        bool scatters = false;
    };
    Profile profile_;
    Guide guide_;
    mutable std::once_flag glowOnce_;
    mutable std::unique_ptr<Glow> glow_;
    double groundAlbedo_, sunAngularRadius_;
    std::vector<double> altitudes_;
    std::vector<std::size_t> guideToInterval_;
    std::vector<Kind> kinds_;
    std::vector<PhaseTable> phases_; // of the kinds that scatter, in their order
    std::vector<double> scatteredShare_;
};

} // namespace sky::montecarlo
