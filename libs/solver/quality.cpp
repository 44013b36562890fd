#include "solver/quality.hpp"
#include "base/error.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>

namespace sky::solver {

namespace {

/// Legendre moments below this don't show.
constexpr double negligibleMoment = 1e-4;

/// Smallest degree, up to `most`, above which no species' Legendre moments matter.
///   tolerance  0: moments count by themselves; else by the share of light that the species scatters along the vertical
int neededDegree(const physics::Medium& medium, int most, double tolerance)
{
    int needed = 0;
    for (const auto& species : medium.species) {
        if (!species.scatters())
            continue;
        const double column = physics::verticalColumn(medium, species);
        for (int w = 0; w < medium.wavelengthCount(); ++w) {
            const double depth = column * species.extinctionCrossSection[w] * species.singleScatteringAlbedo[w];
            if (!(depth > 0) || (w > 0 && species.achromatic && tolerance == 0))
                continue;
            const double weight = tolerance > 0 ? std::min(1., depth) / tolerance : 1 / negligibleMoment;
            const auto moments = physics::phaseMoments(medium, species, w, most);
            for (int l = most; l > needed; --l)
                if (std::abs(moments[l]) * weight > 1) {
                    needed = l;
                    break;
                }
        }
    }
    return needed;
}

} // namespace

Quality qualityFor(const std::string& name, const physics::Medium& medium, const double tolerance)
{
    Quality q;
    auto& m = q.moments;
    if (name == "draft") {
        m = {12, 24, 3, 4, 3, 6, 4, 48, 8, true};
        q.bake = {20, 8, 2};
    } else if (name == "normal") {
        m = {14, 28, 5, 7, 4, 8, 6, 64, 10, true};
        q.bake = {64, 10, 3};
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
    const bool truncated = std::any_of(optics.truncation.begin(), optics.truncation.end(), [](double f) { return f > 0; });
    if (truncated) {
        m.degree = std::max(12, 2 * m.degree);
        m.groundDirections += 2;
        m.skyDirections += 4;
        m.azimuths = std::max(m.azimuths, m.degree + 2);
    }
    m.degree = neededDegree(medium, m.degree, tolerance);
    return q;
}

} // namespace sky::solver
