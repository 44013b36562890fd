#include "montecarlo/estimate.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

namespace sky::montecarlo {
namespace {

constexpr int pathsPerBatch = 256;
constexpr std::int64_t firstBatches = 64; // enough for the standard error to mean something: 9 % uncertain
constexpr std::int64_t hopelessBatches = 512;

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

/// Computes means[from ..] on several threads. Which thread takes which batch makes no difference.
void runBatches(const std::function<BatchMean()>& make, std::uint64_t seed, int threads, std::vector<double>& means, std::size_t from)
{
    std::atomic<std::size_t> next{from};
    const auto work = [&] {
        const BatchMean batchMean = make();
        for (std::size_t i; (i = next++) < means.size();) {
            Random random(seed, i);
            means[i] = batchMean(random, pathsPerBatch);
        }
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i)
        others.emplace_back(work);
    work();
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
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int threads = settings.threads > 0 ? settings.threads : processors;
    const std::int64_t limit = std::max<std::int64_t>(2, (settings.maxPaths + pathsPerBatch - 1) / pathsPerBatch);
    std::vector<double> means;
    std::int64_t wanted = settings.relativeError > 0 ? std::min(limit, firstBatches) : limit;
    while (static_cast<std::int64_t>(means.size()) < wanted) {
        // Where time is limited, rounds stay short enough to look at the clock.
        const auto have = static_cast<std::int64_t>(means.size());
        const std::int64_t round = settings.maxSeconds > 0 ? std::min(wanted - have, std::max(firstBatches, have / 4)) : wanted - have;
        means.resize(static_cast<std::size_t>(have + round));
        runBatches(make, streamSeed(query, settings.seed), threads, means, static_cast<std::size_t>(have));

        const double count = static_cast<double>(means.size());
        double sum = 0, squares = 0;
        for (const double m : means)
            sum += m;
        result.multiple = sum / count;
        for (const double m : means)
            squares += (m - result.multiple) * (m - result.multiple);
        result.multipleStderr = std::sqrt(squares / (count * (count - 1)));
        result.paths = static_cast<std::int64_t>(means.size()) * pathsPerBatch;

        if (settings.maxSeconds > 0 && std::chrono::duration<double>(Clock::now() - start).count() > settings.maxSeconds)
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
