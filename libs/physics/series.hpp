#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sky::physics {

/// What all later events will add to a value, from the last two: events die out as a geometric series once only their slowest
/// mode is left.
inline double geometricTail(double last, double before)
{
    const double ratio = before > 0 ? std::clamp(last / before, 0., 0.999) : 0.;
    return ratio / (1 - ratio) * last;
}

/// Fields of successive events, [point][harmonic][wavelength], and the whole of which they are the beginning: at each point and wavelength
/// a geometric series of harmonic 0; the others go with it in the shape of the last event.
template<class Real>
class GeometricSeries
{
public:
    GeometricSeries(int harmonics, int wavelengths) : harmonics_(harmonics), wavelengths_(wavelengths) {}

    void add(std::vector<Real> event)
    {
        earlier_ = std::move(before_);
        before_ = std::move(last_);
        last_ = std::move(event);
        sum_.resize(last_.size(), Real(0));
        for (std::size_t i = 0; i < sum_.size(); ++i)
            sum_[i] += last_[i];
    }
    /// The event added last.
    const std::vector<Real>& last() const { return last_; }

    /// Largest relative difference that it made to harmonic 0 of the whole, where there is more than the part `faintest` of the brightest.
    double change(double faintest) const
    {
        double largest = 0, brightest = 0;
        forEachMean([&](std::size_t i) { brightest = std::max(brightest, double(sum_[i])); });
        forEachMean([&](std::size_t i) {
            const double now = double(sum_[i]) + geometricTail(double(last_[i]), at(before_, i));
            const double then = double(sum_[i]) - double(last_[i]) + geometricTail(at(before_, i), at(earlier_, i));
            if (now > faintest * brightest)
                largest = std::max(largest, std::abs(now - then) / now);
        });
        return largest;
    }

    /// All events, those that were not computed too.
    std::vector<Real> whole() const
    {
        std::vector<Real> result = sum_;
        forEachMean([&](std::size_t i) {
            const double added = double(last_[i]), share = added > 0 ? geometricTail(added, at(before_, i)) / added : 0;
            for (int lm = 0; lm < harmonics_; ++lm)
                result[i + lm * wavelengths_] += static_cast<Real>(share) * last_[i + lm * wavelengths_];
        });
        return result;
    }

private:
    static double at(const std::vector<Real>& event, std::size_t i) { return event.empty() ? 0 : double(event[i]); }
    template<class Action>
    void forEachMean(Action&& action) const
    {
        for (std::size_t point = 0; point < sum_.size(); point += std::size_t(harmonics_) * wavelengths_)
            for (int w = 0; w < wavelengths_; ++w)
                action(point + w);
    }

    int harmonics_, wavelengths_;
    std::vector<Real> sum_, last_, before_, earlier_;
};

/// Factors c_1 .. c_n for which sum c_k v_k comes nearest to the whole series v_1 + v_2 + ..., where each term follows from the one
/// before by the same linear operator: reduced rank extrapolation (Smith, Ford & Sidi 1987, SIAM Review 29, 199). It finds the
/// x = sum_{k<n} a_k v_k whose own next iterate, v_1 + sum a_k v_{k+1}, differs least from it, and answers with that iterate.
/// Terms that die out slowly (light inside a cloud) thus take about the square root of their number.
///   products  [n][n]: inner products of the terms, in the measure in which the difference shall be least
std::vector<double> seriesFactors(const std::vector<double>& products, int n);

} // namespace sky::physics
