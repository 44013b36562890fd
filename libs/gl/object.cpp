#include "gl/object.hpp"

#include <utility>

#include "base/error.hpp"

namespace sky::gl {

Object::Object(const Api& api, Kind kind, std::string label) : api_(api), kind_(kind), label_(std::move(label))
{
    switch (kind_) {
    case Kind::buffer: api_->GenBuffers(1, &name_); break;
    case Kind::texture: api_->GenTextures(1, &name_); break;
    case Kind::framebuffer: api_->GenFramebuffers(1, &name_); break;
    case Kind::vertexArray: api_->GenVertexArrays(1, &name_); break;
    case Kind::program: name_ = api_->CreateProgram(); break;
    case Kind::query: api_->GenQueries(1, &name_); break;
    }
    if (name_ == 0) {
        checkErrors(api_, "creating an OpenGL object", label_);
        throw GlError("OpenGL gives no name for \"" + label_ + "\": is its context current on this thread?");
    }
}

Object::Object(Object&& other) noexcept
    : api_(other.api_), kind_(other.kind_), name_(std::exchange(other.name_, 0)), label_(std::move(other.label_))
{
}

Object& Object::operator=(Object&& other) noexcept
{
    if (this != &other) {
        free();
        api_ = other.api_;
        kind_ = other.kind_;
        name_ = std::exchange(other.name_, 0);
        label_ = std::move(other.label_);
    }
    return *this;
}

Object::~Object() { free(); }

void Object::free() noexcept
{
    if (name_ == 0)
        return;
    api_.runCurrent([this] {
        switch (kind_) {
        case Kind::buffer: api_->DeleteBuffers(1, &name_); break;
        case Kind::texture: api_->DeleteTextures(1, &name_); break;
        case Kind::framebuffer: api_->DeleteFramebuffers(1, &name_); break;
        case Kind::vertexArray: api_->DeleteVertexArrays(1, &name_); break;
        case Kind::program: api_->DeleteProgram(name_); break;
        case Kind::query: api_->DeleteQueries(1, &name_); break;
        }
    });
    name_ = 0;
}

void Object::applyLabel() const
{
    static constexpr GLenum identifiers[] = {GL_BUFFER, GL_TEXTURE, GL_FRAMEBUFFER, GL_VERTEX_ARRAY, GL_PROGRAM, GL_QUERY};
    api_.label(identifiers[static_cast<int>(kind_)], name_, label_);
}

} // namespace sky::gl
