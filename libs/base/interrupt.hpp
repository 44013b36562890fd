#pragma once

namespace sky {

/// While it lives, Ctrl-C (and SIGTERM, SIGHUP) only sets a flag, so that the work can stop at a safe place. The second
/// one ends the program at once. At most one lives at a time.
class InterruptGuard
{
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// True once the user asked to stop.
bool interrupted();

} // namespace sky
