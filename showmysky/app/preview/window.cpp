#include "window.hpp"

#include "base/error.hpp"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <utility>

namespace showmysky::app::preview {

namespace {

std::string glfwReason()
{
    const char* words = nullptr;
    glfwGetError(&words);
    return words ? std::string(" (") + words + ")" : std::string();
}

[[noreturn]] void refuse(const std::string& what)
{
    throw sky::GlError(what + glfwReason() + ". Without a window, `showmysky render MODEL -o sky.png` draws the same picture.");
}

Key keyOf(int key)
{
    switch (key) {
    case GLFW_KEY_ESCAPE: return Key::escape;
    case GLFW_KEY_TAB: return Key::tab;
    case GLFW_KEY_Q: return Key::q;
    case GLFW_KEY_R: return Key::r;
    case GLFW_KEY_S: return Key::s;
    default: return Key::other;
    }
}

Button buttonOf(int button)
{
    return button == GLFW_MOUSE_BUTTON_RIGHT ? Button::right : button == GLFW_MOUSE_BUTTON_MIDDLE ? Button::middle : Button::left;
}

Modifiers modifiersOf(int bits) { return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0}; }

} // namespace

struct Window::Library {
    Library()
    {
        if (!glfwInit())
            refuse("No window can be opened");
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

Window::Window(int width, int height, const std::string& title) : library_(std::make_unique<Library>())
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_)
        refuse("No window with OpenGL 3.3 can be opened");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    listen();
}

Window::~Window() { glfwDestroyWindow(window_); }

Window::Heard& Window::heardBy(GLFWwindow* window) { return *static_cast<Heard*>(glfwGetWindowUserPointer(window)); }

void Window::listen()
{
    glfwGetCursorPos(window_, &heard_.pointer.x, &heard_.pointer.y);
    glfwSetWindowUserPointer(window_, &heard_);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        heardBy(window).pointer = {x, y};
        heardBy(window).events.push_back(PointerMoved{{x, y}});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
        Heard& heard = heardBy(window);
        if (action == GLFW_PRESS)
            heard.events.push_back(ButtonPressed{buttonOf(button), modifiersOf(modifiers), heard.pointer});
        else
            heard.events.push_back(ButtonReleased{buttonOf(button), heard.pointer});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) { heardBy(window).events.push_back(WheelTurned{steps}); });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        if (action != GLFW_RELEASE)
            heardBy(window).events.push_back(KeyPressed{action == GLFW_PRESS ? keyOf(key) : Key::other, modifiersOf(modifiers)});
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { heardBy(window).events.push_back(Exposed{}); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { heardBy(window).events.push_back(Exposed{}); });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        heardBy(window).events.push_back(Dropped{{paths, paths + count}});
    });
}

GlLoader Window::loader() const
{
    return [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); };
}

bool Window::closing() const { return glfwWindowShouldClose(window_) != 0; }

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

std::vector<Event> Window::events(double atMostSeconds)
{
    if (atMostSeconds > 0)
        glfwWaitEventsTimeout(atMostSeconds);
    else
        glfwPollEvents();
    return std::exchange(heard_.events, {});
}

void Window::show() { glfwSwapBuffers(window_); }

Canvas Window::size() const
{
    Canvas canvas;
    glfwGetWindowSize(window_, &canvas.width, &canvas.height);
    return canvas;
}

Canvas Window::framebuffer() const
{
    Canvas canvas;
    glfwGetFramebufferSize(window_, &canvas.width, &canvas.height);
    return canvas;
}

Point Window::inFramebuffer(const Point& point) const
{
    const Canvas window = size(), pixels = framebuffer();
    return {point.x * pixels.width / window.width, pixels.height - point.y * pixels.height / window.height};
}

} // namespace showmysky::app::preview
