#pragma once
// What all owners of OpenGL objects have in common: one name, one label, freed once.

#include <string>

#include "gl/api.hpp"

namespace sky::gl {

/// Owner of one OpenGL object. Move-only; a moved-from owner owns nothing. See Api for the rule of lifetime.
class Object
{
public:
    Object(Object&& other) noexcept;
    Object& operator=(Object&& other) noexcept;
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    GLuint name() const { return name_; }
    const std::string& label() const { return label_; }
    const Api& api() const { return api_; }

protected:
    enum class Kind { buffer, texture, framebuffer, vertexArray, program, query };

    Object(const Api& api, Kind kind, std::string label);
    ~Object();
    /// Tells the driver the label; call it after the object's first binding, which is when it starts to exist.
    void applyLabel() const;

private:
    void free() noexcept;

    Api api_;
    Kind kind_;
    GLuint name_ = 0;
    std::string label_;
};

} // namespace sky::gl
