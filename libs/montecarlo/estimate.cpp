#include "montecarlo/estimate.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

namespace sky::montecarlo {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int pathsPerBatch = 256;        // whose first decisions are spread evenly
constexpr std::int64_t firstBatches = 64; // enough for the standard error to mean something: 9 % uncertain
constexpr std::int64_t hopelessBatches = 512;

// Where time is limited, and paths take long:
constexpr double patience = 0.25; // s, for the first batches, however short the time
constexpr int fewestPaths = 4;    // in a batch

/// Says when no more batches are begun.
class Deadline
{
public:
    explicit Deadline(double maxSeconds) : limit_(maxSeconds) {}

    bool hasPassed(std::int64_t batches) const
    {
        return limit_ > 0 && batches >= 2 && seconds() > (batches < firstBatches ? std::max(limit_, patience) : limit_);
    }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    /// Of one batch of which firstBatches may be done in time on so many threads.
    double secondsForABatch(int threads) const { return std::max(limit_, patience) * threads / static_cast<double>(firstBatches); }

private:
    Clock::time_point start_ = Clock::now();
    double limit_;
};

std::uint64_t streamSeed(const Query& query, std::uint64_t seed)
{
    std::uint64_t hash = scramble(seed);
    for (const double x : {query.altitude, query.sunZenithAngle, query.viewZenithAngle, query.relativeAzimuth})
        hash = scramble(hash ^ std::bit_cast<std::uint64_t>(x));
    if (query.moon)
        for (const double x : {query.moon->zenithAngle, query.moon->relativeAzimuth, query.moon->distance})
            hash = scramble(hash ^ std::bit_cast<std::uint64_t>(x));
    return scramble(hash ^ static_cast<std::uint64_t>(query.wavelength));
}

/// So many paths in a batch that the first batches are done in time, as far as some paths tell that are thrown away: the choice knows nothing
/// of those that count. Less even than large batches, in the Earth's air by 1.7 in time, so these are for paths that are long.
int pathsWithin(const Deadline& deadline, const BatchMean& batchMean, std::uint64_t seed, int threads)
{
    Random random(seed, std::numeric_limits<std::uint64_t>::max()); // no batch's stream
    const double before = deadline.seconds();
    batchMean(random, fewestPaths);
    const double onePath = (deadline.seconds() - before) / fewestPaths;
    return deadline.secondsForABatch(threads) > pathsPerBatch * onePath ? pathsPerBatch : fewestPaths;
}

/// Appends the means of so many batches, or of fewer where time is up, on several threads. Which thread takes which batch makes no difference.
/// Every batch that was begun counts: one that takes long is not left out for it, since long paths are bright or dark.
void runBatches(const std::function<BatchMean()>& make, std::uint64_t seed, int threads, int paths, std::vector<double>& means,
                std::int64_t count, const Deadline& deadline)
{
    const std::size_t end = means.size() + static_cast<std::size_t>(count);
    std::atomic<std::size_t> next{means.size()};
    means.resize(end);
    const auto work = [&] {
        const BatchMean batchMean = make();
        for (std::size_t i; !deadline.hasPassed(static_cast<std::int64_t>(next)) && (i = next++) < end;) {
            Random random(seed, i);
            means[i] = batchMean(random, paths);
        }
    };
    {
        std::vector<std::jthread> others;
        for (int i = 1; i < threads; ++i)
            others.emplace_back(work);
        work();
    }
    means.resize(std::min(end, next.load()));
}

} // namespace

void addPaths(const Air& air, const Scene& scene, Orders orders, const Query& query, const Settings& settings, Result& result)
{
    const bool once = orders.last == 1;
    const std::optional<Glow> eclipsed = scene.eclipse && !once ? std::optional<Glow>(std::in_place, air, scene) : std::nullopt;
    const Glow* const glow = once ? nullptr : eclipsed ? &*eclipsed : &air.glow();
    const auto make = [&]() -> BatchMean {
        return [tracer = std::make_shared<PathTracer>(air, scene, orders, glow)](Random& random, int paths) {
            return tracer->batchMean(random, paths);
        };
    };
    runPaths(make, query, settings, result);
}

void runPaths(const std::function<BatchMean()>& make, const Query& query, const Settings& settings, Result& result)
{
    const Deadline deadline(settings.maxSeconds);
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int threads = settings.threads > 0 ? settings.threads : processors;
    const std::uint64_t seed = streamSeed(query, settings.seed);
    const int paths = settings.maxSeconds > 0 ? pathsWithin(deadline, make(), seed, threads) : pathsPerBatch;
    const std::int64_t limit = std::max<std::int64_t>(2, (settings.maxPaths + paths - 1) / paths);
    std::vector<double> means;
    std::int64_t wanted = settings.relativeError > 0 ? std::min(limit, firstBatches) : limit;
    while (static_cast<std::int64_t>(means.size()) < wanted) {
        runBatches(make, seed, threads, paths, means, wanted - static_cast<std::int64_t>(means.size()), deadline);
        const double count = static_cast<double>(means.size());
        double sum = 0, squares = 0;
        for (const double m : means)
            sum += m;
        result.multiple = sum / count;
        for (const double m : means)
            squares += (m - result.multiple) * (m - result.multiple);
        result.multipleStderr = std::sqrt(squares / (count * (count - 1)));
        result.paths = static_cast<std::int64_t>(means.size()) * paths;

        if (deadline.hasPassed(static_cast<std::int64_t>(means.size())))
            break;
        if (settings.relativeError <= 0)
            continue;
        // Aim a little beyond what is missing, but at most double the work on the word of an uncertain error.
        const double allowed = settings.relativeError * result.total();
        if (result.multipleStderr <= allowed && (allowed > 0 || static_cast<std::int64_t>(means.size()) >= hopelessBatches))
            break;
        const double ratio = allowed > 0 ? result.multipleStderr / allowed : 2;
        wanted = std::min(limit, static_cast<std::int64_t>(std::ceil(count * std::min(2.0, 1.1 * ratio * ratio))));
    }
}

} // namespace sky::montecarlo
