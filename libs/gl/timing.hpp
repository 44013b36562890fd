#pragma once
// When the GPU is done, and how long it took.

#include <chrono>
#include <optional>

#include "gl/object.hpp"

namespace sky::gl {

/// Measures the GPU's time between begin() and end(). OpenGL ES has none in its core: `supported` says so.
class TimerQuery : public Object
{
public:
    /// throws GlError where the context can't measure time
    TimerQuery(const Api& api, std::string label);
    static bool supported(const Api& api);

    void begin();
    void end();
    /// Seconds, once the GPU got there; empty before. Never waits.
    std::optional<double> secondsIfReady() const;
    double seconds() const; ///< waits for the GPU
};

/// A mark in the stream of commands. Move-only.
class Sync
{
public:
    explicit Sync(const Api& api);
    ~Sync();
    Sync(Sync&& other) noexcept;
    Sync& operator=(Sync&& other) noexcept;

    /// True once all commands before the mark are done; waits that long at most (0: just looks).
    ///   throws GlError where the driver fails, after a GPU reset for instance
    bool wait(std::chrono::nanoseconds atMost) const;

private:
    void free() noexcept;
    Api api_;
    GLsync sync_ = nullptr;
};

} // namespace sky::gl
