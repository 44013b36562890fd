#pragma once
// The state as a text file that survives a restart: a scene file with some lines more.

#include "state.hpp"
#include <filesystem>
#include <string_view>

namespace showmysky::app::preview {

std::string writePreferences(const State& state);
/// throws sky::UsageError with line and column; the state is then as before
void readPreferences(State& state, std::string_view text, const std::string& file);

/// preview.conf in the configuration directory; a missing file changes nothing.   throws as above, and sky::FileError
void loadPreferences(State& state);
/// Makes the directory where it is missing; does nothing where there is no home.   throws sky::FileError
void savePreferences(const State& state);

} // namespace showmysky::app::preview
