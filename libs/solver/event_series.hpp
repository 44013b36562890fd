#pragma once
#include <cstddef>
#include <vector>

namespace sky::solver {

/// Moments of one event or of several: plain values, unlike physics::Moments with its logarithms.
struct Sums {
    std::vector<double> moments;    ///< [altitude][sun][lm][wavelength]
    std::vector<double> irradiance; ///< [altitude][sun][wavelength], downward
};

/// Light fainter than this part of the brightest, over levels and Suns, decides nothing.
constexpr double faintest = 1e-7;

/// Adds `factor` times other light of the same places; to nothing too.
void addTo(Sums& sum, const Sums& other, double factor);

/// Relative difference between two answers for the light of some places, rms over those that are lit at all.
double relativeChange(const std::vector<double>& now, const std::vector<double>& then);

/// What is left of light that changed last by `change`, where each change is `ratio` times the one before: at least the last one again.
double remainderAfter(double change, double ratio);

/// Changes of which the least counts where it is told how they fall: a series closed by few events changes by leaps.
constexpr std::size_t changesTogether = 4;

/// What is left after the last of some changes, where they go on falling as the least of the last `changesTogether` did since the least of as many before.
///   changes  the last ones, 2 changesTogether at least
double remainderOf(const std::vector<double>& changes);

/// What all events after the first `most` will change, where changes go on falling as the power of the number of events as which they fell
/// since half as many, as those of light that spreads by diffusion: infinite where they fall as its inverse, or hardly faster.
///   before, now  changes by event number `event` / 2 and `event`, event <= most
double leftAfter(double before, double now, int event, int most);

/// The light of all events from that of the first ones. Each event follows from the last by the same operator, so where the
/// series shall be whole, physics::seriesFactors close it, with one set of factors a wavelength, chosen by the relative difference of
/// I_00 over all levels and Suns that are lit at all.
class EventSeries
{
public:
    /// \param whole  also the events that will not be computed; false: those that were added, no more
    EventSeries(int harmonics, int wavelengths, bool whole) : harmonics_(harmonics), wavelengths_(wavelengths), whole_(whole) {}

    void add(const Sums& event);
    /// Of the events that were added.
    const Sums& sum() const { return sum_; }
    /// Relative difference that the last event made to what `total` will answer, rms over the same places. Taken as a bound
    /// of what is left, which holds as long as changes fall by half or more from event to event.
    double change() const { return changes_.empty() ? 1 : changes_.back(); }
    /// What is left where changes fall more slowly: as much as follows if they go on falling as they did over the last events.
    double remainder() const;
    Sums total() const;

private:
    /// Sums in single precision: they only tell what lies beyond them.
    struct Kept {
        std::vector<float> moments, irradiance;
    };
    using Part = std::vector<float> Kept::*;
    std::vector<double> factors() const;
    /// Weights of the kept events whose sum lies beyond them, for the mean at `at`: factors minus one, or, where that would take light
    /// away, a geometric tail in the shape of the last event.
    void beyond(Part part, std::size_t at, const double* factors, double* weights) const;

    int harmonics_, wavelengths_;
    bool whole_;
    Sums sum_;
    std::vector<Kept> kept_;      // the last events
    std::vector<double> means_;   // [altitude][sun][wavelength], I_00 of the last answer
    std::vector<double> changes_; // by the last events
};

} // namespace sky::solver
