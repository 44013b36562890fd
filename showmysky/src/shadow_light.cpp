#include "shadow_light.hpp"

#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;

ShadowLight::ShadowLight(const physics::Shadow& shadow, const double reach, const physics::LimbDarkening* const law,
                         const std::vector<Texel>& weights)
    : shadow_(physics::singlePrecision(shadow)), nearest_(static_cast<float>(-reach)),
      perDepth_(static_cast<float>((depths - 1) / (2 * reach))), table_(static_cast<std::size_t>(depths * places)), middles_(table_.size())
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
            float& middle = middles_[static_cast<std::size_t>(d * places + k)];
            if (k == 0 && inner > 0) {
                middle = static_cast<float>(std::asin(shadow.sunRadius / shadow.sunAlong)); // the limb
                continue;                                                                   // not a photon, whatever rounding says
            }
            // A point at that distance from the axis: the axis' own place, then aside.
            std::array<double, 3> point{};
            for (std::size_t i = 0; i < 3; ++i)
                point[i] = (shadow.axis[0] + far) * shadow.across[0][i] + shadow.axis[1] * shadow.across[1][i] + depth * shadow.along[i];
            const auto discs = shadow.discs(point);
            middle = static_cast<float>(physics::middleOfVisible(discs));
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

ShadowLight::Place ShadowLight::placeOf(const std::array<float, 3>& point) const
{
    const float depth = shadow_.depthOf(point), far = shadow_.fromAxis(point);
    const float inner = std::max(0.f, umbra_ + umbraSlope_ * depth), outer = penumbra_ + penumbraSlope_ * depth;
    if (far >= outer)
        return {nullptr, nullptr, 0, 0, far};
    const float level = std::clamp((depth - nearest_) * perDepth_, 0.f, static_cast<float>(depths - 1) - 1e-3f);
    const float place = std::sqrt(std::max(0.f, far - inner) / (outer - inner)) * (static_cast<float>(places - 1) - 1e-3f);
    const int d = static_cast<int>(level), k = static_cast<int>(place);
    const Texel* low = &table_[static_cast<std::size_t>(d * places + k)];
    return {low, low + places, place - static_cast<float>(k), level - static_cast<float>(d), far};
}

Texel ShadowLight::between(const Place& place)
{
    if (!place.low)
        return {1, 1, 1, 1};
    Texel result;
    for (std::size_t c = 0; c < 4; ++c) {
        const float a = place.low[0][c] + place.x * (place.low[1][c] - place.low[0][c]);
        const float b = place.high[0][c] + place.x * (place.high[1][c] - place.high[0][c]);
        result[c] = a + place.y * (b - a);
    }
    return result;
}

Texel ShadowLight::at(const std::array<float, 3>& point) const { return between(placeOf(point)); }

ShadowLight::Seen ShadowLight::seen(const std::array<float, 3>& point) const
{
    const Place place = placeOf(point);
    Seen result{between(place), {}};
    if (!place.low || result.share[1] <= 0 || place.far <= 0)
        return result;
    const float *low = &middles_[static_cast<std::size_t>(place.low - table_.data())], *high = low + places;
    const float a = low[0] + place.x * (low[1] - low[0]), b = high[0] + place.x * (high[1] - high[0]);
    const float middle = (a + place.y * (b - a)) / place.far;
    for (std::size_t k = 0; k < 2; ++k) { // away from the axis
        const float along = middle * (shadow_.dot(shadow_.across[k], point) - shadow_.axis[k]);
        for (std::size_t i = 0; i < 3; ++i)
            result.aside[i] += along * shadow_.across[k][i];
    }
    return result;
}

} // namespace showmysky
