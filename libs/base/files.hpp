#pragma once
// What the standard library can't do with files: durable writes, and exchanging a directory in one step.
// All system calls for it stand in files.cpp; elsewhere the file code is portable.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sky {

/// The system's words for an error number: "No space left on device".
std::string systemReason(int errorNumber);

/// Reads a whole file.
///   limit   bytes; a longer file is refused before anything is allocated
///   throws  FileError
std::string readTextFile(const std::filesystem::path& path, std::uint64_t limit);

/// Writes a whole file and makes it durable.   throws FileError, with the system's reason (disk full, no permission)
void writeTextFile(const std::filesystem::path& path, const std::string& text);

/// Waits until the file's content has reached the disk, as far as the system can say.   throws FileError
void syncFile(const std::filesystem::path& path);

/// A new directory beside `target`, filled at leisure and then put in its place in one step.
///
/// It is called `.NAME.partial-RANDOM` and locked while its process lives. The destructor removes it, so neither an
/// exception nor Ctrl-C leaves debris; what killed processes left is removed when the next one starts.
class ReplacementDirectory
{
public:
    /// Creates the directory (and missing parents of `target`).   throws FileError
    explicit ReplacementDirectory(const std::filesystem::path& target);
    ~ReplacementDirectory();
    ReplacementDirectory(const ReplacementDirectory&) = delete;
    ReplacementDirectory& operator=(const ReplacementDirectory&) = delete;

    /// Where to write.
    const std::filesystem::path& path() const { return path_; }
    /// What will be replaced: absolute, links resolved.
    const std::filesystem::path& target() const { return target_; }

    /// Puts the directory in place of the target, which is removed. Where the system can exchange two names (Linux), a
    /// reader finds either the old or the new directory at any time; elsewhere there is a moment between two renames in
    /// which it finds none. On failure the target is as it was.   throws FileError
    void replaceTarget();

private:
    void removeStale() const;
    void release();

    std::filesystem::path target_, path_;
    std::vector<std::filesystem::path> createdParents_; // outermost first
    int lock_ = -1;
    bool replaced_ = false;
};

} // namespace sky
