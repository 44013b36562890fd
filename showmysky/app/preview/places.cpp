#include "places.hpp"

#include "model/manifest.hpp"
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

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

void forgetOldModels(const fs::path& newest)
{
    struct Kept {
        fs::file_time_type computed;
        fs::path path;
    };
    std::vector<Kept> models;
    std::error_code error;
    for (fs::directory_iterator entry(newest.parent_path(), error), end; !error && entry != end; entry.increment(error)) {
        const fs::path& path = entry->path();
        std::error_code unknown;
        if (path == newest || entry->is_symlink(unknown) || !sky::model::isModelDirectory(path.string()))
            continue;
        const auto computed = fs::last_write_time(path / "manifest.json", unknown);
        if (!unknown)
            models.push_back({computed, path});
    }
    std::sort(models.begin(), models.end(), [](const Kept& a, const Kept& b) { return a.computed > b.computed; });
    for (std::size_t i = mostModels - 1; i < models.size(); ++i)
        fs::remove_all(models[i].path, error);
}

} // namespace showmysky::app::preview
