#include "solver/event_tail.hpp"
#include "base/parallel.hpp"
#include "physics/harmonics.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace sky::solver {

namespace {

/// Part of what a sweep saw that a correction leaves at least: light is not negative.
constexpr double leastLeft = 0.1;
/// Change by a sweep, and what it finds wrong, of that of the one before, above which nothing is gained.
constexpr double leastGain = 0.7;
/// Sweeps before that is asked of all together: light first comes to where layers had told of none.
constexpr int firstSweeps = 15;
/// Largest I_00 per unit solar irradiance. Deep in air that absorbs nothing, under a Sun in the zenith, the mean radiance is sqrt(3) H(1) / (4 pi)
/// = 0.40 (Chandrasekhar 1960, Radiative Transfer, ch. III and V), and nowhere is there more; times sqrt(4 pi), and half as much again.
constexpr double brightest = 2.1;
/// Of the trust in layers that is left where they were wrong.
constexpr double lessTrust = 0.3;

} // namespace

EventTail::EventTail(const Sums& event, const LayeredLight& layers, const int suns)
    : event_(event), suns_(suns), wavelengths_(layers.wavelengths()),
      harmonics_(int(event.moments.size() / event.irradiance.size())), light_{std::vector<double>(event.moments.size(), 0.),
                                                                              std::vector<double>(event.irradiance.size(), 0.)},
      trust_(std::size_t(suns) * wavelengths_, 1.), wrong_(trust_.size(), std::numeric_limits<double>::infinity())
{
    add(event, layers, 0);
}

void EventTail::begin(const LayeredLight& layers)
{
    addTo(light_, light_, -1);
    add(event_, layers, 0);
}

void EventTail::improve(const Sums& next, const Sums& earlier, const LayeredLight& layers)
{
    Sums missing = event_;
    addTo(missing, next, 1);
    addTo(missing, light_, -1);
    const auto means = [&] {
        std::vector<double> result;
        for (std::size_t first = 0; first < light_.moments.size(); first += std::size_t(harmonics_) * wavelengths_)
            for (int w = 0; w < wavelengths_; ++w)
                result.push_back(earlier.moments[first + w] + light_.moments[first + w]);
        return result;
    };
    const auto then = means();
    const double least = faintest * *std::max_element(then.begin(), then.end());
    judge(missing, least);
    add(missing, layers, least);
    bound(earlier);
    changes_.push_back(relativeChange(means(), then));
    if (!bounded_ && changes_.back() < least_) // neither light that is cut nor no number is a gain
        least_ = changes_.back();
}

void EventTail::judge(const Sums& missing, const double least)
{
    const std::size_t step = std::size_t(harmonics_) * wavelengths_, columns = trust_.size();
    std::vector<double> squares(columns, 0.), lit(columns, 0.);
    for (std::size_t point = 0; point < light_.moments.size() / step; ++point)
        for (int w = 0; w < wavelengths_; ++w) {
            const double mean = light_.moments[point * step + w];
            if (!(mean > least))
                continue;
            const std::size_t column = point % suns_ * wavelengths_ + w;
            squares[column] += std::pow(missing.moments[point * step + w] / mean, 2);
            ++lit[column];
        }
    for (std::size_t column = 0; column < columns; ++column) {
        const double wrong = lit[column] > 0 ? std::sqrt(squares[column] / lit[column]) : 0;
        // A correction of which a part is taken leaves at least the rest: that is no sign against it.
        if (wrong > (1 - (1 - leastGain) * trust_[column]) * wrong_[column])
            trust_[column] *= lessTrust;
        wrong_[column] = wrong;
    }
}

void EventTail::add(const Sums& fresh, const LayeredLight& layers, const double least)
{
    const std::size_t perPoint = std::size_t(harmonics_) * wavelengths_;
    const int levels = static_cast<int>(light_.moments.size() / perPoint) / suns_, terms = layers.degree() + 1;
    addTo(light_, fresh, 1);
    base::parallel([&](int thread, int threads) {
        std::vector<double> values(layers.valueCount());
        for (int job = thread; job < suns_ * wavelengths_; job += threads) {
            const int sun = job % suns_, w = job / suns_;
            const auto point = [&](int level) { return std::size_t(level) * suns_ + sun; };
            const auto at = [&](int level, int l) {
                return point(level) * perPoint + std::size_t(physics::harmonicIndex(l, 0)) * wavelengths_ + w;
            };
            for (int a = 0; a < levels; ++a)
                for (int l = 0; l < terms; ++l)
                    values[a * terms + l] = fresh.moments[at(a, l)];
            values.back() = fresh.irradiance[point(0) * wavelengths_ + w];
            layers.addFollowing(w, values.data());
            if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
                continue; // a matrix that is all but singular tells nothing
            const double trust = trust_[std::size_t(sun) * wavelengths_ + w];
            for (int a = 0; a < levels; ++a) {
                const double swept = light_.moments[at(a, 0)], change = trust * (values[a * terms] - fresh.moments[at(a, 0)]);
                if (std::max(swept, swept + change) < least) // where light will come to, it goes with what there is beside it
                    continue;
                // A correction that would leave less is taken in part, its directions too: more of them than of light is none.
                const double part = swept + change < leastLeft * swept ? (1 - leastLeft) * swept / -change : 1;
                for (int l = 0; l < terms; ++l)
                    light_.moments[at(a, l)] += part * trust * (values[a * terms + l] - fresh.moments[at(a, l)]);
                const double mean = light_.moments[at(a, 0)];
                double& irradiance = light_.irradiance[point(a) * wavelengths_ + w];
                if (a == 0)
                    irradiance = std::max(irradiance + part * trust * (values.back() - fresh.irradiance[point(0) * wavelengths_ + w]),
                                          leastLeft * irradiance);
                else if (swept > 0)
                    irradiance *= mean / swept;
            }
        }
    });
}

void EventTail::bound(const Sums& earlier)
{
    const std::size_t perPoint = std::size_t(harmonics_) * wavelengths_, levels = light_.moments.size() / perPoint / suns_;
    bounded_ = false;
    for (int sun = 0; sun < suns_; ++sun)
        for (int w = 0; w < wavelengths_; ++w) {
            double part = 1;
            for (std::size_t level = 0; level < levels; ++level) {
                const std::size_t at = (level * suns_ + sun) * perPoint + w;
                const double room = std::max(0., brightest - earlier.moments[at]), light = light_.moments[at];
                if (!(light <= room))
                    part = std::isfinite(light) ? std::min(part, room / light) : 0;
            }
            if (part == 1)
                continue;
            bounded_ = true;
            trust_[std::size_t(sun) * wavelengths_ + w] *= lessTrust;
            for (std::size_t level = 0; level < levels; ++level) {
                const std::size_t point = level * suns_ + sun;
                for (int lm = 0; lm < harmonics_; ++lm) {
                    double& light = light_.moments[point * perPoint + std::size_t(lm) * wavelengths_ + w];
                    light = part > 0 ? part * light : event_.moments[point * perPoint + std::size_t(lm) * wavelengths_ + w];
                }
                double& irradiance = light_.irradiance[point * wavelengths_ + w];
                irradiance = part > 0 ? part * irradiance : event_.irradiance[point * wavelengths_ + w];
            }
        }
}

bool EventTail::stalls() const { return least_ > std::pow(leastGain, int(changes_.size()) - firstSweeps); }

double EventTail::remainder() const
{
    if (bounded_ || changes_.empty())
        return std::numeric_limits<double>::infinity();
    const double last = changes_.back(), before = changes_.size() > 1 ? changes_.end()[-2] : 1;
    return settled() ? remainderOf(changes_) : remainderAfter(last, last / std::max(before, 1e-300));
}

} // namespace sky::solver
