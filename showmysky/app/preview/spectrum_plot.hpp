#pragma once

#include "light_meter.hpp"

namespace showmysky::app::preview {

/// A window with what a pixel's light is; its crosshair stands at `markX`, `markY` (pixels of the window).
///   returns  false once it was closed
bool drawReading(const Reading& reading, float markX, float markY);

} // namespace showmysky::app::preview
