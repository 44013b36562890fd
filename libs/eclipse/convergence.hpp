#pragma once
// How far the series of events has come, judged by what is used of it: quotients in a few directions of view.

#include "eclipse/field.hpp"
#include <algorithm>

namespace sky::eclipse {

/// What all later events add, in units of the last: a geometric series by the last two.
inline float tailOf(float last, float before)
{
    const float ratio = before > 0 ? std::clamp(last / before, 0.f, 0.95f) : 0.f;
    return ratio / (1 - ratio);
}

class Convergence
{
public:
    /// \param altitude of the observer, m
    Convergence(const AirRays& air, double altitude);

    const TracedViews& views() const { return *views_; }
    const std::vector<double>& azimuths() const { return azimuths_; }

    /// Takes the light of the next event in those directions. Returns how much the quotients, the rest of the series counted, are still expected to
    /// change: relative, rms over directions and wavelengths. Infinite until that can be said.
    double add(const ViewLight& event);

private:
    struct Series {
        std::vector<float> sum, last;
        /// Adds an event; the sum with its tail.
        std::vector<float> add(const std::vector<float>& event);
    };
    std::shared_ptr<const TracedViews> views_;
    std::vector<double> azimuths_;
    Series sky_[2], ground_[2]; ///< eclipsed, uneclipsed
    std::vector<float> quotients_;
    double change_ = 0;
    int events_ = 0;
};

} // namespace sky::eclipse
