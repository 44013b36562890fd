#pragma once
// Dear ImGui in the window.

#include "window.hpp"

struct ImGuiContext;

namespace showmysky::app::preview {

class Interface
{
public:
    /// After the window's own, so that both hear of every event.
    explicit Interface(const Window& window);
    ~Interface();
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;

    void begin();
    /// Draws all widgets since begin() into the framebuffer that is bound.
    void end();
    bool wantsPointer() const;
    bool wantsKeys() const;

private:
    ImGuiContext* context_;
};

} // namespace showmysky::app::preview
