#pragma once
// The developed picture, kept while nothing but widgets changes.

#include "developer.hpp"
#include "input.hpp"

namespace showmysky::app::preview {

class Screen
{
public:
    explicit Screen(const sky::gl::Api& api) : api_(api), framebuffer_(api, "screen") {}

    /// The luminance isn't the one of the last time any more.
    void lightChanged() { developed_.reset(); }
    /// Fills the window's framebuffer.
    ///   luminance    texture, as of Developer; 0: dark grey
    ///   development  its exposure is the one to use
    void show(Developer& developer, unsigned luminance, const Development& development, const Canvas& canvas);
    /// How long the last development took.
    double seconds() const { return seconds_; }

private:
    sky::gl::Api api_;
    sky::gl::Framebuffer framebuffer_;
    std::optional<sky::gl::Texture2D> picture_;
    std::optional<Development> developed_; ///< how `picture_` was made; empty: it is out of date
    double seconds_ = 0;
};

} // namespace showmysky::app::preview
