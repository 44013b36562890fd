#pragma once
// A medium with a grid of moments as coarse as a software driver likes, to iterate on.

#include "physics/source_iteration.hpp"
#include "solver/iterate.hpp"

namespace sky::test {

struct SmallWorld {
    physics::Medium medium;
    physics::MomentSettings settings;
    physics::Profile profile;
    physics::Optics optics;
    physics::SunTable sun;
    physics::MomentGrid grid;
    SmallWorld(physics::Medium m, const physics::MomentSettings& s)
        : medium(std::move(m)), settings(s), profile(medium), optics(physics::makeOptics(medium, s.degree, s.truncatePeaks)),
          sun(profile, optics, medium.sunAngularRadius, 48, 64), grid(profile, largest(), s.altitudes, s.suns)
    {
    }
    SmallWorld(const SmallWorld&) = delete;
    solver::Scene scene() const { return {medium, profile, optics, sun}; }
    physics::Moments twin(int events) const
    {
        return iterateSource(medium, profile, optics, sun, grid, settings, events, solver::sweepRefinement);
    }

private:
    std::vector<double> largest() const
    {
        std::vector<double> sigma(optics.species, 0.);
        for (int s = 0; s < optics.species; ++s)
            for (int w = 0; w < optics.wavelengths; ++w)
                sigma[s] = std::max(sigma[s], optics.extinction[s * optics.wavelengths + w]);
        return sigma;
    }
};

/// Coarse, for a software driver: what is compared are two ways to compute the same sums.
inline physics::MomentSettings smallSettings(int degree)
{
    physics::MomentSettings s;
    s.altitudes = 6;
    s.suns = 28;
    s.degree = degree;
    s.groundDirections = 3;
    s.limbDirections = 2;
    s.skyDirections = 4;
    s.azimuths = degree + 1;
    s.directNodes = 16;
    s.nodes = 8;
    return s;
}

} // namespace sky::test
