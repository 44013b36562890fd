#include "eclipse_sky.hpp"

#include "base/angles.hpp"
#include "base/parallel.hpp"
#include "physics/table_axes.hpp"
#include <algorithm>
#include <cmath>

namespace showmysky {

namespace physics = sky::physics;
namespace eclipse = sky::eclipse;

namespace {

using sky::base::pi;
/// Directions in which the light of higher orders is asked: it is smooth.
constexpr int ratioHalfViews = 10, ratioAzimuths = 16;
constexpr int sharesPerStep = 16;

/// A texel as the compiler's vector.
using Four = float __attribute__((vector_size(16)));
Four four(const Texel& texel) { return Four{texel[0], texel[1], texel[2], texel[3]}; }

/// e^x, held within -1.5 .. 1.5; good to 1e-4 where |x| < 0.2. Without a division.
Four grown(const Four& x)
{
    constexpr Four most{1.5f, 1.5f, 1.5f, 1.5f};
    const Four raised = x < -most ? -most : x, y = 0.25f * (raised > most ? most : raised), root = 1 + y * (1 + 0.5f * y);
    const Four square = root * root;
    return square * square;
}

bool same(const eclipse::Orders& a, const eclipse::Orders& b)
{
    return a.orders == b.orders && a.all == b.all && a.tolerance == b.tolerance;
}

} // namespace

EclipseSky::EclipseSky(const Atmosphere& atmosphere, const Phases& phases, const physics::SunTable& sun)
    : atmosphere_(atmosphere), phases_(phases), sun_(sun), law_(atmosphere.medium.wavelengthsNm),
      air_(eclipse::traceAir(atmosphere.medium, atmosphere.profile, atmosphere.optics, {})), shares_(atmosphere, sun)
{
}

void EclipseSky::set(const EclipseScene& scene)
{
    if (scene_ && samePlaces(scene_->bodies, scene.bodies) && same(scene_->orders, scene.orders) &&
        scene_->limbDarkening == scene.limbDarkening && scene_->field == scene.field && scene_->weights == scene.weights)
        return;
    shadow_ = physics::makeShadow(scene.bodies); // throws before anything is changed
    scene_ = scene;
    ready_ = false;
    light_.reset();
    field_.reset();
    sunAzimuth_ = std::atan2(scene.bodies.sunDirection[1], scene.bodies.sunDirection[0]);
    shares_.set(scene.bodies.cameraAltitude, scene.bodies.sunDirection[2], scene.weights);
}

bool EclipseSky::step()
{
    if (ready_)
        return true;
    if (!light_) {
        if (!shares_.step(sharesPerStep))
            return false;
        const auto& planet = atmosphere_.planet();
        // Nodes, and ground as far as it is seen.
        const double reach = shares_.reach() + physics::horizonDistance(planet, scene_->bodies.cameraAltitude) + 2e6;
        light_.emplace(shadow_, reach, scene_->limbDarkening ? &law_ : nullptr, scene_->weights);
        return false;
    }
    if (!scene_->field) {
        skyRatios_.assign(2 * ratioHalfViews * ratioAzimuths, Texel{1, 1, 1, 1});
        groundRatios_ = skyRatios_;
        return ready_ = true;
    }
    if (!followField())
        return false;
    tabulateRatios();
    ready_ = true;
    return true;
}

bool EclipseSky::followField()
{
    if (field_)
        return field_->step();
    field_.emplace(air_, sun_, scene_->bodies, scene_->orders, [this](const std::array<float, 3>& point) -> physics::VisibleSun<float> {
        const auto seen = light_->seen(point);
        return {seen.share[1], seen.aside};
    });
    return false;
}

double EclipseSky::fractionDone() const { return ready_ ? 1 : !light_ ? 0 : 0.2 + (field_ ? 0.7 * field_->fractionDone() : 0); }

std::vector<eclipse::ViewRay> EclipseSky::viewRays() const
{
    std::vector<eclipse::ViewRay> rays;
    const auto sines = viewSines(atmosphere_.planet(), scene_->bodies.cameraAltitude, ratioHalfViews);
    for (std::size_t i = 0; i < sines.size(); ++i)
        rays.push_back(eclipseViewRay(atmosphere_.planet(), scene_->bodies.cameraAltitude, sines[i], i >= ratioHalfViews));
    return rays;
}

void EclipseSky::tabulateRatios()
{
    std::vector<double> azimuths;
    for (int a = 0; a < ratioAzimuths; ++a)
        azimuths.push_back(sunAzimuth_ + 2 * pi * a / ratioAzimuths);
    const auto light = field_->view(viewRays(), azimuths);
    const auto wavelengths = static_cast<std::size_t>(light.wavelengths);
    const auto ratios = [&](const std::vector<float>& eclipsed, const std::vector<float>& whole) {
        std::vector<Texel> result(2 * ratioHalfViews * ratioAzimuths, Texel{1, 1, 1, 1});
        for (std::size_t i = 0; i < result.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c) {
                double left = 0, all = 0;
                for (std::size_t w = 0; w < wavelengths; ++w) {
                    const auto weight = static_cast<double>(scene_->weights[w][c]);
                    left += weight * static_cast<double>(eclipsed[i * wavelengths + w]);
                    all += weight * static_cast<double>(whole[i * wavelengths + w]);
                }
                if (all > 0)
                    result[i][c] = static_cast<float>(std::clamp(left / all, 0., 1.));
            }
        return result;
    };
    skyRatios_ = ratios(light.eclipsed, light.uneclipsed);
    groundRatios_ = ratios(light.groundEclipsed, light.groundUneclipsed);
}

Texel EclipseSky::ratioAt(const std::vector<Texel>& table, const double coordinate, const int half, const double relative) const
{
    const double v = std::clamp(coordinate, 0., 1.) * (ratioHalfViews - 1), a = (relative / (2 * pi) + 1) * ratioAzimuths;
    const int row = std::min(static_cast<int>(v), ratioHalfViews - 2), column = static_cast<int>(a);
    const auto y = static_cast<float>(v - row), t = static_cast<float>(a - column);
    // Cubic around the circle, where nodes are few; a ratio has no sharp edges and can't leave 0..1 by much.
    const std::array<float, 4> w{0.5f * t * (-1 + t * (2 - t)), 1 + 0.5f * t * t * (-5 + 3 * t), 0.5f * t * (1 + t * (4 - 3 * t)),
                                 0.5f * t * t * (t - 1)};
    Texel result{};
    for (int i = 0; i < 4; ++i) {
        const int k = (column - 1 + i + ratioAzimuths) % ratioAzimuths;
        const auto at = static_cast<std::size_t>((half * ratioHalfViews + row) * ratioAzimuths + k);
        for (std::size_t c = 0; c < 4; ++c)
            result[c] += w[static_cast<std::size_t>(i)] * (table[at][c] + y * (table[at + ratioAzimuths][c] - table[at][c]));
    }
    for (float& value : result)
        value = std::clamp(value, 0.f, 1.f);
    return result;
}

SkyView EclipseSky::dimmed(const OrdinarySky& sky, const ViewTable* const eclipsed, const int halfViews, const int azimuths) const
{
    const auto& planet = atmosphere_.planet();
    const auto& sun = scene_->bodies.sunDirection;
    const double altitude = scene_->bodies.cameraAltitude;
    SkyAxes axes{physics::horizonElevation(planet, altitude), true, std::asin(std::clamp(scene_->bodies.sunDirection[2], -1., 1.))};
    SkyView result;
    result.eclipse = true;
    result.whole = ViewTable(halfViews, azimuths);
    result.scattered.assign(sky.view.scattered.size(), ViewTable());
    for (std::size_t i = 0; i < sky.view.scattered.size(); ++i)
        if (!sky.view.scattered[i].empty())
            result.scattered[i] = ViewTable(halfViews, azimuths);
    // As fine as they are drawn without an eclipse.
    const auto fine = [](const ViewTable& table) { return resampled(table, drawnHalfViews, drawnAzimuths); };
    const ViewTable multiple = fine(eclipsed ? *eclipsed : sky.view.whole), direct = fine(sky.groundDirect),
                    diffuse = fine(sky.groundDiffuse), glow = fine(sky.glow);
    std::vector<ViewTable> single;
    for (const auto& table : sky.view.scattered)
        single.push_back(fine(table));
    std::vector<double> relatives;
    for (int a = 0; a < azimuths; ++a)
        relatives.push_back(axes.azimuthAt(double(a) / (azimuths - 1)));

    const auto scatterers = static_cast<std::size_t>(atmosphere_.scatterers());
    sky::base::parallel([&](int thread, int threads) {
        EclipseShares::Line line;
        std::vector<Texel> left(scatterers), all(scatterers);
        std::vector<float> nearer(scatterers); // gain of the cosine to the Sun, times what is left
        for (int v = thread; v < 2 * halfViews; v += threads) {
            const int half = v / halfViews;
            const double elevation = axes.elevationAt(double(v % halfViews) / (halfViews - 1), half);
            const double coordinate = std::asinh(std::abs(elevation - axes.horizon) / physics::horizonAngleScale) /
                                      std::asinh(axes.range(half) / physics::horizonAngleScale);
            const double mu = std::sin(elevation), flat = std::cos(elevation);
            shares_.line(mu, coordinate, half, line);
            const auto toGround = static_cast<float>(half == 1 ? physics::distanceToGround(planet, altitude, mu) : 0);
            for (int a = 0; a < azimuths; ++a) {
                const double relative = relatives[static_cast<std::size_t>(a)], azimuth = std::abs(relative) / pi;
                const std::array<float, 3> direction{static_cast<float>(flat * std::cos(sunAzimuth_ + relative)),
                                                     static_cast<float>(flat * std::sin(sunAzimuth_ + relative)), static_cast<float>(mu)};
                const double column = azimuth * (EclipseShares::azimuths - 1);
                const int k = std::min(static_cast<int>(column), EclipseShares::azimuths - 2);
                const auto x = static_cast<float>(column - k);
                // Share of the light that a node had: of the disc, through the air from what is left of it; and the cosine that
                // its angle to the line of sight gains.
                const auto leftAt = [&](float distance, std::size_t node) -> std::pair<Texel, float> {
                    const auto seen = light_->seen({distance * direction[0], distance * direction[1], distance * direction[2]});
                    Texel share = seen.share;
                    if (!line.lit || share[1] <= 0 || share[1] >= 1)
                        return {share, 0};
                    const float rise =
                        (seen.aside[0] * direction[0] + seen.aside[1] * direction[1]) * line.ahead[node] + seen.aside[2] * line.up[node];
                    const Texel *near = &line.rising[static_cast<std::size_t>(k) * EclipseShares::nodes + node],
                                *far = near + EclipseShares::nodes;
                    const Four slope = four(*near) + x * (four(*far) - four(*near)), kept = four(share) * grown(rise * slope);
                    const Four most = kept > 1.f ? Four{1, 1, 1, 1} : kept;
                    return {{most[0], most[1], most[2], most[3]},
                            seen.aside[0] * direction[0] + seen.aside[1] * direction[1] + seen.aside[2] * direction[2]};
                };
                Texel& whole = result.whole.at(v, a);
                const auto add = [&](const ViewTable& table, const Texel& factor) {
                    if (table.empty())
                        return;
                    const Texel value = sampled(table, coordinate, half, azimuth);
                    for (std::size_t c = 0; c < 4; ++c)
                        whole[c] += factor[c] * value[c];
                };
                if (!multiple.empty())
                    add(multiple, eclipsed ? Texel{1, 1, 1, 1} : ratioAt(skyRatios_, coordinate, half, relative));
                if (half == 1 && !direct.empty()) {
                    add(direct, leftAt(toGround, EclipseShares::nodes - 1).first);
                    add(diffuse, ratioAt(groundRatios_, coordinate, half, relative));
                }
                add(glow, {1, 1, 1, 1});
                if (!line.lit || single.empty())
                    continue;
                std::fill(left.begin(), left.end(), Texel{});
                std::fill(all.begin(), all.end(), Texel{});
                std::fill(nearer.begin(), nearer.end(), 0.f);
                const Texel *near = &line.light[static_cast<std::size_t>(k * EclipseShares::nodes) * scatterers],
                            *far = near + static_cast<std::size_t>(EclipseShares::nodes) * scatterers;
                for (std::size_t n = 0; n < EclipseShares::nodes; ++n) {
                    const auto [visible, towards] = leftAt(line.distance[n], n);
                    for (std::size_t i = 0; i < scatterers; ++i, ++near, ++far) {
                        const float before = left[i][1];
                        for (std::size_t c = 0; c < 4; ++c) {
                            const float light = (*near)[c] + x * ((*far)[c] - (*near)[c]);
                            all[i][c] += light;
                            left[i][c] += light * visible[c];
                        }
                        nearer[i] += towards * (left[i][1] - before);
                    }
                }
                for (std::size_t i = 0; i < single.size(); ++i) {
                    if (single[i].empty())
                        continue;
                    const Texel value = sampled(single[i], coordinate, half, azimuth);
                    // Phase functions are taken at the mean of all nodes, as in physics::SkyEvaluator.
                    float phase = 1;
                    if (nearer[i] != 0) {
                        const double nu = mu * sun[2] + flat * std::hypot(sun[0], sun[1]) * std::cos(relative);
                        const double ordinary = phases_.drawn(static_cast<int>(i), nu);
                        if (ordinary > 0)
                            phase = static_cast<float>(
                                phases_.drawn(static_cast<int>(i), nu + static_cast<double>(nearer[i] / left[i][1])) / ordinary);
                    }
                    for (std::size_t c = 0; c < 4; ++c)
                        result.scattered[i].at(v, a)[c] = all[i][c] > 0 ? value[c] * (phase * left[i][c] / all[i][c]) : value[c];
                }
            }
        }
    });
    return result;
}

SunSeen EclipseSky::sunAt(const std::array<double, 3>& direction, const physics::RayNodes::Node& node) const
{
    const double radius = atmosphere_.planet().radius + scene_->bodies.cameraAltitude, distance = radius * node.nuScale / node.sunScale;
    SunSeen seen = sunSeen(shadow_, atmosphere_.planet(), scene_->bodies.cameraAltitude, direction, node);
    if (scene_->limbDarkening)
        seen.share =
            static_cast<double>(light_->luminance({static_cast<float>(distance * direction[0]), static_cast<float>(distance * direction[1]),
                                                   static_cast<float>(distance * direction[2])}));
    return seen;
}

physics::MiddleOfLight EclipseSky::visibleAt(const std::array<double, 3>& direction, const physics::RayNodes::Node& node,
                                             double* const result) const
{
    const SunSeen seen = sunSeen(shadow_, atmosphere_.planet(), scene_->bodies.cameraAltitude, direction, node);
    if (scene_->limbDarkening) {
        const double distance = (atmosphere_.planet().radius + scene_->bodies.cameraAltitude) * node.nuScale / node.sunScale;
        law_.visible(shadow_.discs({distance * direction[0], distance * direction[1], distance * direction[2]}), result);
    } else {
        std::fill_n(result, atmosphere_.wavelengths(), seen.share);
    }
    return seen.middle;
}

EclipseSky::Ratios EclipseSky::ratios(const std::array<double, 3>& direction, const bool ground)
{
    const auto wavelengths = static_cast<std::size_t>(atmosphere_.wavelengths());
    Ratios result{std::vector<double>(wavelengths, 1.), std::vector<double>(wavelengths, 1.)};
    while (!followField()) {
    }
    const auto light = field_->view({eclipseViewRay(atmosphere_.planet(), scene_->bodies.cameraAltitude, direction[2], ground)},
                                    {std::atan2(direction[1], direction[0])});
    for (int w = 0; w < light.wavelengths; ++w) {
        result.sky[static_cast<std::size_t>(w)] = static_cast<double>(light.skyRatio(0, 0, w));
        result.ground[static_cast<std::size_t>(w)] = static_cast<double>(light.groundRatio(0, 0, w));
    }
    return result;
}

std::vector<float> EclipseSky::nodeRatios(const std::vector<physics::RayNodes>& lines, const std::vector<double>& sines,
                                          const std::vector<double>& relative) const
{
    std::vector<double> azimuths;
    for (const double fromSun : relative)
        azimuths.push_back(sunAzimuth_ + fromSun);
    const auto light = field_->view(*eclipse::traceNodes(*air_, lines, sines), azimuths);
    std::vector<float> result;
    result.reserve(light.eclipsed.size());
    const int rows = static_cast<int>(light.eclipsed.size()) / std::max(1, light.azimuths * light.wavelengths);
    for (int i = 0; i < rows; ++i)
        for (int a = 0; a < light.azimuths; ++a)
            for (int w = 0; w < light.wavelengths; ++w)
                result.push_back(light.skyRatio(i, a, w));
    return result;
}

} // namespace showmysky
