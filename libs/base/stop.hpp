#pragma once
#include <exception>
#include <functional>

namespace sky::base {

/// Long work asks it again and again, from several threads: true calls the work off. Empty: never.
using StopRequest = std::function<bool()>;

/// Thrown by work that was called off.
struct Stopped : std::exception {
    const char* what() const noexcept override { return "The work was called off."; }
};

/// throws Stopped
inline void stopIfAsked(const StopRequest& request)
{
    if (request && request())
        throw Stopped();
}

} // namespace sky::base
