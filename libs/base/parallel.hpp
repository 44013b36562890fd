#pragma once
#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace sky::base {

/// Runs work(thread, threads) on every core and waits. The first exception thrown there is thrown here.
template<class Work>
void parallel(Work&& work)
{
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<std::exception_ptr> errors(threads);
    std::vector<std::thread> others;
    const auto guarded = [&](int thread) {
        try {
            work(thread, threads);
        } catch (...) {
            errors[thread] = std::current_exception();
        }
    };
    for (int t = 1; t < threads; ++t)
        others.emplace_back(guarded, t);
    guarded(0);
    for (auto& thread : others)
        thread.join();
    for (const auto& error : errors)
        if (error)
            std::rethrow_exception(error);
}

} // namespace sky::base
