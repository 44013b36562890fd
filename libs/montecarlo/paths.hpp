#pragma once
// Random paths, followed backwards from the camera.

#include "montecarlo/glow.hpp"
#include "montecarlo/random.hpp"
#include "montecarlo/single.hpp"

#include <array>
#include <vector>

namespace sky::montecarlo {

/// Which events a path counts: those of order `first` .. `last`; last = 0 means all.
struct Orders {
    int first = 2;
    int last = 0;
};

/// Of what is left of a path, followed without guides, before its first counted event: paths of less end by chance, or go on with that much.
constexpr double rouletteThreshold = 0.05;

/// A random direction after a scattering of light that travels along `direction`; multiplies `weight` by the share that is scattered.
Vec scatteredDirection(const Air& air, Vec direction, const Local& local, double u1, double u2, double& weight);

/// Estimates the radiance that a camera sees from scattered light. Not for use by two threads at once: it keeps scratch
/// space; the results depend on the random stream alone.
class PathTracer
{
public:
    /// \param glow  of the air, or of the scene's eclipse; must live as long as this. None is needed where paths end with their first event
    PathTracer(const Air& air, const Scene& scene, Orders orders, const Glow* glow);

    /// Mean of a batch of paths, 1/sr. The first decisions of its paths are spread evenly, from a random start.
    double batchMean(Random& random, int paths);

private:
    static constexpr int spreadDecisions = 4;
    using Decisions = std::array<double, spreadDecisions>;

    /// How the next event of a leg is chosen: one entry per segment, one more for the ground.
    struct Choice {
        std::vector<double> cumulative; // of the probability
        std::vector<double> weight;     // what an event there stands for
        double plain = 0;               // chance that a path is scattered or reflected
        bool possible = false;
    };
    /// Which light the event at the end of a leg may pass on: it goes where there is some.
    struct Wanted {
        bool direct = false, scattered = false;
        double guided = 0; ///< share of events that go there; the others follow optical depth alone
    };
    Wanted wantedAt(int order, double weight) const;
    void prepare(const Place& place, Vec direction, const Ray& ray, const Leg& leg, double groundAlbedo, Wanted wanted,
                 Choice& choice) const;
    /// Moves to the next event; returns whether it is on the ground. Multiplies `weight`.
    bool advance(Place& place, Vec direction, const Ray& ray, const Leg& leg, const Choice& choice, double u, double& weight) const;
    double path(Random& random, const Decisions& decisions);
    /// Direction after a scattering. Some are drawn where the sky is bright. In peaked air some are drawn about the Sun, as if the light had come
    /// from there: else sunlight is met in rare bright flashes, of which the standard error knows nothing (Buras, Mayer 2011, J. Quant. Spectrosc.
    /// Radiat. Transfer 112, 434).
    Vec nextDirection(const Place& place, Vec direction, int order, double u1, double u2, Random& random, double& weight) const;
    /// A point of the solar disc as a place sees it, of what the Moon leaves of it.
    Eclipse::Left sunPoint(const Place& place, Random& random) const;
    double sunlightAtAir(const Place& place, Vec direction, const Local& local, Random& random) const;
    double sunlightAtGround(const Place& place, Random& random) const;

    const Air& air_;
    Scene scene_;
    Orders orders_;
    const Glow* glow_;
    Ray firstRay_;
    Leg firstLeg_, leg_;
    Choice firstChoice_, choice_;
    Local local_;
};

} // namespace sky::montecarlo
