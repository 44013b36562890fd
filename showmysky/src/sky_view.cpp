#include "sky_view.hpp"

#include "base/lanes.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace {

enum class End { clamp, mirror };
enum class Content { zero, positive, mixed };

constexpr float dark = 1e-37f; ///< told from zero

Content contentOf(const std::vector<Texel>& texels)
{
    std::size_t zeros = 0;
    for (const Texel& texel : texels)
        for (const float value : texel)
            zeros += value > dark ? 0 : 1;
    return zeros == 0 ? Content::positive : zeros == 4 * texels.size() ? Content::zero : Content::mixed;
}

/// Catmull-Rom between `b` and `c`.
std::array<float, 4> cubicWeights(float t)
{
    return {0.5f * t * (-1 + t * (2 - t)), 1 + 0.5f * t * t * (-5 + 3 * t), 0.5f * t * (1 + t * (4 - 3 * t)), 0.5f * t * t * (t - 1)};
}

float interpolate(float a, float b, float c, float d, float t, const std::array<float, 4>& w)
{
    if (a > dark && b > dark && c > dark && d > dark)
        return std::exp(w[0] * std::log(a) + w[1] * std::log(b) + w[2] * std::log(c) + w[3] * std::log(d));
    return b + t * (c - b);
}

/// Interpolates `count` values (or their logarithms), `stride` apart, to `newCount`.
void resampleLine(const Texel* from, int count, std::size_t stride, Texel* to, int newCount, std::size_t newStride, End end,
                  bool logarithms)
{
    const auto at = [&](int i) -> Texel {
        if (end == End::mirror)
            i = i < 0 ? -i : i >= count ? 2 * (count - 1) - i : i;
        if (i >= 0 && i < count)
            return from[static_cast<std::size_t>(i) * stride];
        // Beyond an end: extrapolated linearly, in logarithms where possible, so that the slope there is one-sided.
        const Texel& edge = from[static_cast<std::size_t>(i < 0 ? 0 : count - 1) * stride];
        const Texel& inner = from[static_cast<std::size_t>(i < 0 ? 1 : count - 2) * stride];
        Texel result;
        for (std::size_t k = 0; k < 4; ++k)
            result[k] = logarithms ? 2 * edge[k] - inner[k] : inner[k] > 0 ? std::min(edge[k] / inner[k], 1e3f) * edge[k] : edge[k];
        return result;
    };
    for (int i = 0; i < newCount; ++i) {
        const float position = static_cast<float>(i) * static_cast<float>(count - 1) / static_cast<float>(newCount - 1);
        const int k = std::min(static_cast<int>(position), count - 2);
        const float t = position - static_cast<float>(k);
        const auto weights = cubicWeights(t);
        const Texel a = at(k - 1), b = at(k), c = at(k + 1), d = at(k + 2);
        Texel& out = to[static_cast<std::size_t>(i) * newStride];
        for (std::size_t x = 0; x < 4; ++x)
            out[x] = logarithms ? weights[0] * a[x] + weights[1] * b[x] + weights[2] * c[x] + weights[3] * d[x]
                                : interpolate(a[x], b[x], c[x], d[x], t, weights);
    }
}

} // namespace

ViewTable resampled(const ViewTable& table, int halfViews, int azimuths)
{
    if (table.empty() || (table.halfViews == halfViews && table.azimuths == azimuths))
        return table;
    ViewTable result(halfViews, azimuths);
    const auto stride = static_cast<std::size_t>(azimuths);
    const auto ofHalf = static_cast<std::size_t>(table.halfViews * table.azimuths);
    for (int half = 0; half < 2; ++half) {
        const Texel* first = &table.at(half * table.halfViews, 0);
        std::vector<Texel> from(first, first + ofHalf);
        const Content content = contentOf(from);
        if (content == Content::zero)
            continue;
        // Where nothing is zero one logarithm for each value is enough.
        const bool logarithms = content == Content::positive;
        if (logarithms)
            for (Texel& texel : from)
                for (float& value : texel)
                    value = std::log2(value);
        ViewTable wide(table.halfViews, azimuths);
        for (int v = 0; v < table.halfViews; ++v)
            resampleLine(&from[static_cast<std::size_t>(v * table.azimuths)], table.azimuths, 1, &wide.at(v, 0), azimuths, 1, End::mirror,
                         logarithms);
        for (int a = 0; a < azimuths; ++a)
            resampleLine(&wide.at(0, a), table.halfViews, stride, &result.at(half * halfViews, a), halfViews, stride, End::clamp,
                         logarithms);
        if (logarithms)
            for (std::size_t i = 0; i < static_cast<std::size_t>(halfViews) * stride; ++i)
                for (float& value : result.texels[static_cast<std::size_t>(half * halfViews) * stride + i])
                    value = sky::base::exp2Lane(value);
    }
    return result;
}

Texel sampled(const ViewTable& table, const double view, const int half, const double azimuth)
{
    const double v = std::clamp(view, 0., 1.) * (table.halfViews - 1), a = std::clamp(azimuth, 0., 1.) * (table.azimuths - 1);
    const int i = std::min(static_cast<int>(v), table.halfViews - 2), k = std::min(static_cast<int>(a), table.azimuths - 2);
    const auto y = static_cast<float>(v - i), x = static_cast<float>(a - k);
    const int row = half * table.halfViews + i;
    Texel result;
    for (std::size_t c = 0; c < 4; ++c) {
        const float low = table.at(row, k)[c] + x * (table.at(row, k + 1)[c] - table.at(row, k)[c]);
        const float high = table.at(row + 1, k)[c] + x * (table.at(row + 1, k + 1)[c] - table.at(row + 1, k)[c]);
        result[c] = low + y * (high - low);
    }
    return result;
}

ViewTable sum(const ViewTable& a, const ViewTable& b)
{
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    ViewTable result = a;
    for (std::size_t i = 0; i < result.texels.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            result.texels[i][c] += b.texels[i][c];
    return result;
}

ViewTable fromIncreasingElevation(const std::vector<Texel>& texels, int views, int azimuths)
{
    ViewTable result(views / 2, azimuths);
    for (int v = 0; v < views; ++v) {
        const int source = v < views / 2 ? views / 2 + v : views - 1 - v;
        std::copy_n(&texels[static_cast<std::size_t>(source * azimuths)], azimuths, &result.at(v, 0));
    }
    return result;
}

std::vector<double> viewSines(const sky::physics::Planet& planet, double altitude, int halfViews)
{
    const auto increasing = sky::physics::viewMuNodes(planet, altitude, 2 * halfViews);
    std::vector<double> result(increasing.begin() + halfViews, increasing.end());
    result.insert(result.end(), increasing.rend() - halfViews, increasing.rend());
    return result;
}

} // namespace showmysky
