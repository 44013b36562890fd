#include "verify_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"

namespace sky::cli {

namespace {

/// Two independent estimates of one radiance: weighted by their paths, not by their own noise, which would bias the mean.
montecarlo::Result merged(const montecarlo::Result& a, const montecarlo::Result& b)
{
    montecarlo::Result r = a;
    r.paths = a.paths + b.paths;
    if (r.paths == 0)
        return r;
    const double share = static_cast<double>(b.paths) / static_cast<double>(r.paths);
    r.multiple = (1 - share) * a.multiple + share * b.multiple;
    r.multipleStderr = std::hypot((1 - share) * a.multipleStderr, share * b.multipleStderr);
    return r;
}

void stopIfAsked()
{
    if (interrupted())
        throw Cancelled("Stopped on request.");
}

} // namespace

double relativeNoise(const montecarlo::Result& result)
{
    if (!(result.total() > 0))
        return std::numeric_limits<double>::infinity();
    return std::hypot(result.multipleStderr, result.singleStderr) / result.total();
}

bool isDark(const montecarlo::Result& result) { return !(result.total() > darkest); }

bool isSure(const montecarlo::Result& result) { return result.paths >= fewestPaths && relativeNoise(result) <= unsureNoise; }

std::size_t neediest(const std::vector<montecarlo::Result>& results, const double relativeError)
{
    std::size_t soonest = results.size(), noisiest = results.size();
    double least = std::numeric_limits<double>::infinity(), most = relativeError;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (isDark(results[i]))
            continue;
        const double noise = relativeNoise(results[i]);
        if (noise > most) {
            most = noise;
            noisiest = i;
        }
        if (!isSure(results[i]) && noise < least) {
            least = noise;
            soonest = i;
        }
    }
    return soonest < results.size() ? soonest : noisiest;
}

std::vector<montecarlo::Result> judge(const montecarlo::Reference& reference, const std::vector<montecarlo::Query>& queries,
                                      const JudgeSettings& settings, const std::function<void(double)>& progress)
{
    const base::Stopwatch watch;
    montecarlo::Settings path;
    path.orders = settings.orders;
    path.relativeError = settings.relativeError;
    path.seed = settings.seed;
    path.maxPaths = std::numeric_limits<std::int64_t>::max() / 2;
    if (settings.seconds <= 0)
        path.maxPaths = std::int64_t(1) << 32; // ends what never converges: a few hours for one row

    std::vector<montecarlo::Result> results;
    results.reserve(queries.size());
    const double share = 0.5 * settings.seconds / static_cast<double>(std::max<std::size_t>(1, queries.size()));
    for (const montecarlo::Query& query : queries) {
        stopIfAsked();
        path.maxSeconds = share;
        results.push_back(reference.radiance(query, path));
        const double rows = static_cast<double>(results.size()) / static_cast<double>(queries.size());
        progress(settings.seconds > 0 ? std::min(1., watch.seconds() / settings.seconds) : rows);
    }

    // The rest of the time goes to one row after the other, a share at a time.
    for (std::uint64_t round = 1; watch.seconds() + share < settings.seconds; ++round) {
        stopIfAsked();
        const std::size_t next = neediest(results, settings.relativeError);
        if (next == queries.size())
            break;
        path.seed = settings.seed + 1000003 * round;
        path.maxSeconds = 2 * share;
        path.relativeError = 0.3 * settings.relativeError;
        results[next] = merged(results[next], reference.radiance(queries[next], path));
        progress(std::min(1., watch.seconds() / settings.seconds));
    }
    return results;
}

} // namespace sky::cli
