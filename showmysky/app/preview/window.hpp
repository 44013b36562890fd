#pragma once
// The window and its OpenGL 3.3 context.

#include "events.hpp"
#include "input.hpp"
#include "showmysky/sky.hpp"
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace showmysky::app::preview {

/// One at a time. Current on the thread that made it, which is the one to use it.
class Window
{
public:
    /// throws sky::Error: why no window can be opened, and to use `showmysky render`
    Window(int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    GlLoader loader() const;
    bool closing() const;
    void setTitle(const std::string& title);

    /// What happened since the last call; waits for something to happen, at most that long.
    std::vector<Event> events(double atMostSeconds);
    void show();

    Canvas size() const;        ///< of events
    Canvas framebuffer() const; ///< pixels to draw
    /// Pixels from the framebuffer's lower left corner, where events count from the window's upper left.
    Point inFramebuffer(const Point& point) const;

private:
    struct Library; ///< GLFW while it lives
    /// What GLFW told. The pointer's place is where it was at the event, not where it is by now.
    struct Heard {
        std::vector<Event> events;
        Point pointer;
    };
    static Heard& heardBy(GLFWwindow* window);
    void listen();

    std::unique_ptr<Library> library_;
    GLFWwindow* window_ = nullptr;
    Heard heard_;
};

} // namespace showmysky::app::preview
