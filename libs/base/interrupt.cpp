#include "base/interrupt.hpp"

#include <atomic>
#include <csignal>

#ifdef _WIN32
#define NOMINMAX
#include <windows.h>
#endif

namespace sky {

namespace {

// A signal handler gets no argument of ours: this flag is the one thing it can reach.
std::atomic<bool> interruptFlag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

#ifdef _WIN32
BOOL WINAPI onConsoleEvent(DWORD) { return interruptFlag.exchange(true) ? FALSE : TRUE; }
#else
constexpr int stopSignals[] = {SIGINT, SIGTERM, SIGHUP};

void onSignal(int signal)
{
    if (interruptFlag.exchange(true)) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}
#endif

} // namespace

InterruptGuard::InterruptGuard()
{
    interruptFlag = false;
#ifdef _WIN32
    SetConsoleCtrlHandler(onConsoleEvent, TRUE);
#else
    for (const int signal : stopSignals) {
        struct sigaction action {
        }, old{};
        action.sa_handler = onSignal; // without SA_RESTART: a read from a pipe that never ends is woken too
        sigaction(signal, nullptr, &old);
        if (old.sa_handler != SIG_IGN) // nohup and background jobs of scripts ignore some on purpose
            sigaction(signal, &action, nullptr);
    }
#endif
}

InterruptGuard::~InterruptGuard()
{
#ifdef _WIN32
    SetConsoleCtrlHandler(onConsoleEvent, FALSE);
#else
    for (const int signal : stopSignals) {
        struct sigaction old {
        };
        sigaction(signal, nullptr, &old);
        if (old.sa_handler == onSignal)
            std::signal(signal, SIG_DFL);
    }
#endif
}

bool interrupted() { return interruptFlag; }

} // namespace sky
