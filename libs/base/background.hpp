#pragma once
#include <future>
#include <utility>

namespace sky::base {

/// One job at a time on a thread of its own, while the caller goes on. What a job throws is thrown by the next start() or finish(); a job
/// still running when this goes out of scope is waited for, so what it refers to must live longer.
class Background
{
public:
    template<class Job>
    void start(Job&& job)
    {
        finish();
        running_ = std::async(std::launch::async, std::forward<Job>(job));
    }
    void finish()
    {
        if (running_.valid())
            running_.get();
    }

private:
    std::future<void> running_;
};

} // namespace sky::base
