#pragma once
// Luminance on the GPU to what a screen shows, for the window and for files alike.

#include "development.hpp"
#include "gl/framebuffer.hpp"
#include "gl/program.hpp"
#include "picture.hpp"
#include <optional>

namespace showmysky::app {

/// A part of a framebuffer, pixels from its lower left corner.
struct Area {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Lives in one OpenGL context (3.3 core or ES 3.0), which is current in every call.
class Developer
{
public:
    explicit Developer(const sky::gl::Api& api);

    /// Draws into the framebuffer that is bound.
    ///   luminance  texture: X, Y, Z, scotopic in cd m^-2
    ///   exposure   log10 of the factor; `development.exposure` and `automatic` are the caller's to decide
    void draw(unsigned luminance, const Development& development, double exposure, const Area& area);

    /// The same into memory.
    Levels levels(unsigned luminance, int width, int height, const Development& development, double exposure);

    /// Some thousand pixels of it, evenly spread: enough for automaticExposure.
    Picture sample(unsigned luminance);

private:
    struct Target {
        Target(const sky::gl::Api& api, const char* label, sky::gl::TextureFormat format, int width, int height);
        sky::gl::Texture2D texture;
        sky::gl::Framebuffer framebuffer;
    };
    void makeVeil(unsigned luminance, const Area& area, float factor);

    sky::gl::Api api_;
    sky::gl::VertexArray triangle_;
    sky::gl::Program develop_, shrink_, gather_, sample_;
    Target samples_;
    std::vector<Target> shrunk_, veils_; ///< halves, quarters ... of the area
    std::optional<sky::gl::Texture2D> noise_;
};

} // namespace showmysky::app
