#pragma once
// Notices edits of a file, however an editor makes them: written in place, or a new file under the old name.

#include <cstdint>
#include <filesystem>

namespace showmysky::app::preview {

class Watch
{
public:
    explicit Watch(std::filesystem::path path) : path_(std::move(path)), seen_(look()), settled_(seen_) {}

    const std::filesystem::path& path() const { return path_; }
    /// True once after each change, when two looks in a row find the same file: half-written ones are waited for.
    bool changed();

private:
    struct Look {
        bool there = false;
        std::filesystem::file_time_type time{};
        std::uintmax_t size = 0;
        bool operator==(const Look&) const = default;
    };
    Look look() const;

    std::filesystem::path path_;
    Look seen_, settled_;
};

} // namespace showmysky::app::preview
