#include "gl/pixel_store.hpp"

namespace sky::gl {

PixelStoreScope::PixelStoreScope(const Api& api, PixelTransfer transfer)
    : api_(api), bufferTarget_(transfer == PixelTransfer::pack ? GL_PIXEL_PACK_BUFFER : GL_PIXEL_UNPACK_BUFFER)
{
    const bool desktop = !api.isEs();
    const auto add = [&](GLenum name, GLint neutral) { parameters_[count_++] = {name, neutral, 0}; };
    if (transfer == PixelTransfer::pack) {
        add(GL_PACK_ALIGNMENT, 1);
        add(GL_PACK_ROW_LENGTH, 0);
        add(GL_PACK_SKIP_PIXELS, 0);
        add(GL_PACK_SKIP_ROWS, 0);
        if (desktop) {
            add(GL_PACK_SWAP_BYTES, 0);
            add(GL_PACK_IMAGE_HEIGHT, 0);
            add(GL_PACK_SKIP_IMAGES, 0);
        }
    } else {
        add(GL_UNPACK_ALIGNMENT, 1);
        add(GL_UNPACK_ROW_LENGTH, 0);
        add(GL_UNPACK_SKIP_PIXELS, 0);
        add(GL_UNPACK_SKIP_ROWS, 0);
        add(GL_UNPACK_IMAGE_HEIGHT, 0);
        add(GL_UNPACK_SKIP_IMAGES, 0);
        if (desktop)
            add(GL_UNPACK_SWAP_BYTES, 0);
    }
    for (std::size_t i = 0; i < count_; ++i) {
        api_->GetIntegerv(parameters_[i].name, &parameters_[i].before);
        api_->PixelStorei(parameters_[i].name, parameters_[i].neutral);
    }
    const bool pack = transfer == PixelTransfer::pack;
    api_->GetIntegerv(pack ? GL_PIXEL_PACK_BUFFER_BINDING : GL_PIXEL_UNPACK_BUFFER_BINDING, &bufferBefore_);
    api_->BindBuffer(bufferTarget_, 0);
}

PixelStoreScope::~PixelStoreScope()
{
    for (std::size_t i = 0; i < count_; ++i)
        api_->PixelStorei(parameters_[i].name, parameters_[i].before);
    api_->BindBuffer(bufferTarget_, static_cast<GLuint>(bufferBefore_));
}

} // namespace sky::gl
