#include "gl/timing.hpp"

#include <utility>

#include "base/error.hpp"

namespace sky::gl {

bool TimerQuery::supported(const Api& api)
{
    return (!api.isEs() && api->GetQueryObjectui64v) || (api.isEs() && api->GetQueryObjectui64vEXT);
}

TimerQuery::TimerQuery(const Api& context, std::string labelText) : Object(context, Kind::query, std::move(labelText))
{
    if (!supported(api()))
        throw GlError("Timer \"" + label() + "\": this OpenGL context can't measure the GPU's time.");
}

void TimerQuery::begin()
{
    api()->BeginQuery(GL_TIME_ELAPSED, name());
    applyLabel();
}

void TimerQuery::end() { api()->EndQuery(GL_TIME_ELAPSED); }

std::optional<double> TimerQuery::secondsIfReady() const
{
    GLuint ready = 0;
    api()->GetQueryObjectuiv(name(), GL_QUERY_RESULT_AVAILABLE, &ready);
    if (!ready)
        return std::nullopt;
    return seconds();
}

double TimerQuery::seconds() const
{
    GLuint64 nanoseconds = 0;
    const auto get = api().isEs() ? api()->GetQueryObjectui64vEXT : api()->GetQueryObjectui64v;
    get(name(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-9 * static_cast<double>(nanoseconds);
}

Sync::Sync(const Api& api) : api_(api), sync_(api_->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0))
{
    if (!sync_)
        throw GlError("The OpenGL driver can't make a fence.");
}

Sync::~Sync() { free(); }
Sync::Sync(Sync&& other) noexcept : api_(other.api_), sync_(std::exchange(other.sync_, nullptr)) {}

Sync& Sync::operator=(Sync&& other) noexcept
{
    if (this != &other) {
        free();
        api_ = other.api_;
        sync_ = std::exchange(other.sync_, nullptr);
    }
    return *this;
}

void Sync::free() noexcept
{
    if (sync_)
        api_.runCurrent([this] { api_->DeleteSync(sync_); });
    sync_ = nullptr;
}

bool Sync::wait(std::chrono::nanoseconds atMost) const
{
    // The flush makes sure that the mark itself reaches the GPU, or the wait could last for ever.
    const GLenum status = api_->ClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, static_cast<GLuint64>(atMost.count()));
    if (status == GL_WAIT_FAILED) {
        checkErrors(api_, "waiting for the GPU");
        throw GlError("Waiting for the GPU fails.");
    }
    return status != GL_TIMEOUT_EXPIRED;
}

} // namespace sky::gl
