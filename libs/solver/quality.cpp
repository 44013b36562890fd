#include "solver/quality.hpp"
#include "base/error.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace sky::solver {

namespace {

/// Legendre moments below this don't show.
constexpr double negligibleMoment = 1e-4;

/// Smallest degree that holds all of every phase function, or `most`.
int neededDegree(const physics::Medium& medium, int most)
{
    int needed = 0;
    for (const auto& species : medium.species) {
        if (!species.scatters() || *std::max_element(species.singleScatteringAlbedo.begin(), species.singleScatteringAlbedo.end()) <= 0)
            continue;
        for (int w = 0; w < (species.achromatic ? 1 : medium.wavelengthCount()); ++w) {
            const auto moments = physics::phaseMoments(medium, species, w, most);
            for (int l = most; l > needed; --l)
                if (std::abs(moments[l]) > negligibleMoment) {
                    needed = l;
                    break;
                }
        }
    }
    return needed;
}

} // namespace

Quality qualityFor(const std::string& name, const physics::Medium& medium)
{
    Quality q;
    auto& m = q.moments;
    if (name == "draft") {
        m = {12, 24, 3, 4, 3, 6, 4, 48, 8, true};
        q.bake = {20, 8, 2};
    } else if (name == "normal") {
        m = {14, 28, 5, 7, 4, 8, 6, 64, 10, true};
        q.bake = {32, 10, 3};
    } else if (name == "fine") {
        m = {24, 48, 8, 8, 6, 12, 10, 160, 20, true};
        q.bake = {80, 24, 4};
    } else if (name == "reference") {
        m = {40, 80, 12, 12, 10, 20, 16, 192, 40, true};
        q.bake = {160, 48, 6};
    } else {
        throw UsageError("--quality is \"" + name + "\"; expected draft, normal, fine or reference.");
    }
    // A peak worth truncating is worth more harmonics, and directions that resolve them.
    const auto optics = physics::makeOptics(medium, m.degree, true);
    if (*std::max_element(optics.truncation.begin(), optics.truncation.end(), std::less<>()) > 0 && m.degree < 12) {
        m.degree *= 2;
        m.groundDirections += 2;
        m.skyDirections += 4;
        m.azimuths = std::max(m.azimuths, m.degree + 2);
    }
    m.degree = std::min(m.degree, neededDegree(medium, m.degree));
    return q;
}

} // namespace sky::solver
