#pragma once
// What people do in the window, free of any window library.

#include <string>
#include <variant>
#include <vector>

namespace showmysky::app::preview {

enum class Button { left, right, middle };
enum class Key { other, escape, tab, q, r, s };

struct Modifiers {
    bool shift = false, control = false;
};

/// Pixels from the window's upper left corner.
struct Point {
    double x = 0, y = 0;
};

struct PointerMoved {
    Point to;
};
struct ButtonPressed {
    Button button = Button::left;
    Modifiers modifiers;
    Point at;
};
struct ButtonReleased {
    Button button = Button::left;
    Point at;
};
struct WheelTurned {
    double steps = 0; ///< away from the user: positive
};
struct KeyPressed {
    Key key = Key::other;
    Modifiers modifiers;
};
struct Dropped {
    std::vector<std::string> paths;
};
/// The window's size or what covered it changed.
struct Exposed {
};

using Event = std::variant<PointerMoved, ButtonPressed, ButtonReleased, WheelTurned, KeyPressed, Dropped, Exposed>;

} // namespace showmysky::app::preview
