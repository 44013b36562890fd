#pragma once
// Dear ImGui in the window.

#include "window.hpp"
#include <optional>

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

    /// A click counts where it was made, even if the pointer has left since, as it does when frames take long.
    void begin(const std::vector<Event>& events);
    /// Draws all widgets since begin() into the framebuffer that is bound.
    void end();
    bool wantsPointer() const;
    bool wantsKeys() const;

private:
    ImGuiContext* context_;
    std::optional<Point> release_; ///< of a button that went down and up between two frames: it belongs to the next one
};

} // namespace showmysky::app::preview
