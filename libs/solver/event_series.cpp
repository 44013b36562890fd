#include "solver/event_series.hpp"
#include "physics/series.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace sky::solver {

namespace {

/// Events from which the rest is told: each that is kept takes the memory of a whole field.
constexpr std::size_t mostKept = 8;

void addTo(std::vector<double>& sum, const std::vector<double>& values, double factor)
{
    sum.resize(values.size(), 0.);
    for (std::size_t i = 0; i < values.size(); ++i)
        sum[i] += factor * values[i];
}

} // namespace

void addTo(Sums& sum, const Sums& other, const double factor)
{
    addTo(sum.moments, other.moments, factor);
    addTo(sum.irradiance, other.irradiance, factor);
}

double relativeChange(const std::vector<double>& now, const std::vector<double>& then)
{
    const double least = faintest * *std::max_element(now.begin(), now.end());
    if (!std::isfinite(least))
        return std::numeric_limits<double>::infinity();
    double squares = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (now[i] > least) {
            const double relative = (now[i] - then[i]) / now[i];
            squares += relative * relative;
            ++lit;
        }
    return lit > 0 ? std::sqrt(squares / double(lit)) : 0;
}

double remainderAfter(const double change, const double ratio)
{
    const double falling = std::min(ratio, 0.99);
    return change * std::max(1., falling / (1 - falling));
}

double remainderOf(const std::vector<double>& changes)
{
    const auto middle = changes.end() - changesTogether;
    const double before = *std::min_element(middle - changesTogether, middle), last = *std::min_element(middle, changes.end());
    return remainderAfter(changes.back(), std::pow(last / std::max(before, 1e-300), 1. / changesTogether));
}

double leftAfter(const double before, const double now, const int event, const int most)
{
    const double power = std::log2(std::min(before, 1.) / now); // a first guess that is many times too bright tells nothing
    // The integral of now (n / event)^-power from n = most on.
    return power > 1 ? now * event / (power - 1) * std::pow(double(event) / most, power - 1) : std::numeric_limits<double>::infinity();
}

void EventSeries::add(const Sums& event)
{
    addTo(sum_, event, 1);
    if (whole_) {
        if (kept_.size() == mostKept)
            kept_.erase(kept_.begin());
        kept_.push_back({{event.moments.begin(), event.moments.end()}, {event.irradiance.begin(), event.irradiance.end()}});
    }
    const auto c = factors();
    const std::size_t step = std::size_t(harmonics_) * wavelengths_, points = sum_.moments.size() / step, n = kept_.size();
    const std::vector<double> then = std::move(means_);
    std::vector<double> weights(n);
    means_.clear();
    for (std::size_t point = 0; point < points; ++point)
        for (int w = 0; w < wavelengths_; ++w) {
            const std::size_t at = point * step + w;
            beyond(&Kept::moments, at, c.data() + w * n, weights.data());
            means_.push_back(sum_.moments[at]);
            for (std::size_t k = 0; k < n; ++k)
                means_.back() += weights[k] * double(kept_[k].moments[at]);
        }
    if (then.empty())
        return;
    if (changes_.size() == 2 * changesTogether)
        changes_.erase(changes_.begin());
    changes_.push_back(relativeChange(means_, then));
}

double EventSeries::remainder() const
{
    return changes_.size() < 2 * changesTogether ? remainderAfter(change(), 1) : remainderOf(changes_);
}

Sums EventSeries::total() const
{
    Sums result = sum_;
    const auto c = factors();
    const std::size_t n = kept_.size();
    std::vector<double> weights(n);
    const auto close = [&](Part part, std::vector<double>& values, int harmonics) {
        for (std::size_t first = 0; first < values.size(); first += std::size_t(harmonics) * wavelengths_)
            for (int w = 0; w < wavelengths_; ++w) {
                beyond(part, first + w, c.data() + w * n, weights.data());
                for (int lm = 0; lm < harmonics; ++lm)
                    for (std::size_t k = 0; k < n; ++k)
                        values[first + lm * wavelengths_ + w] += weights[k] * double((kept_[k].*part)[first + lm * wavelengths_ + w]);
            }
    };
    close(&Kept::moments, result.moments, harmonics_);
    close(&Kept::irradiance, result.irradiance, 1);
    return result;
}

std::vector<double> EventSeries::factors() const
{
    const std::size_t n = kept_.size(), step = std::size_t(harmonics_) * wavelengths_;
    std::vector<double> result;
    std::vector<double> relative(n);
    for (int w = 0; w < wavelengths_ && n > 0; ++w) {
        double brightest = 0;
        for (std::size_t at = w; at < sum_.moments.size(); at += step)
            brightest = std::max(brightest, sum_.moments[at]);
        std::vector<double> products(n * n, 0.);
        for (std::size_t at = w; at < sum_.moments.size(); at += step) {
            if (!(sum_.moments[at] > faintest * brightest))
                continue;
            for (std::size_t k = 0; k < n; ++k)
                relative[k] = double(kept_[k].moments[at]) / sum_.moments[at];
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j)
                    products[i * n + j] += relative[i] * relative[j];
        }
        const auto one = physics::seriesFactors(products, static_cast<int>(n));
        result.insert(result.end(), one.begin(), one.end());
    }
    return result;
}

void EventSeries::beyond(const Part part, const std::size_t at, const double* const factors, double* const weights) const
{
    const std::size_t n = kept_.size();
    double rest = 0;
    for (std::size_t k = 0; k < n; ++k) {
        weights[k] = factors[k] - 1;
        rest += weights[k] * double((kept_[k].*part)[at]);
    }
    if (rest >= 0)
        return;
    const double last = double((kept_[n - 1].*part)[at]), before = n > 1 ? double((kept_[n - 2].*part)[at]) : 0;
    std::fill(weights, weights + n, 0.);
    weights[n - 1] = last > 0 ? physics::geometricTail(last, before) / last : 0;
}

} // namespace sky::solver
