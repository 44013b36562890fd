#pragma once

#include <ostream>

#include "gl/context.hpp"

namespace sky::cli {

/// The devices that --device takes, one a line. False where there are none.
bool printDevices(const gl::HeadlessOptions& options, std::ostream& to);

} // namespace sky::cli
