#include "places.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace showmysky::app::preview {

namespace {

namespace fs = std::filesystem;

/// The specification wants absolute paths and others ignored.
fs::path fromEnvironment(const char* variable)
{
    const char* value = std::getenv(variable);
    const fs::path path = value ? value : "";
    return path.is_absolute() ? path : fs::path();
}

fs::path base(const char* variable, const char* belowHome)
{
    if (const auto path = fromEnvironment(variable); !path.empty())
        return path;
    const auto home = fromEnvironment("HOME");
    return home.empty() ? home : home / belowHome;
}

/// FNV-1a, 64 bits: names of files only.
std::string shortName(const std::string& text)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

} // namespace

fs::path configDirectory()
{
    const auto path = base("XDG_CONFIG_HOME", ".config");
    return path.empty() ? path : path / "showmysky";
}

fs::path modelDirectoryOf(const fs::path& description)
{
    std::error_code error;
    auto cache = base("XDG_CACHE_HOME", ".cache");
    if (cache.empty())
        cache = fs::temp_directory_path(error);
    const auto whole = fs::weakly_canonical(description, error);
    const std::string name = (error ? description : whole).string();
    return cache / "showmysky" / "models" / (description.stem().string() + "-" + shortName(name));
}

} // namespace showmysky::app::preview
