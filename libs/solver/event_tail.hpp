#pragma once
#include "solver/event_series.hpp"
#include "solver/layered_light.hpp"

namespace sky::solver {

/// An event and all that follow, where they are too many to be computed one by one: light u that is the event and what u itself becomes
/// when it is scattered once more. Each sweep tells what is missing, and LayeredLight what that will add up to: synthetic acceleration
/// (Kopp 1963, Nucl. Sci. Eng. 17, 65; Larsen 1984, Prog. Nucl. Energy 13, 3).
class EventTail
{
public:
    /// \param event  referred to, not copied
    EventTail(const Sums& event, const LayeredLight& layers, int suns);

    /// Forgets all but the event.
    void begin(const LayeredLight& layers);
    /// The event and all that follow, as far as known.
    const Sums& light() const { return light_; }
    /// Takes in one more sweep.
    ///   next     light(), scattered or reflected once more
    ///   earlier  the events before, which count where it is told how much changed
    void improve(const Sums& next, const Sums& earlier, const LayeredLight& layers);
    /// What is left, rms of its part of all light: the last change, and those that will follow if changes go on falling as the last ones did.
    /// Of few sweeps that is a guess.
    double remainder() const;
    /// Whether there were enough sweeps to tell how changes fall, beside leaps from one to the next.
    bool settled() const { return changes_.size() >= 2 * changesTogether; }
    /// Whether sweeps on the whole gain too little: then layers don't tell where light goes, and the tail is of no use. In a gap under a deep
    /// cloud it goes far to the side, into the night.
    bool stalls() const;

private:
    /// Where a sweep leaves more than a part of what the one before it left, layers were trusted too far.
    void judge(const Sums& missing, double least);
    /// Adds light that was not there before, and what follows from it where there is enough light in all.
    ///   least  of I_00; less is only added
    void add(const Sums& fresh, const LayeredLight& layers, double least);

    /// Takes away what no air can hold. Light that spreads to the side, as in a gap above white ground, layers keep where it is: without a bound it
    /// grows from sweep to sweep, up to infinity.
    void bound(const Sums& earlier);

    const Sums& event_;
    int suns_, wavelengths_, harmonics_;
    Sums light_;
    std::vector<double> changes_; // by each sweep
    double least_ = 1;            // of them
    bool bounded_ = false;        ///< whether the last sweep left more light than there can be
    /// [sun][wavelength]: how far layers are followed, 0..1; less where they told wrong, as in twilight, where light comes from beside.
    std::vector<double> trust_;
    std::vector<double> wrong_; // [sun][wavelength]: by how much its light was wrong at the last sweep, rms of its part
};

} // namespace sky::solver
