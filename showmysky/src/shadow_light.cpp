#include "shadow_light.hpp"

#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

ShadowLight::ShadowLight(const physics::Shadow& shadow, const double reach, const physics::LimbDarkening* const law,
                         const std::vector<Texel>& weights)
    : shadow_(physics::singlePrecision(shadow)), nearest_(static_cast<float>(-reach)),
      perDepth_(static_cast<float>((depths - 1) / (2 * reach))), table_(static_cast<std::size_t>(depths * places))
{
    // Cones are straight: two depths give radius and slope.
    umbra_ = static_cast<float>(shadow.umbraRadius(0));
    umbraSlope_ = static_cast<float>((shadow.umbraRadius(reach) - shadow.umbraRadius(-reach)) / (2 * reach));
    penumbra_ = static_cast<float>(shadow.penumbraRadius(0));
    penumbraSlope_ = static_cast<float>((shadow.penumbraRadius(reach) - shadow.penumbraRadius(-reach)) / (2 * reach));
    std::array<double, 4> whole{};
    for (const Texel& weight : weights)
        for (std::size_t c = 0; c < 4; ++c)
            whole[c] += static_cast<double>(weight[c]);
    std::vector<double> spectrum(weights.size());
    for (int d = 0; d < depths; ++d) {
        const double depth = reach * (2. * d / (depths - 1) - 1);
        const double inner = std::max(0., shadow.umbraRadius(depth)), outer = shadow.penumbraRadius(depth);
        for (int k = 0; k < places; ++k) {
            const double t = double(k) / (places - 1), far = inner + (outer - inner) * t * t;
            if (k == 0 && inner > 0)
                continue; // not a photon, whatever rounding says
            // A point at that distance from the axis: the axis' own place, then aside.
            std::array<double, 3> point{};
            for (std::size_t i = 0; i < 3; ++i)
                point[i] = (shadow.axis[0] + far) * shadow.across[0][i] + shadow.axis[1] * shadow.across[1][i] + depth * shadow.along[i];
            const auto discs = shadow.discs(point);
            Texel& texel = table_[static_cast<std::size_t>(d * places + k)];
            if (!law) {
                texel.fill(static_cast<float>(physics::visibleFraction(discs)));
                continue;
            }
            law->visible(discs, spectrum.data());
            for (std::size_t c = 0; c < 4; ++c) {
                double sum = 0;
                for (std::size_t w = 0; w < spectrum.size(); ++w)
                    sum += static_cast<double>(weights[w][c]) * spectrum[w];
                texel[c] = static_cast<float>(whole[c] > 0 ? sum / whole[c] : 1);
            }
        }
    }
}

Texel ShadowLight::at(const std::array<float, 3>& point) const
{
    const float depth = shadow_.depthOf(point), far = shadow_.fromAxis(point);
    const float inner = std::max(0.f, umbra_ + umbraSlope_ * depth), outer = penumbra_ + penumbraSlope_ * depth;
    if (far >= outer)
        return {1, 1, 1, 1};
    const float level = std::clamp((depth - nearest_) * perDepth_, 0.f, static_cast<float>(depths - 1) - 1e-3f);
    const float place = std::sqrt(std::max(0.f, far - inner) / (outer - inner)) * (static_cast<float>(places - 1) - 1e-3f);
    const int d = static_cast<int>(level), k = static_cast<int>(place);
    const float y = level - static_cast<float>(d), x = place - static_cast<float>(k);
    const Texel *low = &table_[static_cast<std::size_t>(d * places + k)], *high = low + places;
    Texel result;
    for (std::size_t c = 0; c < 4; ++c) {
        const float a = low[0][c] + x * (low[1][c] - low[0][c]), b = high[0][c] + x * (high[1][c] - high[0][c]);
        result[c] = a + y * (b - a);
    }
    return result;
}

} // namespace showmysky
