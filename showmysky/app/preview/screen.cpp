#include "screen.hpp"
#include "base/stopwatch.hpp"

namespace showmysky::app::preview {

namespace gl = sky::gl;

void Screen::show(Developer& developer, unsigned luminance, const Development& development, const Canvas& canvas)
{
    if (luminance == 0) {
        api_->BindFramebuffer(GL_FRAMEBUFFER, 0);
        api_->ClearColor(0.08f, 0.08f, 0.1f, 1);
        api_->Clear(GL_COLOR_BUFFER_BIT);
        return;
    }
    if (!picture_ || !(picture_->size() == gl::TextureSize{canvas.width, canvas.height, 1})) {
        picture_.emplace(api_, "developed picture", gl::TextureFormat::rgba8, canvas.width, canvas.height);
        framebuffer_.attach(0, *picture_);
        developed_.reset();
    }
    if (developed_ != development) {
        const sky::base::Stopwatch watch;
        const gl::Bound target(framebuffer_);
        developer.draw(luminance, development, development.exposure, {0, 0, canvas.width, canvas.height});
        api_->Finish();
        developed_ = development;
        seconds_ = watch.seconds();
    }
    api_->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    api_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    api_->BlitFramebuffer(0, 0, canvas.width, canvas.height, 0, 0, canvas.width, canvas.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    api_->BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::checkErrors(api_, "showing a picture");
}

} // namespace showmysky::app::preview
