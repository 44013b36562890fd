#pragma once
// Where settings and computed models are kept (XDG Base Directory Specification 0.8).

#include <filesystem>

namespace showmysky::app::preview {

/// $XDG_CONFIG_HOME/showmysky, or ~/.config/showmysky. Empty where neither is known.
std::filesystem::path configDirectory();

/// Where the model of a description goes: one directory each below $XDG_CACHE_HOME, ~/.cache, or the temporary
/// directory.
std::filesystem::path modelDirectoryOf(const std::filesystem::path& description);

} // namespace showmysky::app::preview
