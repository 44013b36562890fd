#include "base/files.hpp"
#include "base/error.hpp"

#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>

#if defined(__unix__) || defined(__APPLE__)
#define SKY_POSIX 1
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#else
#define SKY_POSIX 0
#endif
#if defined(__linux__)
#include <stdio.h> // renameat2, where the C library has it
#endif

namespace sky {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& what, const fs::path& path, int errorNumber)
{
    throw FileError("Can't " + what + " '" + path.string() + "': " + systemReason(errorNumber) + ".");
}

[[noreturn]] void fail(const std::string& what, const fs::path& path, const std::error_code& code)
{
    throw FileError("Can't " + what + " '" + path.string() + "': " + code.message() + ".");
}

// Swaps two directories in one step. False where the system or the file system has no such thing.
bool exchange([[maybe_unused]] const fs::path& a, [[maybe_unused]] const fs::path& b)
{
#if defined(__linux__) && defined(RENAME_EXCHANGE)
    return ::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
    return false;
#endif
}

// Locks an existing directory for as long as the handle is open; -1 if another process holds it.
int lockDirectory([[maybe_unused]] const fs::path& path)
{
#if SKY_POSIX
    const int handle = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
    if (handle < 0)
        return -1;
    if (::flock(handle, LOCK_EX | LOCK_NB) == 0)
        return handle;
    ::close(handle);
#endif
    return -1;
}

void closeHandle([[maybe_unused]] int handle)
{
#if SKY_POSIX
    if (handle >= 0)
        ::close(handle);
#endif
}

std::string randomName()
{
    std::random_device device;
    std::string text;
    for (int i = 0; i < 12; ++i)
        text += "0123456789abcdefghijklmnopqrstuv"[device() % 32];
    return text;
}

void syncDirectory([[maybe_unused]] const fs::path& path)
{
#if SKY_POSIX
    // Some file systems can't sync a directory; the rename is then as durable as they make it.
    const int handle = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle >= 0) {
        ::fsync(handle);
        ::close(handle);
    }
#endif
}

} // namespace

std::string systemReason(int errorNumber) { return std::generic_category().message(errorNumber); }

std::string readTextFile(const fs::path& path, std::uint64_t limit)
{
    std::error_code code;
    const auto size = fs::file_size(path, code);
    if (code)
        fail("read", path, code);
    if (size > limit)
        throw FileError("The file '" + path.string() + "' has " + std::to_string(size) + " bytes; at most " + std::to_string(limit) +
                        " were expected.");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text(size, '\0');
    if (!file || !file.read(text.data(), static_cast<std::streamsize>(size)))
        fail("read", path, errno ? errno : EIO);
    return text;
}

void writeTextFile(const fs::path& path, const std::string& text)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file)
        fail("write", path, errno ? errno : EIO);
    syncFile(path);
}

void syncFile([[maybe_unused]] const fs::path& path)
{
#if SKY_POSIX
    const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (handle < 0)
        fail("open", path, errno);
    const bool synced = ::fsync(handle) == 0 || errno == EINVAL;
    const int reason = errno;
    ::close(handle);
    if (!synced)
        fail("write", path, reason);
#endif
}

ReplacementDirectory::ReplacementDirectory(const fs::path& target)
{
    std::error_code code;
    target_ = fs::weakly_canonical(fs::absolute(target), code);
    if (code)
        fail("use the directory", target, code);
    if (!target_.has_filename())
        target_ = target_.parent_path();
    if (!target_.has_filename())
        throw FileError("Can't replace '" + target.string() + "': a directory with a name was expected.");
    if (fs::exists(target_, code) && !fs::is_directory(target_, code))
        throw FileError("Can't make the directory '" + target.string() + "': a file of that name exists.");

    const fs::path parent = target_.parent_path();
    std::vector<fs::path> missing;
    for (fs::path p = parent; !fs::exists(p, code) && p.has_relative_path(); p = p.parent_path())
        missing.push_back(p);
    for (auto p = missing.rbegin(); p != missing.rend(); ++p) {
        if (!fs::create_directory(*p, code) && code)
            fail("make the directory", *p, code);
        createdParents_.push_back(*p);
    }
    removeStale();

    const std::string prefix = "." + target_.filename().string() + ".partial-";
    for (;;) {
        path_ = parent / (prefix + randomName());
        if (!fs::create_directory(path_, code)) {
            if (!code)
                continue; // the name exists
            release();
            throw FileError("Can't write in the directory '" + parent.string() + "': " + code.message() + ".");
        }
        lock_ = lockDirectory(path_);
        // Between the two steps another process may have taken it for debris.
        if (fs::exists(path_, code))
            return;
        closeHandle(lock_);
    }
}

ReplacementDirectory::~ReplacementDirectory() { release(); }

void ReplacementDirectory::release()
{
    std::error_code code;
    if (!path_.empty())
        fs::remove_all(path_, code);
    closeHandle(lock_);
    lock_ = -1;
    if (!replaced_)
        for (auto p = createdParents_.rbegin(); p != createdParents_.rend(); ++p)
            fs::remove(*p, code); // only if empty
    createdParents_.clear();
}

void ReplacementDirectory::removeStale() const
{
#if SKY_POSIX // without locks the dead can't be told from the living
    const std::string prefix = "." + target_.filename().string() + ".partial-";
    std::error_code code;
    std::vector<fs::path> found;
    for (fs::directory_iterator it(target_.parent_path(), code), end; !code && it != end; it.increment(code))
        if (it->path().filename().string().starts_with(prefix) && it->is_directory(code))
            found.push_back(it->path());
    for (const fs::path& path : found)
        if (const int handle = lockDirectory(path); handle >= 0) {
            fs::remove_all(path, code);
            closeHandle(handle);
        }
#endif
}

void ReplacementDirectory::replaceTarget()
{
    std::error_code code;
    syncDirectory(path_);
    if (!fs::exists(target_, code)) {
        fs::rename(path_, target_, code);
        if (code)
            fail("make the directory", target_, code);
        path_.clear();
    } else if (!exchange(path_, target_)) {
        // Its name marks the old directory as debris too, should we die before it is gone.
        const fs::path aside = path_.string() + "-old";
        fs::rename(target_, aside, code);
        if (code)
            fail("replace the directory", target_, code);
        fs::rename(path_, target_, code);
        if (code) {
            std::error_code ignored;
            fs::rename(aside, target_, ignored);
            fail("replace the directory", target_, code);
        }
        path_ = aside;
    } // after an exchange path_ names the old directory, which release() removes
    replaced_ = true;
    syncDirectory(target_.parent_path());
    release();
    path_.clear();
}

} // namespace sky
