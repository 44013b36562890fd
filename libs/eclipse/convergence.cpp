#include "eclipse/convergence.hpp"
#include "base/angles.hpp"
#include "eclipse/rays.hpp"
#include <cmath>
#include <limits>

namespace sky::eclipse {

namespace {

/// Quotients below this count as if they were as large: totality leaves 1e-4 or more.
constexpr double leastQuotient = 1e-6;
/// Changes are taken to shrink from event to event by a factor within these.
constexpr double fastest = 0.5, slowest = 0.95;

} // namespace

Convergence::Convergence(const AirRays& air, const double altitude)
{
    const auto& planet = air.profile.planet();
    const double inside = std::min(altitude, planet.topOfAtmosphere), horizon = std::sin(physics::horizonElevation(planet, inside));
    std::vector<ViewRay> rays;
    for (const double part : {0.02, 0.2, 0.8})
        rays.push_back({inside, horizon + part * (1 - horizon), false, 0});
    for (const double part : {0.02, 0.3, 1.})
        rays.push_back({inside, horizon - part * (1 + horizon), true, 0});
    views_ = traceViews(air, rays);
    for (int quarter = 0; quarter < 4; ++quarter)
        azimuths_.push_back((0.5 + quarter) * base::pi / 2);
}

std::vector<float> Convergence::Series::add(const std::vector<float>& event)
{
    sum.resize(event.size());
    last.resize(event.size());
    std::vector<float> whole(event.size());
    for (std::size_t i = 0; i < event.size(); ++i) {
        sum[i] += event[i];
        whole[i] = sum[i] + tailOf(event[i], last[i]) * event[i];
    }
    last = event;
    return whole;
}

double Convergence::add(const ViewLight& event)
{
    std::vector<float> now;
    const auto divide = [&](const std::vector<float>& left, const std::vector<float>& all) {
        for (std::size_t i = 0; i < all.size(); ++i)
            now.push_back(all[i] > 0 ? left[i] / all[i] : 1.f);
    };
    divide(sky_[0].add(event.eclipsed), sky_[1].add(event.uneclipsed));
    divide(ground_[0].add(event.groundEclipsed), ground_[1].add(event.groundUneclipsed));
    quotients_.resize(now.size());
    double sum = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double quotient = static_cast<double>(now[i]), before = static_cast<double>(quotients_[i]);
        sum += std::pow((quotient - before) / std::max(quotient, leastQuotient), 2);
    }
    const double change = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, now.size())));
    const double factor = change_ > 0 ? std::clamp(change / change_, fastest, slowest) : slowest;
    quotients_ = now;
    change_ = change;
    // The first event has no tail, so that the first change that counts is the third's.
    return ++events_ < 3 ? std::numeric_limits<double>::infinity() : change * factor / (1 - factor);
}

} // namespace sky::eclipse
