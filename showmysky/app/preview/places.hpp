#pragma once
// Where settings and computed models are kept (XDG Base Directory Specification 0.8).

#include <filesystem>

namespace showmysky::app::preview {

/// $XDG_CONFIG_HOME/showmysky, or ~/.config/showmysky. Empty where neither is known.
std::filesystem::path configDirectory();

/// Where the model of a description goes: one directory each below $XDG_CACHE_HOME, ~/.cache, or the temporary
/// directory.
std::filesystem::path modelDirectoryOf(const std::filesystem::path& description);

/// Models kept there.
constexpr std::size_t mostModels = 32;

/// Removes the models beside `newest` that were computed longest ago, until mostModels are left with it. What isn't a model stays, and so
/// does what can't be removed.
void forgetOldModels(const std::filesystem::path& newest);

} // namespace showmysky::app::preview
