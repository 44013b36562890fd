#include "physics/directions.hpp"
#include "physics/quadrature.hpp"

namespace sky::physics {

Directions directionsAt(const Planet& planet, const double altitude, const MomentSettings& settings)
{
    const double horizon = horizonMu(planet, altitude);
    Directions all;
    const auto panel = [&](int count, double from, double to, bool ground) {
        if (!(to > from) || count < 1)
            return;
        const auto rule = gaussLegendre(count, from, to);
        all.mu.insert(all.mu.end(), rule.nodes.begin(), rule.nodes.end());
        all.weight.insert(all.weight.end(), rule.weights.begin(), rule.weights.end());
        all.hitsGround.insert(all.hitsGround.end(), rule.nodes.size(), ground);
    };
    panel(settings.groundDirections, -1, horizon, true);
    panel(settings.limbDirections, horizon, 0, false);
    panel(settings.skyDirections, 0, 1, false);
    return all;
}

} // namespace sky::physics
